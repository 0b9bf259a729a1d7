# SPDX-License-Identifier: Apache-2.0
"""The page that holds its engine (tools/build_web), opened from a folder in Chromium and in Firefox:
it proves, drags, exports what the program proves again, and says of public files what the program says.
usage: web_test.py OBVID PROJECT_FOLDER PAGE chromium|firefox     exit code 77: page or browser is missing"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from browser import Browser
from firefox import Firefox
from studio import series10

PROGRAM, ROOT, PAGE, NAME = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]), sys.argv[4]
SKIPPED = 77
MOST_BYTES = 900_000  # of the page, gzip -9
KINDS = {"chromium": ("chromium", Browser), "firefox": ("firefox-esr", Firefox)}
FOLDERS = ("examples", "tests/data/airfoils", "tests/data/found", "tests/data/paper", "tests/data/published",
           "tests/data/refuse")
PUBLIC = ("airfoils_uiuc_selig", "outlines_momocs", "hulls_offset_tables", "rail_wheel_profiles", "tracks_tum",
          "cad_dxf", "cad_svg", "gps_gpx", "landxml", "roads_opendrive", "tracks_f1_geojson")
EACH, LARGEST = 6, 60_000  # files of a folder, bytes
FEWEST = 40  # files that were compared
failures = []


def check(what, holds, seen=""):
    if not holds:
        failures.append(f"{what}: {str(seen)[:300]}")


def said_by_program(path):
    """Code of its refusal or 0, and the counts of its contour."""
    made = subprocess.run([PROGRAM, "fit", path, "--json"], capture_output=True, timeout=300)
    code = re.search(rb"error E(\d+)", made.stderr)
    report = json.loads(made.stdout) if made.stdout else None
    in_space = report is not None and "certificate" not in report
    return int(code.group(1)) if code else 0, counts(None if in_space else report), in_space


def counts(report):
    """All but the number of pieces: last bits of sines decide where the region is narrowed."""
    if not report:
        return None
    keys = ("proved", "vertices", "inflections", "corners", "curvature_steps")
    return ([report[k] for k in ("carrier", "continuity", "points")] + [report["certificate"][k] for k in keys]
            + [report["report"]["vertices_lower_bound"]])


def files():
    shared = ROOT.parent / "shared/data"
    for folder in [ROOT / f for f in FOLDERS] + [shared / f for f in PUBLIC]:
        found = [p for p in sorted(folder.rglob("*")) if p.is_file() and p.stat().st_size <= LARGEST
                 and p.suffix.lower() in (".csv", ".txt", ".dat", ".json", ".dxf", ".svg", ".gpx", ".xml", ".xodr",
                                          ".geojson")]
        yield from found[::max(1, len(found) // EACH)][:EACH]


def opens(page):
    page.wait("window.studio && studio.fitted.value && studio.current.value", 60)
    page.run("document.querySelector('#tour-end')?.click()")
    check("opened from a folder", page.run("location.protocol") == "file:")
    check("holds its engine", page.run("studio.engine.inPage"))
    check("series10", page.run("studio.doc.value.points") == series10(ROOT))
    check("proved", page.run("document.querySelector('#verdict').className") == "good")
    page.wait("studio.engine.startup !== null")
    print(f"{NAME}: the engine answers {page.run('studio.engine.startup'):.0f} ms after its start")


def drags(page):
    for index, far in ((4, (-12, 9)), (6, (8, -15)), (2, (3, 4))):
        before = page.run("studio.fitted.value.answer.report.report.segments")
        x, y = page.run(f"studio.place(studio.doc.value.points[{index}])")
        page.press(x, y)
        page.mouse("mouseMoved", x + far[0] / 2, y + far[1] / 2, button="left", buttons=1)
        page.mouse("mouseMoved", x + far[0], y + far[1], button="left", buttons=1)
        page.release(x + far[0], y + far[1])
        page.wait("studio.current.value && studio.fitted.value.answer.contour", 30)
        check("dragged", page.run(f"studio.doc.value.points[{index}]") != series10(ROOT)[index])
        check("formed anew", page.run("studio.fitted.value.answer.report.report.segments") != before)
        text = page.run("studio.engine.call('export', {contour: studio.fitted.value.answer.contour, format: 'json'})"
                        ".then((a) => a.files[0].text)")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "dragged.json"
            path.write_text(text)
            made = subprocess.run([PROGRAM, "verify", path, "--json"], capture_output=True, text=True)
        theirs = json.loads(made.stdout)["certificate"]
        ours = page.run("studio.fitted.value.answer.report.certificate")
        same = all(theirs[k] == ours[k] for k in ("proved", "vertices", "inflections"))
        good = page.run("document.querySelector('#verdict').className") == "good"
        check("the program proves it again", same and good == ours["proved"] == (made.returncode == 0), (theirs, ours))


def agrees(page):
    """Of public files the page says what the program says: the same refusal, the same counts."""
    compared = contours = 0
    for path in files():
        try:
            text = path.read_bytes().decode()
        except UnicodeDecodeError:
            continue  # the program reads it, a page is given text
        code, theirs, in_space = said_by_program(path)
        if in_space:
            continue  # the studio is one of the plane
        answer = page.run("studio.engine.call('fit', " + json.dumps(
            {"text": text, "name": path.name, "options": {}, "file": False}) + ")"
            ".then((a) => ({error: a.error, report: a.report}))", 120)
        ours = counts(answer.get("report"))
        said = answer["error"]["code"] if answer["error"] else 0
        compared += 1
        contours += theirs is not None
        check(f"{path}", (said, ours) == (code, theirs), ((said, ours), (code, theirs)))
    check("files were compared", compared >= FEWEST and contours >= FEWEST / 2, (compared, contours))
    print(f"{NAME}: {compared} files, {contours} contours, as the program says")


def stays_free(page):
    """While the engine works for long, the page goes on and so does a drag's engine."""
    seen = page.run("""(async () => {
      const points = Array.from({length: 400}, (_, i) => [i, 20 * Math.sin(0.05 * i)]);
      let over = false, ticks = 0, fits = 0;
      const slow = studio.engine.call('compare', {points, options: {}}).then((a) => { over = true; return a.error; });
      const timer = setInterval(() => { ++ticks; }, 5);
      while (!over && fits < 1000) {
        await studio.engine.call('fit', {points: studio.doc.value.points, options: {}, file: false});
        if (!over) ++fits;
      }
      clearInterval(timer);
      return [ticks, fits, await slow];
    })()""", 120)
    check("timers run and contours are formed meanwhile", seen[0] > 5 and seen[1] > 5 and seen[2] is None, seen)


def gives_up(page):
    """A request that takes long ends for a newer one of its kind, and the next contour is there soon."""
    got = page.run("""(async () => {
      const many = Array.from({length: 60000}, (_, i) => [i, 300 * Math.sin(0.001 * i) + 0.2 * Math.sin(7.3 * i)]);
      const begin = performance.now(), request = {points: studio.doc.value.points, options: {}, file: false};
      const ask = (points, options) => studio.engine.call('fit', {...request, points, options}).then((a) => a.error ? a.error.code : 0);
      const older = ask(many, {noise: 0.5});
      await new Promise((r) => setTimeout(r, 100));
      const newer = ask(request.points, {});
      return [await older, await newer, performance.now() - begin];
    })()""", 120)
    check("the older one is given up", got[:2] == [103, 0], got)
    print(f"{NAME}: a contour {got[2]:.0f} ms after one of 60,000 points was begun")


def recovers(page):
    """An engine that breaks down is told of and replaced."""
    got = page.run("""(async () => {
      const request = {points: studio.doc.value.points, options: {}, file: false};
      const ask = () => studio.engine.call('fit', request).then((a) => a.error ? a.error.code : 0, () => 'broken');
      const post = Worker.prototype.postMessage;
      Worker.prototype.postMessage = function () { post.call(this, null); };
      const first = ask();
      Worker.prototype.postMessage = post;
      return [await first, await ask()];
    })()""", 120)
    check("a breakdown is told, another engine takes over", got == ["broken", 0], got)


def refuses(page):
    page.run("""(() => { const data = new DataTransfer();
      data.items.add(new File(['ISO-10303-21;'], 'part.step'));
      document.querySelector('main').dispatchEvent(
        new DragEvent('drop', {dataTransfer: data, bubbles: true, cancelable: true})); })()""")
    page.wait("document.querySelector('#message')?.textContent.includes('obvid fit part.step')")
    check("nothing can be sent", page.run(
        "fetch('http://127.0.0.1:9/').then(() => 'sent', (e) => 'refused')") == "refused")
    check("nothing was fetched", page.run(
        "performance.getEntriesByType('resource').filter((e) => e.name.startsWith('http')).length") == 0)


command, kind = KINDS[NAME]
if not PAGE.is_file():
    print(f"SKIPPED: {PAGE} is not there; tools/build_web makes it")
    sys.exit(SKIPPED)
if not shutil.which(command):
    print(f"SKIPPED: {command} is not installed")
    sys.exit(SKIPPED)
size = len(subprocess.run(["gzip", "-9", "-c", PAGE], capture_output=True, check=True).stdout)
check("the page is small", size <= MOST_BYTES, size)
with tempfile.TemporaryDirectory() as place:
    copied = Path(place) / "studio.html"
    shutil.copy(PAGE, copied)
    with kind(copied.as_uri()) as opened:
        for part in (opens, drags, stays_free, gives_up, agrees, recovers, refuses):
            part(opened)
        check("no error in the page", not getattr(opened, "trouble", []), getattr(opened, "trouble", [])[:3])
print("\n".join(failures) or f"all good, {size} bytes compressed")
sys.exit(1 if failures else 0)
