# SPDX-License-Identifier: Apache-2.0
"""The studio's page in a real browser: every control, drags whose contours the program proves
again, operations undone, pasted and dropped files, refusals.
usage: page_test.py OBVID PROJECT_FOLDER AXE_SCRIPT | OBVID PROJECT_FOLDER --pictures FOLDER"""
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from browser import CTRL, Browser
from studio import Studio, series10

PROGRAM, ROOT = sys.argv[1], Path(sys.argv[2])
PICTURES = Path(sys.argv[4]) if sys.argv[3] == "--pictures" else None
AXE = Path(sys.argv[3])
FILE, AIRFOIL = ROOT / "examples/series10.csv", "tests/data/airfoils/ag12.dat"
DRAGS, OPERATIONS = 200, 1000
failures = []
os.environ.setdefault("OBVID_LIBRARY", str(Path(PROGRAM).resolve().parent / "libobvid_c.so"))
sys.path.insert(0, str(ROOT / "bindings/python"))


def check(what, holds, seen=""):
    if not holds:
        failures.append(f"{what}: {str(seen)[:300]}")


class Page(Browser):
    def __init__(self, address):
        super().__init__(address)
        self.wait("window.studio && studio.fitted.value && studio.current.value")
        self.run("document.querySelector('#tour-end')?.click()")

    def settled(self):
        """What is drawn and said is of the document as it is."""
        self.wait("studio.current.value && "
                  "!document.querySelector('#verdict').className.includes('waiting')", 60)

    def doc(self):
        return self.run("studio.doc.value")

    def verdict(self):
        return self.run("document.querySelector('#verdict').className")

    def point(self, index):
        return self.run(f"studio.place(studio.doc.value.points[{index}])")

    def answer(self):
        return self.run("({error: studio.fitted.value.answer.error,"
                        " report: studio.fitted.value.answer.report,"
                        " contour: studio.fitted.value.answer.contour})")

    def drag(self, start, end, steps=3):
        self.press(*start)
        for k in range(1, steps + 1):
            self.mouse("mouseMoved", start[0] + (end[0] - start[0]) * k / steps,
                       start[1] + (end[1] - start[1]) * k / steps, button="left", buttons=1)
        self.release(*end)
        self.settled()


def proves(text, folder):
    path = Path(folder) / "drawn.json"
    path.write_text(text)
    made = subprocess.run([PROGRAM, "verify", path, "--json"], capture_output=True, text=True)
    return made.returncode, json.loads(made.stdout)


def opens(page):
    check("opens with its file", page.doc()["points"] == series10(ROOT), page.doc())
    check("proved", page.verdict() == "good", page.verdict())
    check("the drawing is not empty", page.run(
        "[...document.querySelector('#drawing').getContext('2d').getImageData(0, 0, 600, 400).data]"
        ".some((v) => v > 0)"))
    check("the plot is drawn", page.run("document.querySelector('#plot canvas') !== null"))
    check("as many rows as segments",
          page.run("document.querySelectorAll('#segments tbody tr').length") == 9)


def drags(page):
    """Each contour that is called proved is, says the program from its file alone."""
    chance, drawn, proved = random.Random(5), 0, 0
    page.click_on("#fit")
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(DRAGS):
            index = chance.randrange(10)
            start = page.point(index)
            far, way = chance.uniform(2, 60), chance.uniform(0, 2 * math.pi)
            page.drag(start, (start[0] + far * math.cos(way), start[1] + far * math.sin(way)))
            check("the point moved", page.doc()["points"][index] != series10(ROOT)[index], index)
            answer = page.answer()
            if answer.get("contour") is None:
                check("what is not drawn is refused", answer["error"] and page.verdict() == "bad",
                      page.verdict())
            else:
                drawn += 1
                good = page.verdict() == "good"
                proved += good
                code, again = proves(answer["contour"], folder)
                theirs, ours = again["certificate"], answer["report"]["certificate"]
                same = all(theirs[k] == ours[k] for k in ("proved", "vertices", "inflections"))
                check("the program proves it again", same and good == ours["proved"]
                      and (code == 0) == good, (code, theirs, ours))
            page.click_on("#undo")
            page.settled()
    check("most drags give a contour", drawn > DRAGS / 2, drawn)
    print(f"{DRAGS} drags, {drawn} contours drawn, {proved} proved, each proved again by the program")
    check("undone to the file", page.doc()["points"] == series10(ROOT), page.doc()["points"])


def undoing(page):
    """Random operations by the keyboard and the controls, then all of them undone."""
    chance = random.Random(6)
    while page.run("!document.querySelector('#undo').disabled"):
        page.click_on("#undo")
    page.click_on("#redo")  # as the file was opened
    before = page.doc()
    page.run("document.querySelector('#drawing').focus()")
    steps = page.run(f"""(async () => {{
      const canvas = document.querySelector('#drawing');
      let seed = 7;
      const next = (n) => {{ seed = (seed * 1103515245 + 12345) % 2147483648; return seed % n; }};
      const key = (name, more = {{}}) => canvas.dispatchEvent(
        new KeyboardEvent('keydown', {{key: name, bubbles: true, ...more}}));
      const set = (id, value) => {{ const e = document.querySelector(id);
        e.value = value; e.dispatchEvent(new Event('change', {{bubbles: true}})); }};
      for (let i = 0; i < {OPERATIONS}; ++i) {{
        const kind = next(8);
        if (kind < 3) {{ key('Tab'); key(['ArrowLeft', 'ArrowUp', 'ArrowRight', 'ArrowDown'][next(4)]); }}
        else if (kind === 3) {{ key('Tab'); key('c'); }}
        else if (kind === 4) set('#carrier', ['spiral', 'arcs', 'conics'][next(3)]);
        else if (kind === 5) set('#noise', String(next(5) / 100));
        else if (kind === 6) set('#closing', ['auto', 'open'][next(2)]);
        else if (studio.doc.value.points.length > 6) {{ key('Tab'); key('Delete'); }}
        if (i % 50 === 0) await new Promise((r) => setTimeout(r));
      }}
      let undone = 0;
      while (!document.querySelector('#undo').disabled && undone < 5000) {{
        window.dispatchEvent(new KeyboardEvent('keydown', {{key: 'z', ctrlKey: true}}));
        ++undone;
        if (undone % 20 === 0) await new Promise((r) => setTimeout(r));
        else await Promise.resolve();
      }}
      return undone;
    }})()""", 120)
    check("operations were done", steps > OPERATIONS / 2, steps)
    # the first step that can be undone is the opening of the file
    page.key("y", CTRL)
    page.settled()
    check("undone to the very document", page.doc() == before, "differs")
    del chance


def controls(page):
    def options():
        return page.doc()["options"]
    for carrier in ("arcs", "conics", "beziers", "clothoids", "bspline", "cubic", "baseline", "spiral"):
        page.choose("#carrier", carrier)
        page.settled()
        answer = page.answer()
        check(f"carrier {carrier}", options()["carrier"] == carrier and (
            answer.get("report") is None or answer["report"]["carrier"] == carrier), answer["error"])
    page.choose("#continuity", "G2")
    page.settled()
    check("G2", page.answer()["report"]["continuity"] == "G2", page.answer()["report"]["continuity"])
    page.choose("#continuity", "G3")
    page.write("#noise", "0,05")
    page.settled()
    check("noise with a decimal comma", options()["noise"] == 0.05, options())
    page.write("#noise", "")
    page.write("#tolerance", "0.01")
    page.settled()
    check("tolerance", page.answer()["report"]["report"]["tolerance"] == 0.01, options())
    page.write("#tolerance", "")
    for box in ("#convex", "#primitives", "#corners"):
        before = page.run(f"document.querySelector('{box}').checked")
        page.click_on(box)
        page.settled()
        check(f"{box} by mouse", page.run(f"document.querySelector('{box}').checked") != before)
        page.run(f"document.querySelector('{box}').focus()")
        page.key(" ")
        page.settled()
        check(f"{box} by keyboard", page.run(f"document.querySelector('{box}').checked") == before)
    page.choose("#closing", "open")
    page.settled()
    check("open", options()["closing"] == "open")
    page.choose("#units", "in")
    page.settled()
    check("inches", page.answer()["report"]["units"] == "in", page.answer()["report"])
    page.choose("#units", "mm")
    page.choose("#closing", "auto")
    for what in ("slope", "radius", "curvature"):
        page.choose("#what", what)
        check(f"plot of {what}", page.run("document.querySelector('#plot canvas') !== null"))
    theme = page.run("document.documentElement.dataset.theme")
    page.click_on("#theme")
    check("theme", page.run("document.documentElement.dataset.theme") != theme)
    page.click_on("#theme")
    page.click_on("#language")
    page.wait("document.querySelector('h1').textContent.includes('Студія')")
    page.wait("document.querySelector('#verdict').textContent.includes('доведено')")
    page.click_on("#language")
    for tab, rows in (("compare", 8), ("noise", 1), ("segments", 9)):
        page.click_on(f"#tab-{tab}")
        table = {"compare": "#compared", "noise": "#suggested", "segments": "#segments"}[tab]
        page.wait(f"document.querySelectorAll('{table} tbody tr').length >= {rows}", 60)


def points(page):
    page.click(*page.point(4))
    page.settled()
    check("selected by a click", page.run("studio.selected.value") == 4)
    page.wait("studio.region.value")
    low, high = page.run("(() => { const p = studio.region.value.points.find((p) => p.index === 4);"
                         "return [p.heading_low, p.heading_high]; })()")
    low, high = math.degrees(low), math.degrees(high)
    inside = low + 0.3 * (high - low)
    page.write("#heading", repr(inside))
    page.settled()
    check("a heading inside the range does", page.verdict() == "good", page.verdict())
    page.write("#heading", repr(high + 0.5 * (high - low)))
    page.settled()
    check("beyond it is refused", page.verdict() == "bad" and page.answer()["error"]["code"] == 403,
          page.answer()["error"])
    page.wait("document.querySelector('#shown .hint')")  # the last contour stays, greyed
    page.click_on("#why")
    page.wait("document.querySelector('#message')?.textContent.includes('point')", 30)
    page.click_on("#dismiss")
    page.write("#heading", "")
    page.settled()
    check("free again", page.verdict() == "good", page.verdict())
    before = page.doc()["points"][4]
    page.write("#x", repr(before[0] + 1.5))
    page.settled()
    check("x by number", page.doc()["points"][4][0] == before[0] + 1.5, page.doc()["points"][4])
    page.click_on("#undo")
    page.settled()
    check("undo by mouse", page.doc()["points"][4] == before)
    page.click_on("#redo")
    page.settled()
    check("redo by mouse", page.doc()["points"][4][0] == before[0] + 1.5)
    page.click_on("#undo")
    page.settled()
    x, y = page.point(9)
    page.click(x - 60, y - 45, 2)
    page.settled()
    check("a double click adds a point", len(page.doc()["points"]) == 11, len(page.doc()["points"]))
    page.click_on("#remove")
    page.settled()
    check("and a button removes it", page.doc()["points"] == series10(ROOT), page.doc()["points"])


def bends(page):
    """The radius by the mouse: inside the range it is proved, beyond it refused."""
    page.click(*page.point(4))
    page.wait("studio.region.value && studio.region.value.of === studio.doc.value")
    low, high = page.run("(() => { const p = studio.region.value.points.find((p) => p.index === 4);"
                         "return [p.kappa_low, p.kappa_high]; })()")
    start, inside = page.run("studio.bendPlace()"), page.run(f"studio.bendPlace({low + 0.5 * (high - low)!r})")
    page.drag(start, inside)
    radius = page.doc()["given"][4]["radius"]
    check("a radius by the mouse", low < 1 / radius < high, (low, 1 / radius, high))
    check("inside the range it does", page.verdict() == "good", page.verdict())
    page.drag(page.run("studio.bendPlace()"), page.run(f"studio.bendPlace({low - 2 * (high - low)!r})"))
    radius = page.doc()["given"][4]["radius"]
    check("a radius beyond", 1 / radius < low, (radius, low))
    check("beyond it is refused", page.verdict() == "bad" and page.answer()["error"]["code"] == 403, page.answer()["error"])
    for _ in range(2):
        page.click_on("#undo")
        page.settled()
    check("both undone", page.doc()["given"][4] == {}, page.doc()["given"][4])


PROBE = """(async () => {
  const doc = studio.doc.value, at = %d, found = studio.region.value.points.find((p) => p.index === at), out = [];
  const degrees = (v) => v * 180 / Math.PI, usual = studio.fitted.value.answer.report.report.inflections;
  // ranges of curvatures are those at the headings of the contour
  const headings = Object.fromEntries(studio.region.value.points.map((p) => [p.index + 1, degrees(p.heading)]));
  const ask = async (name, value) => {
    const options = {units: doc.units, ...(name === 'kappa-at' ? {'heading-at': headings} : {}), [name]: {[at + 1]: value}};
    const a = await studio.engine.call('fit', {points: doc.points, options, file: false});
    return a.error === null && a.report.certificate.proved && a.report.report.inflections <= usual;
  };
  const sides = (low, high, name, as) => {
    const inner = low === null ? high - 1 : high === null ? low + 1 : null, width = inner === null ? high - low : Math.abs(low ?? high);
    if (name === 'heading-at' && width > 6.1) return; // nearly every heading
    if (low !== null) out.push([name, low + 0.01 * width, true, as], [name, low - 0.01 * width, false, as]);
    if (high !== null) out.push([name, high - 0.01 * width, true, as], [name, high + 0.01 * width, false, as]);
  };
  sides(found.heading_low_open ? null : found.heading_low, found.heading_high_open ? null : found.heading_high, 'heading-at', degrees);
  sides(found.kappa_low, found.kappa_high, 'kappa-at', (v) => v);
  const wrong = [];
  for (const [name, value, wanted, as] of out) if (await ask(name, as(value)) !== wanted) wrong.push([name, value, wanted]);
  return [out.length, wrong];
})()"""


def ranges_are_right(page):
    """What is shown as possible is: one per cent inside is proved; one per cent outside is refused or
    needs another inflection; after drags too."""
    chance, probes = random.Random(8), 0
    for index in range(10):
        page.click(*page.point(index))
        if index in (2, 5, 7):
            start = page.point(index)
            page.drag(start, (start[0] + chance.uniform(-4, 4), start[1] + chance.uniform(-4, 4)))
            if page.verdict() != "good":
                page.click_on("#undo")
                page.settled()
        page.wait("studio.region.value && studio.region.value.of === studio.doc.value")
        asked, wrong = page.run(PROBE % index, 120)
        probes += asked
        check(f"ranges at point {index + 1}", not wrong, wrong)
        shown = page.run("document.querySelector('#headings').textContent")
        low = page.run(f"studio.region.value.points.find((p) => p.index === {index}).heading_low")
        if low is not None:
            degrees = float(shown.split(":")[1].split("°")[0])
            check("the range that is written", abs(math.remainder(degrees - math.degrees(low), 360)) < 0.0051, (shown, low))
    check("ranges were probed", probes > 50, probes)
    while page.run("!document.querySelector('#undo').disabled"):
        page.click_on("#undo")
    page.click_on("#redo")
    page.settled()


def given_ranges(page):
    """Headings and radii as ranges, a criterion; all of it is kept by what is copied and by undo."""
    before = page.doc()
    page.click(*page.point(4))
    page.write("#heading", "40 .. 80")
    page.settled()
    check("a range of headings", page.doc()["given"][4]["heading"] == [40, 80], page.doc()["given"][4])
    check("it is kept", page.verdict() == "good", page.answer()["error"])
    heading = page.run("(() => { const c = studio.fitted.value.answer.curve; return c.heading[4 * c.samples]; })()")
    check("within the range", 40 - 1e-9 <= math.degrees(math.remainder(heading, 2 * math.pi)) <= 80 + 1e-9, math.degrees(heading))
    page.write("#radius", "-100..-20,5")
    page.settled()
    check("a range of radii", page.doc()["given"][4]["radius"] == [-100, -20.5], page.doc()["given"][4])
    page.write("#radius", "what")
    check("what is no range changes nothing", page.doc()["given"][4]["radius"] == [-100, -20.5], page.doc()["given"][4])
    page.write("#radius", "")
    page.write("#heading", "")
    for name in ("centre", "least-change", "least-curvature", "fair"):
        page.choose("#prefer", name)
        page.settled()
        check(f"criterion {name}", page.doc()["options"]["prefer"] == name and page.verdict() == "good", page.answer()["error"])
    check("as before", page.doc()["points"] == before["points"] and page.doc()["given"] == before["given"], page.doc()["given"])


def explained(page):
    """Every control and every word of a table or of the verdict says what it means."""
    for language in ("en", "uk"):
        for tab in ("compare", "noise", "segments"):
            page.click_on(f"#tab-{tab}")
            page.wait({"compare": "document.querySelector('#compared')", "noise": "document.querySelector('#suggested')",
                       "segments": "document.querySelector('#segments')"}[tab], 60)
            mute = page.run("[...document.querySelectorAll('button, select, input, th, .fact')].filter((e) =>"
                            " !e.closest('[title]')?.title && !e.closest('[role=dialog]')).map((e) => e.outerHTML.slice(0, 80))")
            check(f"explained, {language}, {tab}", not mute, mute)
        page.click_on("#language")


def by_the_keyboard(page):
    """Tab reaches every control, one after another."""
    page.click_on("#tab-segments")
    wanted = page.run("[...document.querySelectorAll('button, select, input, canvas#drawing, #plot')].filter((e) => !e.disabled"
                      " && e.offsetParent !== null).map((e) => e.id)")
    check("controls have names", all(wanted) and len(set(wanted)) == len(wanted), wanted)
    page.run("document.activeElement.blur(); window.getSelection().removeAllRanges(); document.body.focus()")
    seen = []
    for _ in range(len(wanted) + 30):  # the drawing takes a Tab for each point
        page.key("Tab")
        seen.append(page.run("document.activeElement.id"))
    check("reached by the keyboard", not set(wanted) - set(seen), set(wanted) - set(seen))
    page.run("document.querySelector('#theme').focus()")
    theme = page.run("document.documentElement.dataset.theme")
    page.key("Enter")
    check("and used", page.run("document.documentElement.dataset.theme") != theme)
    page.key("Enter")
    page.key("Escape")


def by_fingers(page):
    """Two fingers zoom the drawing about the place between them and drag no point."""
    before, points_before = page.point(4), page.doc()["points"]
    far = math.dist(page.point(4), page.point(9))
    x, y = page.point(5)

    def touch(kind, *at):
        page.call("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": px, "y": py, "id": i} for i, (px, py) in enumerate(at)])
    touch("touchStart", (x, y))
    touch("touchStart", (x, y), (x + 80, y))
    for k in range(1, 9):
        touch("touchMove", (x - 5 * k, y), (x + 80 + 5 * k, y))
    touch("touchEnd")
    check("two fingers zoom", 1.6 < math.dist(page.point(4), page.point(9)) / far < 2.4, math.dist(page.point(4), page.point(9)) / far)
    check("no point was moved", page.doc()["points"] == points_before, before)
    page.click_on("#fit")
    page.settled()


def documents(page):
    """The document as a file: points, what is given, options; it comes back as it was."""
    page.click(*page.point(4))
    page.write("#heading", "40..80")
    page.choose("#prefer", "centre")
    page.write("#noise", "rounding")
    page.choose("#carrier", "conics")
    page.settled()
    wanted = page.doc()
    page.choose("#save", "job.json")
    page.wait("document.querySelector('#preview pre')")
    text = page.run("document.querySelector('#preview pre').textContent")
    page.click_on("#preview-close")
    for _ in range(4):
        page.click_on("#undo")
    page.settled()
    check("undone", page.doc() != wanted)
    page.run(f"""(() => {{ const data = new DataTransfer();
      data.items.add(new File([{json.dumps(text)}], {json.dumps(wanted['name'])}));
      document.querySelector('main').dispatchEvent(
        new DragEvent('drop', {{dataTransfer: data, bubbles: true, cancelable: true}})); }})()""")
    page.wait("studio.doc.value.options.carrier === 'conics'")
    page.settled()
    check("the document again", page.doc() == wanted, page.doc())
    page.click_on("#undo")
    page.settled()


def around(page):
    """Neighbouring circles and limiting arcs of a point; points, cursor and tables by the keyboard."""
    ink = ("[...document.querySelector('#drawing').getContext('2d').getImageData(0, 0, 900, 600).data]"
           ".reduce((s, v, i) => (s * 31 + v * (i % 97)) % 1000003, 7)")
    frame = "new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(r)))"
    page.run("document.querySelector('#drawing').focus()")
    page.click(*page.point(5))
    x, y = page.point(5)
    page.mouse("mouseMoved", x + 120, y + 90)
    page.run(frame)
    without = page.run(ink)
    page.mouse("mouseMoved", x, y)
    page.run(frame)
    check("circles of the point under the mouse", page.run(ink) != without)
    page.mouse("mouseMoved", x + 120, y + 90)
    page.run(frame)
    check("and none beside it", page.run(ink) == without)
    page.key("a")
    page.run(frame)
    check("by the keyboard", page.run(ink) != without)
    page.key("a")
    three = page.run("studio.adjacent(studio.doc.value, false, 5)")
    points = series10(ROOT)
    for p in points[4:7]:
        check("the circle passes the three points", min(math.dist(p, q) for q in three["circle"]) < 3.0, p)
    kappa = bend(points[4:7])
    for k in range(1, len(three["circle"]) - 1):
        q = three["circle"][k - 1:k + 2]
        if min(math.dist(a, b) for a, b in zip(q, q[1:])) > 1e-6:
            check("it is one circle", abs(bend(q) - kappa) < 1e-6 * abs(kappa), (k, bend(q), kappa))
    wanted = sorted((bend(points[3:6]), kappa, kappa, bend(points[5:8])))
    got = sorted(bend(arc[20:23]) for arc in three["arcs"])
    check("arcs of both circles on both segments", all(abs(a - b) < 1e-6 * abs(b) for a, b in zip(got, wanted)), (got, wanted))
    page.key("n")
    page.settled()
    middle = [0.5 * (a + b) for a, b in zip(points[5], points[6])]
    check("a point by the keyboard", len(page.doc()["points"]) == 11 and math.dist(page.doc()["points"][6], middle) < 1e-9,
          page.doc()["points"][6])
    page.key("z", CTRL)
    page.settled()
    page.run("document.querySelector('#plot').focus()")
    page.key("Home")
    page.key("ArrowRight")
    page.key("ArrowRight")
    check("the cursor by the keyboard", page.run("studio.hovered.value") == 2, page.run("studio.hovered.value"))
    page.click_on("#tab-noise")
    page.wait("document.querySelector('#trade-off circle')", 60)
    rows = page.run("document.querySelectorAll('#suggested tbody tr').length")
    check("a place of the curve for each row", page.run("document.querySelectorAll('#trade-off circle').length") == rows, rows)
    page.run("document.querySelectorAll('#trade-off circle')[1].dispatchEvent(new MouseEvent('click', {bubbles: true}))")
    page.settled()
    taken, told = page.doc()["options"]["noise"], page.run("document.querySelectorAll('#suggested tbody td')[2].textContent")
    check("a click takes the noise of the row", abs(taken - float(told)) < 1e-9, (taken, told))
    page.run("(() => { const s = document.querySelector('#noise-slider'); s.value = '2'; s.dispatchEvent(new Event('change', {bubbles: true})); })()")
    page.settled()
    check("so does the slider", page.doc()["options"]["noise"] > taken, page.doc()["options"]["noise"])
    page.click_on("#undo")
    page.click_on("#undo")
    page.settled()
    page.click_on("#verdict b")
    page.wait("document.querySelector('#segments')")
    page.click_on("#details")
    page.wait("document.querySelector('#segments')")


def writes(page):
    """What is saved is shown before, and has the bytes of the program."""
    page.run("(() => { window.saved = []; let made; const make = URL.createObjectURL; URL.createObjectURL = (b) => {"
             " made = b; return make.call(URL, b); }; HTMLAnchorElement.prototype.click = function () {"
             " const name = this.download; saved.push(made.text().then((text) => [name, text])); }; })()")
    with tempfile.TemporaryDirectory() as folder:
        for choice, command, name in (("contour.dxf", "fit", "series10.dxf"), ("contour.svg", "fit", "series10.svg"),
                                      ("contour.step", "fit", "series10.step"), ("sheet.tex", "region", "series10-region.tex")):
            page.choose("#save", choice)
            page.wait("document.querySelector('#preview-save')")
            if choice.endswith("svg"):
                page.wait("document.querySelector('#preview img').naturalWidth > 100")
            else:
                shown = page.run("document.querySelector('#preview pre').textContent")
                check(f"{choice} is shown", len(shown) > 200, len(shown))
            page.click_on("#preview-save")
            page.wait("!document.querySelector('#preview')")
            target = Path(folder) / ("o." + choice.split(".")[1])
            subprocess.run([PROGRAM, command, FILE, "--units", "mm", "-o", target], capture_output=True, check=True)
            check(f"{choice} was saved", page.run("saved.length") == 1)
            called, text = page.run("saved.pop()") if page.run("saved.length") else ("", "")
            stamp = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d|[\d.]+ ms")
            check(f"{choice}: name", called == name, called)
            check(f"{choice}: the bytes of the program", stamp.sub("", text) == stamp.sub("", target.read_bytes().decode()), len(text))
    page.choose("#save", "contour.csv")
    page.wait("document.activeElement.id === 'preview-save'")
    page.key("Escape")
    page.wait("!document.querySelector('#preview')")


def overlays(page):
    """Another curve below this one, from a contour file, a drawing or points."""
    contour = page.answer()["contour"]
    for name, text, far in (("c.json", contour, 1e-6), ("p.csv", FILE.read_text(), 1e-6),
                            ("moved.csv", FILE.read_text().replace("95.0", "96.0"), 50)):
        page.run("studio.kept.value = null")
        page.run(f"""(() => {{ const data = new DataTransfer(), box = document.querySelector('#overlay');
          data.items.add(new File([{json.dumps(text)}], {json.dumps(name)})); box.files = data.files;
          box.dispatchEvent(new Event('change', {{bubbles: true}})); }})()""")
        page.wait("document.querySelector('#apart')")
        away = float(page.run("document.querySelector('#apart').textContent").split()[-2])
        check(f"overlay of {name}", away <= far, away)
    page.run("studio.kept.value = null")
    step = ROOT / "tests/data/judge/series10.step"
    if (Path(PROGRAM).parent / "obvid-cad").exists():
        page.run(f"""(() => {{ const data = new DataTransfer();
          data.items.add(new File([{json.dumps(step.read_text())}], 'series10.step'));
          document.querySelector('main').dispatchEvent(
            new DragEvent('drop', {{dataTransfer: data, bubbles: true, cancelable: true}})); }})()""")
        page.wait("studio.doc.value.name === 'series10.step'")
        page.settled()
        check("a STEP file is read", len(page.doc()["points"]) > 9, page.doc()["points"])
        page.click_on("#undo")
        page.settled()
    else:
        print("SKIPPED: STEP files, the helper of the CAD kernel is not built")


def places_of(arcs, count):
    """`count` places after the start of each arc, and its start before the first: as the page has them."""
    x, y = arcs[0][:2]
    out = [(x, y)]
    for x, y, heading, kappa, length in arcs:
        for k in range(1, count + 1):
            s = length * k / count
            reach = s if abs(kappa * s) < 1e-12 else 2 * math.sin(0.5 * kappa * s) / kappa
            out.append((x + reach * math.cos(heading + 0.5 * kappa * s), y + reach * math.sin(heading + 0.5 * kappa * s)))
    return out


def compare_regions(curve, sides):
    """The page reckons boundaries for itself, sixty times a second (docs/decisions/0016): they are those of the engine."""
    import obvid

    each = curve["samples"]
    for piece, drawn in enumerate(sides):
        ends = [(*curve["xy"][2 * i:2 * i + 2], curve["heading"][i], curve["kappa"][i])
                for i in (piece * each, (piece + 1) * each - 1)]
        told, size = obvid.region_arcs(*ends), math.dist(ends[0][:2], ends[1][:2])
        check("the engine has a region, too", told is not None, piece)
        for side, arcs in zip(drawn, told or ()):
            wanted = places_of(arcs, (len(side) - 1) // len(arcs))
            check("the boundaries of the engine", len(wanted) == len(side) and
                  max(map(math.dist, side, wanted)) < 1e-9 * size, (piece, arcs, side[:2], wanted[:2]))


def shades(page):
    """The region is drawn, as wide as it is told; the contour lies inside it."""
    page.click_on("#shade")
    page.wait("document.querySelector('#magnified')?.textContent.includes('×')")
    sides = page.run("studio.regions(studio.fitted.value.answer.curve)")
    curve = page.run("studio.fitted.value.answer.curve")
    check("a region for each piece", len(sides) == 9 and all(sides), len(sides))
    each = curve["samples"]
    compare_regions(curve, sides)
    for piece, (one, other) in enumerate(sides):
        xy = [curve["xy"][2 * i:2 * i + 2] for i in range(piece * each, (piece + 1) * each)]
        for side in (one, other):
            check("from end to end", math.dist(side[0], xy[0]) < 1e-9 and math.dist(side[-1], xy[-1]) < 1e-9,
                  (piece, side[0], side[-1]))
            # both arcs: curvature of three neighbours is that of the osculating circle at one end
            kappa = [bend(side[i:i + 3]) for i in (1, len(side) - 4)]
            ends = [curve["kappa"][piece * each], curve["kappa"][(piece + 1) * each - 1]]
            check("an osculating circle at one end", any(abs(k - e) < 1e-6 * abs(e) for k, e in zip(kappa, ends)),
                  (piece, kappa, ends))
        sagitta = max(abs(k) for k in ends) * max(math.dist(a, b) for a, b in zip(one, one[1:])) ** 2 / 8
        for p in xy[1:-1]:
            away = beside(one, p), beside(other, p)
            check("the contour inside", away[0] * away[1] <= 0 or min(map(abs, away)) <= sagitta, (piece, p, away))
    page.click_on("#shade")
    page.write("#noise", "2")
    page.settled()
    page.write("#noise", "")
    page.settled()
    page.click_on("#snap")
    start = page.point(3)
    page.drag(start, (start[0] + 17.3, start[1] + 9.1))
    x, y = page.doc()["points"][3]
    check("snapped to a round place", len(repr(x)) < 8 and len(repr(y)) < 8, (x, y))
    page.click_on("#undo")
    page.click_on("#snap")
    page.settled()


def below(page):
    """A picture below the points, its scale by two clicks; an earlier contour beside the one drawn."""
    page.run("""(async () => { const c = document.createElement('canvas'); c.width = 200; c.height = 100;
      c.getContext('2d').fillRect(10, 10, 50, 50);
      const blob = await new Promise((r) => c.toBlob(r, 'image/png')), data = new DataTransfer();
      data.items.add(new File([blob], 'scan.png', {type: 'image/png'}));
      document.querySelector('main').dispatchEvent(
        new DragEvent('drop', {dataTransfer: data, bubbles: true, cancelable: true})); })()""")
    page.wait("document.querySelector('#scale')")
    check("points stay", page.doc()["points"] == series10(ROOT))
    unit = page.run("studio.picture.value.unit")
    page.click_on("#scale")
    for index in (0, 9):
        page.click(*page.point(index))
    page.wait("document.querySelector('#length')")
    page.write("#length", "40")
    page.wait(f"studio.picture.value.unit !== {unit!r}")
    by = page.run("studio.picture.value.unit") / unit
    check("two clicks and a length are the scale", abs(by * math.dist(series10(ROOT)[0], series10(ROOT)[9]) - 40) < 0.5, by)
    page.click_on("#no-picture")
    page.wait("!document.querySelector('#scale')")
    page.click_on("#keep")
    page.wait("document.querySelector('#apart')")
    away = float(page.run("document.querySelector('#apart').textContent").split()[-2])
    check("a contour lies on itself", away < 1e-6, away)
    start = page.point(4)
    page.drag(start, (start[0] + 12, start[1]))
    away = float(page.run("document.querySelector('#apart').textContent").split()[-2])
    moved = math.dist(page.doc()["points"][4], series10(ROOT)[4])
    check("how far apart", 0.2 * moved < away <= 1.5 * moved, (away, moved))
    page.click_on("#undo")
    page.click_on("#keep")
    page.settled()


def bend(three):
    (ax, ay), (bx, by), (cx, cy) = three
    turn = (bx - ax) * (cy - by) - (by - ay) * (cx - bx)
    return 2 * turn / (math.dist(three[0], three[1]) * math.dist(three[1], three[2]) * math.dist(three[0], three[2]))


def beside(side, p):
    """How far a place lies to the left of a boundary, by the chord that it is nearest to."""
    best, found = math.inf, 0.0
    for a, b in zip(side, side[1:]):
        dx, dy = b[0] - a[0], b[1] - a[1]
        whole = dx * dx + dy * dy
        if whole == 0:
            continue
        t = max(0.0, min(1.0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / whole))
        away = math.dist(p, (a[0] + t * dx, a[1] + t * dy))
        if away < best:
            best, found = away, (dx * (p[1] - a[1]) - dy * (p[0] - a[0])) / math.sqrt(whole)
    return found


def cursors(page):
    """The place under the cursor of the plot is marked in the drawing, and the other way."""
    box = page.run("(() => { const b = document.querySelector('#plot .u-over').getBoundingClientRect();"
                   "return [b.left, b.top, b.width, b.height]; })()")
    for share in (0.1, 0.35, 0.8):
        page.mouse("mouseMoved", box[0] + share * box[2], box[1] + 0.5 * box[3])
        page.wait("studio.hovered.value !== null")
        i = page.run("studio.hovered.value")
        xy = page.run(f"studio.fitted.value.answer.curve.xy.slice(2 * {i}, 2 * {i} + 2)")
        place = page.run(f"studio.place({json.dumps(xy)})")
        page.mouse("mouseMoved", *place)
        page.wait("studio.hovered.value !== null")
        j = page.run("studio.hovered.value")
        back = page.run(f"studio.place(studio.fitted.value.answer.curve.xy.slice(2 * {j}, 2 * {j} + 2))")
        check("both cursors agree within a pixel", math.dist(place, back) < 1, (place, back))


def files(page):
    page.run("""(() => { const data = new DataTransfer();
      data.setData('text/plain', '0\\t0\\n10\\t4\\n20\\t5\\n32\\t3\\n40\\t-2\\n');
      document.querySelector('#drawing').dispatchEvent(
        new ClipboardEvent('paste', {clipboardData: data, bubbles: true})); })()""")
    page.wait("studio.doc.value.points.length === 5")
    page.settled()
    check("pasted from a spreadsheet", page.verdict() == "good", page.verdict())

    def dropped(name, text):
        page.run(f"""(() => {{ const data = new DataTransfer();
          data.items.add(new File([{json.dumps(text)}], {json.dumps(name)}));
          document.querySelector('main').dispatchEvent(
            new DragEvent('drop', {{dataTransfer: data, bubbles: true, cancelable: true}})); }})()""")
    dxf = "0\nSECTION\n2\nENTITIES\n0\nSPLINE\n70\n8\n71\n3\n72\n8\n73\n4\n" + "".join(
        f"40\n{k}\n" for k in (0, 0, 0, 0, 1, 1, 1, 1)) + "".join(
        f"10\n{x}\n20\n{y}\n30\n0\n" for x, y in ((0, 0), (5, 4), (12, 5), (20, 0))) + \
        "0\nENDSEC\n0\nEOF\n"
    dropped("curve.dxf", dxf)
    page.wait("studio.doc.value.points.length > 6")
    dropped("p.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='80mm' "
                     "viewBox='0 0 100 80'><path d='M5 5C20 60 60 70 95 60'/></svg>")
    page.wait("studio.doc.value.points.length > 6 && studio.doc.value.points[0][0] === 5")
    page.settled()
    dropped("naca.dat", (ROOT / AIRFOIL).read_text())
    page.wait("studio.doc.value.name === 'naca.dat'")
    page.settled()
    check("an airfoil", page.verdict() == "good" and len(page.doc()["points"]) > 30, page.answer()["error"])
    before = page.doc()
    dropped("nothing.txt", "no points here")
    page.wait("document.querySelector('#message')")
    check("what cannot be read leaves the document", page.doc() == before)
    page.click_on("#dismiss")


def accessible(page, axe):
    """No serious finding of axe, in both looks and languages."""
    page.run(axe.read_text())
    for look in ("light", "dark"):
        for language in ("en", "uk"):
            rules, found = page.run(
                "axe.run().then((r) => [r.passes.length, r.violations.map((v) => [v.impact, v.id,"
                " v.nodes.map((n) => n.target.join(' ')).slice(0, 3)])])")
            check("axe looked", rules > 10, rules)
            serious = [v for v in found if v[0] in ("serious", "critical")]
            check(f"axe, {look}, {language}", not serious, serious)
            page.click_on("#language")
        page.click_on("#theme")


def on_a_tablet(page, axe):
    """Nothing is cut off at the width of a tablet, upright or not, and axe finds nothing serious."""
    page.run(axe.read_text())
    for width, height in ((768, 1024), (1024, 768)):
        page.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                  mobile=False)
        page.wait(f"innerWidth === {width}")
        page.run("new Promise((r) => setTimeout(r, 300))")  # the plot follows
        for language in ("en", "uk"):
            wide = page.run("[...document.querySelectorAll('body *')].filter((e) => e.getBoundingClientRect().right"
                            f" > {width} + 1).map((e) => e.tagName + '#' + e.id).slice(0, 5)")
            check(f"all within {width} pixels, {language}", not wide, wide)
            tall = page.run("document.querySelector('#drawing').clientHeight")
            check(f"a drawing of a third of {height} pixels, {language}", tall > height / 3, tall)
            serious = page.run("axe.run().then((r) => r.violations.filter((v) => ['serious', 'critical'].includes("
                               "v.impact)).map((v) => [v.id, v.nodes.map((n) => n.target.join(' ')).slice(0, 3)]))")
            check(f"axe at {width} pixels, {language}", not serious, serious)
            page.run("window.heights = new Set(); new ResizeObserver((all) => all.forEach((e) =>"
                     " heights.add(e.contentRect.height))).observe(document.querySelector('#drawing'))")
            x, y = page.point(6)
            page.drag((x, y), (x + 4, y - 3), 8)
            page.click_on("#undo")
            page.settled()
            seen = page.run("[...heights]")
            check(f"the drawing stays as it is during a drag, {width} pixels, {language}", len(seen) == 1, seen)
            page.click_on("#language")
    page.call("Emulation.clearDeviceMetricsOverride")


def drop_file(page, name, text):
    page.run(f"""(() => {{ const data = new DataTransfer();
      data.items.add(new File([{json.dumps(text)}], {json.dumps(name)}));
      document.querySelector('main').dispatchEvent(
        new DragEvent('drop', {{dataTransfer: data, bubbles: true, cancelable: true}})); }})()""")
    page.wait(f"studio.doc.value.name === {json.dumps(name)}")
    page.settled()


def said_of(path):
    """What the program says of a file: the counts of its contour."""
    made = subprocess.run([PROGRAM, "fit", path, "--json"], capture_output=True, text=True)
    return figures(json.loads(made.stdout))


def figures(report):
    proof = [report["certificate"][k] for k in ("proved", "vertices", "inflections", "corners", "curvature_steps")]
    return [report[k] for k in ("continuity", "units", "points", "pieces")] + proof + [report["report"]["largest_deviation"]]


STADIUM = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + "".join(
    f"0\nLINE\n8\n0\n10\n{a}\n20\n{b}\n11\n{c}\n21\n{d}\n" for a, b, c, d in ((0, 0, 40, 0), (40, 20, 0, 20))) + "".join(
    f"0\nARC\n8\n0\n10\n{x}\n20\n10\n40\n10\n50\n{a}\n51\n{b}\n" for x, a, b in ((40, 270, 90), (0, 90, 270))) + \
    "0\nLINE\n8\n0\n10\n0\n20\n50\n11\n9\n21\n50\n0\nENDSEC\n0\nEOF\n"


def drawn_files(page):
    """A drawing is what the program makes of it while no point is changed: its lines and arcs stay, tolerances of
    a file count; afterwards the page says that they no longer do. Another of its curves can be taken."""
    tolerances = "x_mm,y_mm,tol\n0,0,0.1\n10,4,0.5\n22,5,0.1\n30,7,2\n40,0,0\n"
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("stadium.dxf", STADIUM), ("tol.csv", tolerances)):
            path = Path(folder) / name
            path.write_text(text)
            drop_file(page, name, text)
            wanted = said_of(path)
            check(f"{name}: as the program says", figures(page.answer()["report"]) == wanted, (figures(page.answer()["report"]), wanted))
            check(f"{name}: it is told", page.run("document.querySelector('#as-drawn') !== null"))
            x, y = page.point(1)
            page.drag((x, y), (x + 9, y + 7))
            check(f"{name}: no longer", page.run("document.querySelector('#as-drawn') === null && "
                                                f"document.querySelector('#message').textContent.includes('{name}')"))
            page.click_on("#dismiss")
            page.click_on("#undo")
            page.settled()
            check(f"{name}: undone", figures(page.answer()["report"]) == wanted, page.answer()["error"])
    drop_file(page, "stadium.dxf", STADIUM)
    check("lines and arcs of a stadium", page.answer()["report"]["certificate"]["curvature_steps"] == 4
          and abs(page.run("studio.fitted.value.answer.curve.length") - (80 + 20 * math.pi)) < 1e-9)
    page.wait("document.querySelectorAll('#curve option').length === 3")
    page.choose("#curve", "2")
    page.wait("studio.doc.value.source.curve === 2 && studio.current.value")
    check("the other curve", abs(page.run("studio.fitted.value.answer.curve?.length ?? 9") - 9) < 1e-9)
    while page.run("studio.doc.value.name !== 'series10.csv'"):
        page.click_on("#undo")
    page.settled()


def marked(page):
    """As many marks of vertices and inflections as are proved, whatever the curve is made of."""
    circle = [[math.cos(k / 2), math.sin(k / 2)] for k in range(12)]
    wave = [[x, 30 * math.sin(x / 20)] for x in range(0, 130, 8)]
    seen = 0
    for name, points, vertices in (("circle.csv", circle, 0), ("wave.csv", wave, 2)):
        drop_file(page, name, "x_mm,y_mm\n" + "".join(f"{x!r},{y!r}\n" for x, y in points))
        for carrier in ("arcs", "bspline", "cubic", "spiral"):
            page.choose("#carrier", carrier)
            page.settled()
            marks = page.run("studio.marks(studio.fitted.value.answer.curve, studio.fitted.value.answer.report).map((m) => m.kind)")
            proof = page.answer()["report"]["certificate"]
            counts = [marks.count("vertex"), marks.count("inflection")]
            check(f"marks of {name} as {carrier}", counts == [proof["vertices"], proof["inflections"]], (counts, proof["vertices"], proof["inflections"]))
            seen += len(marks)
        check(f"vertices of {name}", marks.count("vertex") == vertices, marks)
    check("marks were seen", seen > 8, seen)
    page.choose("#what", "radius")
    frame = "new Promise((r) => setTimeout(r, 100))"
    page.run(frame)
    page.choose("#what", "curvature")
    while page.run("studio.doc.value.name !== 'series10.csv'"):
        page.click_on("#undo")
    page.settled()


def anew(page):
    """No points at first; the first ones by the keyboard and by the mouse; the last change is undone wherever the keyboard is."""
    page.click_on("#new")
    page.settled()
    check("no points", page.doc()["points"] == [] and page.verdict() == "bad", page.verdict())
    page.run("document.querySelector('#drawing').focus()")
    page.key("n")
    page.key("n")
    page.wait("studio.doc.value.points.length === 2")
    x, y = page.point(1)
    page.click(x + 90, y + 40, 2)
    page.settled()
    check("three points are a contour", len(page.doc()["points"]) == 3 and page.verdict() == "good", page.verdict())
    before = page.doc()["points"]
    x, y = page.point(2)
    page.press(x + 1, y)
    page.mouse("mouseMoved", x + 2, y, button="left", buttons=1)
    page.release(x + 2, y)
    check("a click that slips by a pixel moves nothing", page.doc()["points"] == before)
    page.drag((x + 6, y), (x + 36, y))
    moved = page.point(2)
    check("a point keeps its distance from the hand", abs(moved[0] - x - 30) < 0.01, (x, moved))
    page.click_on("#convex")
    page.run("document.querySelector('#convex').focus()")
    page.key("z", CTRL)
    page.key("z", CTRL)
    page.settled()
    check("undone with a box in focus", page.doc()["points"] == before, page.doc()["points"])
    page.run("document.querySelector('#segment-2').focus()")
    page.key("Enter")
    page.wait("studio.selected.value === 1 && studio.region.value")
    while page.run("studio.doc.value.name !== 'series10.csv'"):
        page.click_on("#undo")
    page.click_on("#fit")
    page.settled()


def unreadable():
    """A file that holds no contour leaves a page that says so and works."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "two.csv"
        path.write_text("x,y\n0,0\n10,4\n")
        with Studio(PROGRAM, path) as studio, Page(studio.address) as page:
            check("it is said", "two.csv" in page.run("document.querySelector('#message').textContent"))
            check("and there is a contour", page.verdict() == "good", page.verdict())


def pictures(page, folder):
    folder.mkdir(parents=True, exist_ok=True)
    page.click(*page.point(5))
    page.wait("studio.region.value")
    page.picture(folder / "studio-light.png")
    page.click_on("#theme")
    page.choose("#what", "slope")
    page.picture(folder / "studio-dark.png")
    page.click_on("#language")
    page.choose("#what", "curvature")
    page.click_on("#theme")
    page.picture(folder / "studio-uk.png")
    page.click_on("#language")
    page.call("Emulation.setDeviceMetricsOverride", width=768, height=1024, deviceScaleFactor=1, mobile=False)
    page.click_on("#fit")
    page.picture(folder / "studio-tablet.png")


with Studio(PROGRAM, FILE) as studio, Page(studio.address) as opened:
    opens(opened)
    if PICTURES:
        pictures(opened, PICTURES)
        sys.exit(0)
    opened.click(*opened.point(4))
    accessible(opened, AXE)
    on_a_tablet(opened, AXE)
    for part in (controls, points, bends, ranges_are_right, given_ranges, explained, by_the_keyboard, by_fingers, documents, around, writes, overlays, shades, below,
                 cursors, drawn_files, marked, anew, drags, undoing, files):
        part(opened)
        opened.settled()
    check("no error in the page", not opened.trouble, opened.trouble[:3])
unreadable()
print("\n".join(failures) or "all good")
sys.exit(1 if failures else 0)
