# SPDX-License-Identifier: Apache-2.0
"""Batches by engines that share work out: the examples of docs/batch.md, where they are installed.

usage: clusters_test.py OBVID PROJECT_FOLDER LIBRARY slurm|dask|parallel|mpirun
Exit code 77: that engine is not installed here.
"""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import textwrap
import time

OBVID, PROJECT, LIBRARY, ENGINE = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3], sys.argv[4]


def skip(why):
    print("SKIPPED:", why)
    sys.exit(77)


def need(*programs):
    for program in programs:
        if not shutil.which(program):
            skip(f"{program} is not installed")


def series(count):
    import numpy as np

    rng = np.random.default_rng(3)
    out = []
    for _ in range(count):
        turn, grow = rng.uniform((1.0, 0.1), (3.0, 0.5))
        t = np.linspace(0.0, turn, 20)
        r = 100.0 * np.exp(grow * t)
        out.append(np.column_stack([r * np.cos(t), r * np.sin(t)]))
    return out


def write_source(path, count=500):
    import h5py
    import numpy as np

    with h5py.File(path, "w") as file:
        made = series(count)
        file["points"] = np.concatenate(made)
        file["start"] = np.cumsum([0, *(len(p) for p in made)])


def obvid(*words, **more):
    subprocess.run([OBVID, "batch", *map(str, words)], check=True, **more)


def compare(at, source):
    """The merged result is that of one process, byte for byte."""
    obvid("-o", at / "out.h5", "--merge")
    obvid(source, "-o", at / "alone.h5", "--shard-size", "20")
    assert (at / "out.h5").read_bytes() == (at / "alone.h5").read_bytes()


def run_parallel(at, source):
    need("parallel")
    subprocess.run(["parallel", "--will-cite", "-j", "2", OBVID, "batch", str(source), "-o",
                    str(at / "out.h5"), "--jobs", "1", "--shard-size", "20", "--shard", "{}/4",
                    ":::", "1", "2", "3", "4"], check=True)
    compare(at, source)


def run_mpirun(at, source):
    need("mpirun")
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    subprocess.run(["mpirun", "--oversubscribe", "-n", "3", OBVID, "batch", str(source), "-o",
                    str(at / "out.h5"), "--jobs", "1", "--shard-size", "20"], check=True,
                   env=environment)
    compare(at, source)


SLURM_CONF = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
AuthType=auth/none
CryptoType=crypto/none
CredType=cred/none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={at}/state
SlurmdSpoolDir={at}/spool
SlurmctldPidFile={at}/slurmctld.pid
SlurmdPidFile={at}/slurmd.pid
SlurmctldLogFile={at}/slurmctld.log
SlurmdLogFile={at}/slurmd.log
SlurmctldPort={port}
SlurmdPort={port1}
SelectType=select/cons_res
SelectTypeParameters=CR_Core
ReturnToService=2
MpiDefault=none
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def free_port():
    import socket

    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def run_slurm(at, source):
    need("slurmctld", "slurmd", "sbatch", "sinfo")
    if os.geteuid() != 0:
        skip("slurmd wants to be root")
    host = os.uname().nodename.split(".")[0]
    for name in ("state", "spool"):
        (at / name).mkdir()
    conf = at / "slurm.conf"
    conf.write_text(SLURM_CONF.format(host=host, user="root", at=at, port=free_port(),
                                      port1=free_port(), cpus=os.cpu_count()))
    environment = {**os.environ, "SLURM_CONF": str(conf)}
    script = at / "sections.sh"
    script.write_text(textwrap.dedent(f"""\
        #!/bin/sh
        #SBATCH --array=1-6
        #SBATCH --ntasks=1
        #SBATCH --output={at}/%a.log
        exec {OBVID} batch {source} -o {at}/out.h5 --jobs 1 --shard-size 20
        """))
    daemons = [subprocess.Popen([shutil.which(name), "-D", "-f", str(conf)], env=environment,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
               for name in ("slurmctld", "slurmd")]
    try:
        until = time.monotonic() + 60
        while "idle" not in subprocess.run(["sinfo", "-h", "-o", "%T"], env=environment,
                                           capture_output=True, text=True).stdout:
            if time.monotonic() > until:
                print((at / "slurmd.log").read_text()[-2000:])
                raise AssertionError("Slurm does not come up")
            time.sleep(0.3)
        subprocess.run(["sbatch", "--wait", str(script)], check=True, env=environment, timeout=200)
    finally:
        for daemon in daemons:
            daemon.send_signal(signal.SIGTERM)
        for daemon in daemons:
            daemon.wait()
    logs = [(at / f"{i}.log").read_text() for i in range(1, 7)]
    for i, log in enumerate(logs, 1):
        assert f"shard {i} of 6 (SLURM_ARRAY_TASK_ID)" in log, log
    compare(at, source)


def run_dask(at, source):
    try:
        import distributed
        import numpy as np
    except ImportError:
        skip("python3-distributed is not installed")
    os.environ["OBVID_LIBRARY"] = LIBRARY
    path = str(PROJECT / "bindings/python")
    os.environ["PYTHONPATH"] = path
    sys.path.insert(0, path)
    import obvid
    import obvid.dask

    made = series(600)
    made[7] = np.array([(0.0, 0.0), (np.nan, 1.0), (2.0, 2.0)])
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None,
                                  local_directory=str(at)) as cluster, \
            distributed.Client(cluster) as client:
        pids = client.run(os.getpid)
        victim = list(pids.values())[0]

        def kill_soon():
            time.sleep(0.4)
            os.kill(victim, signal.SIGKILL)

        import threading

        killer = threading.Thread(target=kill_soon)
        killer.start()
        found = []
        while killer.is_alive() or not found:  # at work when the worker dies
            found = obvid.dask.fit_many(made, client, chunk=10, noise=0.01)
        killer.join()
        found = obvid.dask.fit_many(made, client, chunk=10, noise=0.01)
        assert victim not in client.run(os.getpid).values()
    assert len(found) == len(made)
    assert isinstance(found[7], obvid.InputError) and found[7].code == 303
    for i in (0, 6, 8, 300, 599):
        alone = obvid.fit(made[i], noise=0.01)
        assert found[i].certificate.vertices == alone.certificate.vertices
        np.testing.assert_array_equal(np.asarray(found[i]), np.asarray(alone))


if __name__ == "__main__":
    if ENGINE != "dask":
        try:
            import h5py  # noqa: F401
        except ImportError:
            skip("python3-h5py is not installed")
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        data = place / "in.h5"
        if ENGINE != "dask":
            write_source(data)
        {"slurm": run_slurm, "dask": run_dask, "parallel": run_parallel,
         "mpirun": run_mpirun}[ENGINE](place, data)
    print("ok")
