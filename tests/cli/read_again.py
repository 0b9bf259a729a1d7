#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `convert` makes of public drawings is read again, and holds no figure that is not a number.

usage: read_again.py PROGRAM DATA

Of every drawing in DATA that `convert` writes as contour and samples: the contour is read by `verify`
(which may refuse to prove it, not to read it) and written again as the same pieces and joints; the
samples hold no nan or inf. Exit code 1: one of them is not so. Where DATA is not there, that is said.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

DRAWINGS = ["cad_svg/*.svg", "cad_dxf/*.dxf", "roads_opendrive/*.xodr", "landxml/*"]
MALFORMED = 3  # exit code of files that cannot be read
WRITTEN_AGAIN = ["units", "closed", "pieces", "elements"]


def main():
    program, data = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2])
    if not data.is_dir():
        print(f"{data} is not there: no drawing was looked at")
        return 0
    faults, written = [], 0
    for path in sorted(p for pattern in DRAWINGS for p in data.glob(pattern)):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)

            def run(*args):
                return subprocess.run([program, *args, "--quiet"], cwd=folder, capture_output=True,
                                      timeout=60)

            run("convert", str(path.resolve()), "-o", "a.json", "-o", "a.csv")
            if not (folder / "a.json").exists():
                continue
            written += 1
            read = run("verify", "a.json")
            if read.returncode == MALFORMED:
                faults.append(f"{path.name}: {read.stderr.decode()}")
                continue
            again = run("convert", "a.json", "-o", "b.json")
            if again.returncode != 0:
                faults.append(f"{path.name}: {again.stderr.decode()}")
                continue
            first, second = (json.loads((folder / n).read_text()) for n in ("a.json", "b.json"))
            faults += [f"{path.name}: {key} differ when written again" for key in WRITTEN_AGAIN
                       if first[key] != second[key]]
            samples = (folder / "a.csv").read_text().lower()
            faults += [f"{path.name}: samples hold {word}" for word in ("nan", "inf")
                       if word in samples]
    print("\n".join(faults))
    print(f"{written} drawings written and read again, {len(faults)} faults")
    assert written > 0, "no drawing was written"
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
