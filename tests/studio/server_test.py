# SPDX-License-Identifier: Apache-2.0
"""The studio's server answers its own page alone, says what the command line says, and survives
whatever is sent. usage: server_test.py OBVID PROJECT_FOLDER"""
import json
import os
import random
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from studio import Studio, series10

PROGRAM, ROOT = sys.argv[1], Path(sys.argv[2])
FILE = ROOT / "examples/series10.csv"
MALFORMED = 10_000
# what the page offers
FORMATS = re.search(r"FORMATS = (\[.*?\])", (ROOT / "web/studio/src/view/preview.tsx").read_text()).group(1)
FORMATS = json.loads(FORMATS)
failures = []


def check(what, holds, seen=""):
    if not holds:
        failures.append(f"{what}: {str(seen)[:300]}")


def same_figures(ours, theirs):
    """Reports but for the times."""
    if isinstance(ours, dict):
        return isinstance(theirs, dict) and all(
            same_figures(v, theirs.get(k)) for k, v in ours.items() if "seconds" not in k)
    if isinstance(ours, list):
        return len(ours) == len(theirs) and all(map(same_figures, ours, theirs))
    return ours == theirs


def timeless(text):
    """But for seconds and dates."""
    text = re.sub(r'"seconds": [^,}\n]*', '"seconds": 0', text)
    return re.sub(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d", "TIME", text)


def program(*arguments):
    made = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    return made.stdout


def guards(studio):
    token = {"X-Obvid-Token": studio.token}
    page = f"/?token={studio.token}"
    cases = [
        ("the page with its token", "GET", page, {}, 200),
        ("the page without", "GET", "/", {}, 403),
        ("the page with another token", "GET", "/?token=" + "0" * 32, {}, 403),
        ("the page for another host", "GET", page, {"Host": "example.org"}, 403),
        ("the page for a name of this machine", "GET", page, {"Host": "localhost"}, 403),
        ("the page from another origin", "GET", page, {"Origin": "http://example.org"}, 403),
        ("a job without token", "POST", "/api/fit", {}, 403),
        ("a job with the token in the address", "POST", "/api/fit?token=" + studio.token, {}, 403),
        ("a job from another origin", "POST", "/api/fit", token | {"Origin": "null"}, 403),
        ("a job for another host", "POST", "/api/fit", token | {"Host": "example.org:80"}, 403),
        ("a file of the machine", "GET", "/etc/passwd?token=" + studio.token, {}, 404),
        ("a file above the page", "GET", "/../../etc/passwd?token=" + studio.token, {}, 404),
        ("a job that is none", "POST", "/api/../etc", token, 404),
    ]
    for what, method, path, headers, wanted in cases:
        body = b"{}" if method == "POST" else None
        status, sent, _ = studio.ask(method, path, body, headers)
        check(what, status == wanted, status)
        check(what + ": no other site may read it", "Access-Control-Allow-Origin" not in sent, sent)
    status, sent, body = studio.ask("GET", page)
    check("the page allows no foreign script", "default-src 'none'" in
          sent.get("Content-Security-Policy", ""), sent)
    check("the page is the page", b"<!doctype html>" in body[:40], body[:40])
    check("listens on this machine alone", not reachable_from_outside(studio), studio.host)


def reachable_from_outside(studio):
    port = int(studio.host.split(":")[1])
    for family, _, _, _, address in socket.getaddrinfo(socket.gethostname(), port, 0,
                                                       socket.SOCK_STREAM):
        if address[0].startswith("127.") or address[0] == "::1":
            continue
        with socket.socket(family, socket.SOCK_STREAM) as link:
            link.settimeout(2)
            if link.connect_ex(address) == 0:
                return True
    return False


def says_what_the_program_says(studio):
    points = series10(ROOT)
    fit = studio.job("fit", {"points": points, "options": {"units": "mm"}})
    check("fit", fit["error"] is None and fit["report"]["certificate"]["proved"], fit["error"])
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "c.json"
        told = json.loads(program("fit", FILE, "--json", "-o", out))
        for part in ("report", "certificate"):
            check(f"fit: {part}", same_figures(told[part], fit["report"][part]), part)
        theirs, ours = json.loads(out.read_text()), json.loads(fit["contour"])
        check("fit: contour", theirs["pieces"] == ours["pieces"], "pieces differ")
        out.write_text(fit["contour"])
        verified = studio.job("verify", {"contour": fit["contour"]})
        check("verify", same_figures(json.loads(program("verify", out, "--json")),
                                     verified["report"]), verified["error"])
        for ending in FORMATS:
            target = Path(folder) / f"o.{ending}"
            said = subprocess.run([PROGRAM, "fit", FILE, "--units", "mm", "-o", target], capture_output=True, text=True)
            made = studio.job("export", {"contour": fit["contour"], "format": ending, "name": FILE.name})
            if said.returncode != 0:  # road formats know no spirals
                check(f"export {ending}: refused alike", f"E{(made['error'] or {}).get('code')}:" in said.stderr,
                      (made["error"], said.stderr))
                continue
            check(f"export {ending}", made["error"] is None, made["error"])
            written = {one.name: one.read_bytes().decode() for one in Path(folder).glob(f"o*.{ending}")}
            ours = {f"o{one['suffix']}.{ending}": one["text"] for one in made["files"]}
            check(f"export {ending}: as many files", written.keys() == ours.keys(), (list(written), list(ours)))
            for name, text in written.items():
                where = next(((a, b) for a, b in zip(timeless(ours.get(name, "")).split("\n"),
                                                     timeless(text).split("\n")) if a != b), "lengths")
                check(f"export {name}: the bytes of the command line",
                      timeless(ours.get(name, "")) == timeless(text), where)
        for ending in ("tex", "csv", "svg", "dxf"):
            target = Path(folder) / f"sheet.{ending}"
            program("region", FILE, "-o", target)
            made = studio.job("worksheet", {"text": FILE.read_text(), "name": FILE.name, "format": ending})
            check(f"worksheet {ending}", [one["text"] for one in made["files"]] == [target.read_bytes().decode()],
                  made["error"])
    for kind, command in (("region", "region"), ("compare", "compare"), ("analyse", "analyse")):
        ours = studio.job(kind, {"text": FILE.read_text(), "name": "series10.csv"})
        told = json.loads(program(command, FILE, "--json"))
        check(kind, same_figures(told, ours["report"]), kind)
    read = studio.job("series", {"text": "x_m,y_m,heading_deg\n0,0,10\n1,1,\n3,2,\n6,2,\n", "name": "a"})
    check("series", read["report"]["points"][2] == [3, 2] and read["report"]["units"] == "m", read)
    check("series: given", abs(read["report"]["given"][0]["heading"] - 0.17453292519943295) < 1e-15
          and read["report"]["given"][0]["point"] == 0, read["report"]["given"])
    opened = studio.job("opened", {})
    check("opened", opened == {"name": "series10.csv", "text": FILE.read_text()}, opened)


def reads_what_the_cad_kernel_reads(studio):
    """STEP from a text, by a file that nobody else reads and that is gone afterwards."""
    part = ROOT / "tests/data/judge/series10.step"
    if not (Path(PROGRAM).parent / "obvid-cad").exists():
        print("SKIPPED: STEP files, the helper of the CAD kernel is not built")
        return
    text = part.read_text()
    ours = studio.job("analyse", {"text": text, "name": part.name})
    told = json.loads(program("analyse", part, "--json"))
    check("a STEP file", ours["error"] is None and same_figures(told["curves"], ours["report"]["curves"]), ours["error"])
    read = studio.job("series", {"text": text, "name": part.name})
    check("a STEP file as points", read["error"] is None and len(read["report"]["points"]) > 9, read["error"])
    drawn = studio.job("drawn", {"text": text, "name": part.name})
    check("a STEP file as it is drawn", drawn["error"] is None and drawn["curve"]["pieces"] > 0, drawn["error"])
    bad = studio.job("series", {"text": text[:len(text) // 2], "name": "../../part.step"})
    said = json.dumps(bad["error"])
    check("half a STEP file", bad["error"] is not None and "obvid-" not in said and "part.step" in said, said)
    left = [p for p in Path(tempfile.gettempdir()).glob("obvid-??????") if (p / part.name).exists()]
    check("nothing is left of it", not left, left)
    stored = studio.job("fit", {"points": series10(ROOT), "samples": 9})
    again = studio.job("drawn", {"text": stored["contour"], "name": "c.json", "samples": 9})
    check("a contour file as it stands", again["curve"] == stored["curve"], again["error"])


def curve_is_the_contour(studio):
    """Points, headings and curvatures of the answer against each other, by differences."""
    curve = studio.job("fit", {"points": series10(ROOT), "samples": 200})["curve"]
    each, n = curve["samples"], len(curve["t"])
    check("curve: sizes", n == each * curve["pieces"] and len(curve["xy"]) == 2 * n, n)
    length, worst_kappa, worst_slope = 0.0, 0.0, 0.0
    for i in range(1, n):
        if i % each == 0:
            continue
        dx = curve["xy"][2 * i] - curve["xy"][2 * i - 2]
        dy = curve["xy"][2 * i + 1] - curve["xy"][2 * i - 1]
        step = (dx * dx + dy * dy) ** 0.5
        length += step
        kappa = (curve["heading"][i] - curve["heading"][i - 1]) / step
        middle = 0.5 * (curve["kappa"][i] + curve["kappa"][i - 1])
        worst_kappa = max(worst_kappa, abs(kappa - middle) / abs(middle))
        slope = (curve["kappa"][i] - curve["kappa"][i - 1]) / step
        middle = 0.5 * (curve["slope"][i] + curve["slope"][i - 1])
        worst_slope = max(worst_slope, abs(slope - middle) / abs(middle))
    check("curve: length", abs(length - curve["length"]) < 1e-4 * length, (length, curve["length"]))
    check("curve: curvature is the change of heading", worst_kappa < 2e-3, worst_kappa)
    check("curve: slope is the change of curvature", worst_slope < 2e-2, worst_slope)


def refusals(studio):
    bad = studio.job("fit", {"points": series10(ROOT), "options": {"heading-at": {"5": 170}}})
    check("a refusal", bad["error"]["code"] == 403 and bad.get("curve") is None, bad["error"])
    why = studio.job("why_not", {"points": series10(ROOT), "options": {"heading-at": {"5": 170}}})
    check("why not", why["error"] is not None and why["error"]["advice"] != "", why["error"])
    for request in ({}, {"points": 3}, {"points": [[1]]}, {"points": [["a", "b"]] * 4},
                    {"text": "nothing"}, {"points": series10(ROOT), "options": {"what": 1}},
                    {"points": series10(ROOT), "options": 7}, {"contour": 5}, {"format": 5},
                    {"text": "nothing", "name": 5}, {"points": 3, "samples": 1e300, "file": "no"}):
        for kind in ("fit", "region", "verify", "export", "series"):
            answer = studio.job(kind, request)
            fine = answer["error"] is None and kind == "series" and "points" in request
            check(f"{kind} of {request}", fine or answer["error"] is not None, answer)


def malformed(studio):
    """Requests that are none, some of them cut off; the page is served afterwards."""
    chance = random.Random(1)
    good = (f"POST /api/fit HTTP/1.1\r\nHost: {studio.host}\r\nX-Obvid-Token: {studio.token}\r\n"
            "Content-Length: 60\r\n\r\n" + '{"points":[[0,0],[1,1],[3,2],[6,2]],"options":{}}').encode()
    host, port = studio.host.split(":")
    for _ in range(MALFORMED):
        text = bytearray(good)
        for _ in range(chance.randint(1, 6)):
            at = chance.randrange(max(1, len(text)))
            kind = chance.randrange(4)
            if kind == 0 and at < len(text):
                text[at] = chance.randrange(256)
            elif kind == 1:
                del text[at:at + chance.randint(1, 40)]
            elif kind == 2:
                text[at:at] = bytes(chance.randrange(256) for _ in range(chance.randint(1, 30)))
            else:
                text = text[:max(at, 1)]
        with socket.socket() as link:
            link.settimeout(5)
            link.connect((host, int(port)))
            try:
                link.sendall(bytes(text))
                link.shutdown(socket.SHUT_WR)
                link.recv(200)
            except OSError:
                pass
    check("alive after malformed requests", studio.process.poll() is None, "ended")
    status, _, _ = studio.ask("GET", f"/?token={studio.token}")
    check("the page is served after malformed requests", status == 200, status)
    large = {"X-Obvid-Token": studio.token, "Content-Length": str(10 ** 12)}
    try:
        status, _, _ = studio.ask("POST", "/api/fit", b"", large)
        check("a request of a terabyte", status >= 400, status)
    except OSError:
        pass


def cancelled(studio):
    """A newer request of a page ends the older one; of another page it does not."""
    import threading
    points = [[0.01 * i, 0.3 * random.Random(i).random()] for i in range(30_000)]
    slow = {"points": points, "options": {"noise": 0.05}}
    answers = {}

    def ask(name, page):
        status, _, body = studio.ask("POST", "/api/suggest", json.dumps(slow).encode(),
                                     {"X-Obvid-Token": studio.token, "X-Obvid-Page": page})
        answers[name] = (status, json.loads(body)["error"], time.monotonic())

    older = threading.Thread(target=ask, args=("older", "a"))
    older.start()
    time.sleep(0.5)
    begin = time.monotonic()
    small = json.dumps({"points": series10(ROOT)}).encode()
    studio.ask("POST", "/api/suggest", small, {"X-Obvid-Token": studio.token, "X-Obvid-Page": "a"})
    older.join()
    status, error, ended = answers["older"]
    check("the older request ends", status == 200 and (error or {}).get("code") == 103, error)
    check("and at once", ended - begin < 5, ended - begin)


def endings():
    for by in (signal.SIGINT, signal.SIGTERM):
        with Studio(PROGRAM, FILE) as one, Studio(PROGRAM) as two:
            check("two at once", one.host != two.host and one.token != two.token, one.host)
            check("no file is none", two.job("opened", {})["name"] == "", "")
            check(f"ends by signal {by}", one.end(by) == 0, by)
    made = subprocess.run([PROGRAM, "studio", "missing.csv", "--no-browser"], capture_output=True,
                          text=True)
    check("a missing file", made.returncode == 3 and "E301" in made.stderr, made.stderr)
    with tempfile.TemporaryDirectory() as name:
        folder, ours = Path(name), Path(PROGRAM).parent
        for part in ("obvid", "obvid-studio", "studio.html"):
            shutil.copy(ours / part, folder / part)
        (folder / "studio.html").chmod(0o666)
        made = subprocess.run([folder / "obvid", "studio", "--no-browser"], capture_output=True,
                              text=True, timeout=20, env={**os.environ, "LD_LIBRARY_PATH": str(ours)})
        check("a page that everybody may change is not served",
              made.returncode == 3 and "E301" in made.stderr and not made.stdout, made.stderr)
    made = subprocess.run([PROGRAM, "studio", "--help"], capture_output=True, text=True)
    check("help", made.returncode == 0 and "--port" in made.stdout, made.stdout)


with Studio(PROGRAM, FILE) as running:
    guards(running)
    says_what_the_program_says(running)
    reads_what_the_cad_kernel_reads(running)
    curve_is_the_contour(running)
    refusals(running)
    cancelled(running)
    malformed(running)
endings()
print("\n".join(failures) or "all good")
sys.exit(1 if failures else 0)
