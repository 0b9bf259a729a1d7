# SPDX-License-Identifier: Apache-2.0
"""Programs of `obvid cut`, read as a controller reads them and cut into their drawings.

Plates whose distances are known in closed form, ten outlines and random ones, are milled with several
tools: what the program leaves of them is measured (plates.py). Public drawings are cut along their
outlines, where the way and the outlines must cover each other, and milled with a cutter of a
hundredth of their size, where no closed outline may be cut into, and outlines inside of others come
first. Outlines of DXF files are read by ezdxf where it can, else, and for SVG, they are those that
`obvid convert` writes: the reader is tested elsewhere, here it is the program that is held against
them. """
import collections
import json
import math
import random
import resource
import subprocess

from . import geometry, plates, tables
from .cases import Case
from .controller import Controller

TOLERANCE, INCHES = 0.01, 0.0005  # mm, in: farthest that a program may be from the outlines
COMPENSATION = 1e-6  # units: of lines and arcs
DEPTH = 6.0
PARTS_OF_SIZE = 100  # of a public drawing's diagonal: diameter of its cutter
PARTIAL = 5  # exit code beside a program that lacks what could not be read of the drawing
SECONDS_AT_MOST = 120  # of processor time, whatever else the machine does
PATIENCE = 20  # of the clock, times that
RANDOM_PLATES = 6
ROUGH = 0.05  # tolerances: what sampling outlines and ways for distances may cost
MOST_PLACES = 20000  # of a way or of outlines that are looked at
PLATES = [("3 mm", 3.0, []), ("3 mm, leads, conventional", 3.0, ["--lead-in", "1.2", "--direction", "conventional"]),
          ("2 mm, ramps", 2.0, ["--ramp", "3"]), ("5 mm, ramps", 5.0, ["--ramp", "12"]),
          ("3 mm, passes of 2 mm", 3.0, ["--pass-depth", "2", "--controller", "linuxcnc"]),
         ("3 mm, splines", 3.0, ["--pass-depth", "2", "--lead-in", "1.2", "--controller", "linuxcnc", "--motion", "splines"])]
MADE, DICE, ALONG, MILLED = "plate of ten outlines", "random plates", "drawings, along", "drawings, milled"
SPLINES = "drawings, along, splines"


def plate_case(work, name, group, plate, diameter, options, unit=4):
    shapes, outside = plate
    path = work / (name.replace(" ", "_").replace(",", "") + ".dxf")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(plates.drawing(shapes, unit))
    tolerance, depth = (INCHES, 0.25) if unit == 1 else (TOLERANCE, DEPTH)
    arguments = ["--diameter", f"{diameter}", "--depth", f"{depth}", "--decimals", "6", "--tolerance", f"{tolerance}",
                 *options]
    return Case(name, path, arguments, tolerance, group, (shapes, outside, diameter))


def cases(data, work, _options):
    drawings = [p for folder in ("cad_dxf", "cad_svg", "found/files") for p in sorted((data / folder).glob("*"))
                if p.suffix.lower() in (".dxf", ".svg")]
    if not drawings:
        return [], []
    found = [plate_case(work, name, MADE, plates.plate(), diameter, options) for name, diameter, options in PLATES]
    found.append(plate_case(work, "0.125 in", MADE, plates.plate(0.05), 0.125, [], unit=1))
    dice = random.Random(11)
    found += [plate_case(work, f"random {k}", DICE, plates.random_plate(dice), 4.0, []) for k in range(RANDOM_PLATES)]
    found += [Case(p.name, p, ["--laser", "500", "--drawing", "exact"], TOLERANCE, ALONG) for p in drawings]
    found += [Case(p.name, p, ["--laser", "500", "--drawing", "exact", "--controller", "linuxcnc", "--motion", "splines"],
                   TOLERANCE, SPLINES) for p in drawings]
    found += [Case(p.name, p, ["--depth", "2"], TOLERANCE, MILLED) for p in drawings]
    return found, [f"Tolerance {TOLERANCE} mm ({INCHES} in). Public drawings are milled with a cutter of 1/"
                   f"{PARTS_OF_SIZE} of their diagonal; one that does not fit is refused.\n"]


# ------------------------------------------------------------------- outlines of public drawings
def dxf_outlines(path, fine):
    """Polylines of a DXF file as ezdxf reads it; None where it cannot."""
    try:
        import ezdxf.recover
        document, _ = ezdxf.recover.readfile(path)
        out = []
        for entity in document.modelspace():
            if entity.dxftype() == "INSERT":
                return None  # blocks are the business of the reader's tests
            for part in entity.virtual_entities() if entity.dxftype() in ("LWPOLYLINE", "POLYLINE") else [entity]:
                if part.dxftype() == "LINE":
                    out.append([(p.x, p.y) for p in (part.dxf.start, part.dxf.end)])
                elif part.dxftype() in ("ARC", "CIRCLE", "ELLIPSE", "SPLINE"):
                    out.append([(p.x, p.y) for p in part.flattening(fine)])
        return [line for line in out if len(line) > 1]
    except Exception:  # whatever a damaged file makes it raise  # noqa: BLE001
        return None


def converted_outlines(path, program, work, exact):
    """Curves of a drawing as contour files, in the unit of the file that `cut` takes."""
    folder = work / ("outlines_" + path.name)
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.json"):
        old.unlink()
    started([program, "convert", str(path), "--curve", "all", "-o", str(folder / "{id}.json"), "-q",
             "--drawing", "exact" if exact else "auto"])
    contours = [json.loads(one.read_text()) for one in sorted(folder.glob("*.json"))]
    return [(c["pieces"], c["closed"]) for c in contours]


def polyline(pieces, step):
    out = []
    for piece in pieces:
        ends = [geometry.piece_point(piece, t)[0] for t in (0.0, 0.5, 1.0)]
        length = abs(ends[1] - ends[0]) + abs(ends[2] - ends[1])
        count = 1 if piece["type"] == "line" else max(8, min(400, math.ceil(length / step)))
        out += [geometry.piece_point(piece, k / count)[0] for k in range(count)]
    last = geometry.piece_point(pieces[-1], 1.0)[0]
    return [(z.real, z.imag) for z in [*out, last]]


class Lines:
    """Distances from polylines; squares of a grid tell which chords are near."""

    def __init__(self, lines, cell):
        self.cell, self.grid = cell, collections.defaultdict(list)
        for number, line in enumerate(lines):
            for a, b in zip(line, line[1:]):
                parts = max(1, math.ceil(math.dist(a, b) / cell))
                for k in range(parts):
                    p, q = ([a[i] + (b[i] - a[i]) * t / parts for i in (0, 1)] for t in (k, k + 1))
                    self.grid[self.square(p)].append((p, q, number))

    def square(self, p):
        return math.floor(p[0] / self.cell), math.floor(p[1] / self.cell)

    def nearest(self, p, within):
        """(distance, number of the line), no farther than `within`; infinity where none is."""
        x, y = self.square(p)
        reach = math.ceil(within / self.cell) + 1  # a part of a chord lies in the square of its start, or beside it
        best = (math.inf, None)
        for i in range(x - reach, x + reach + 1):
            for j in range(y - reach, y + reach + 1):
                for a, b, number in self.grid.get((i, j), ()):
                    best = min(best, (to_chord(p, a, b), number))
        return best if best[0] <= within else (math.inf, None)


def to_chord(p, a, b):
    ux, uy, wx, wy = b[0] - a[0], b[1] - a[1], p[0] - a[0], p[1] - a[1]
    square = ux * ux + uy * uy
    t = min(1.0, max(0.0, (wx * ux + wy * uy) / square)) if square else 0.0
    return math.hypot(wx - t * ux, wy - t * uy)


def places(line, step):
    """Along a polyline, no farther apart than `step`."""
    for a, b in zip(line, line[1:]):
        count = max(1, math.ceil(math.dist(a, b) / step))
        for k in range(count):
            yield a[0] + (b[0] - a[0]) * k / count, a[1] + (b[1] - a[1]) * k / count
    yield line[-1]


def length_of(lines):
    return sum(math.dist(a, b) for line in lines for a, b in zip(line, line[1:]))


def inside(p, polygon):
    odd = False
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        if (a[1] > p[1]) != (b[1] > p[1]) and p[0] < a[0] + (p[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]):
            odd = not odd
    return odd


def covered(lines, program, tolerance):
    """How far the way is from the outlines, and the outlines from the way."""
    moves = [m for m in program.moves if m.code in (1, 2, 3, 5) and m.length() > 0]
    # chords of arcs and splines are no farther from these than a fiftieth of the tolerance
    def apart(m):
        if m.inner:
            bend = max(abs(m.curvature(k / 32)) for k in range(33))
            return math.sqrt(8 * tolerance / 50 / bend) if bend else m.length()
        return math.sqrt(8 * m.radius * tolerance / 50) if m.centre else m.length()

    way = [[p[:2] for p in m.places(min(m.length() / 8, apart(m)))] for m in moves]
    cell = max(length_of(lines) / 2000, 4 * tolerance)
    far = lambda table, some: max((table.nearest(p, cell)[0] for p in some), default=0.0)  # noqa: E731
    step = max(length_of(lines) / MOST_PLACES, tolerance)
    return {"off": far(Lines(lines, cell), (p for line in way for p in line)),
            "left": far(Lines(way, cell), (p for line in lines for p in places(line, step)))}


def milled(outlines, program, radius, tolerance):
    """How deep the cutter is in closed outlines, and how many of these are cut too late. Ways along
    open curves are left out: where they cut into an outline the program warns."""
    cell = max(radius, 4 * tolerance)
    ring = Lines([line for line, closed in outlines if closed], cell)
    strings = Lines([line for line, closed in outlines if not closed], cell)
    lines = [line for line, closed in outlines if closed]
    gouge, first, last = 0.0, {}, {}
    for number, m in enumerate(plates.below(program.moves)):
        here = [p[:2] for p in m.places(max(m.length() / 32, radius / 4))]
        if all(strings.nearest(p, 2 * tolerance)[1] is not None for p in here):
            continue
        for p in here:
            distance, k = ring.nearest(p, radius + 2 * tolerance)
            gouge = max(gouge, radius - distance)
            if k is not None and distance > radius - 2 * tolerance:
                first.setdefault(k, number)
                last[k] = number
    early = sum(inside(lines[i][0], lines[j]) and last[i] >= first[j] for i in last for j in first if i != j)
    return {"gouge": max(gouge, 0.0), "early": early, "cut": len(first)}


# ------------------------------------------------------------------------------------------ runs
def limited():
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS_AT_MOST, SECONDS_AT_MOST))


def started(command):
    """A program that is ended after so much processor time: then its code is that of the signal."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE * SECONDS_AT_MOST, check=False,
                          preexec_fn=limited)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def fault_of_partial(error, said, text):
    """What is wrong with the program of a drawing of which not all could be read; empty: nothing. It says E504 and
    what is missing (docs/cli.md), and its file is whole: a controller takes it, and it ends with tool or beam off."""
    if error != "E504":
        return f"written with {error or 'no code'}"
    if not said.get("left_out") or not said.get("warnings"):
        return "does not say what is missing"
    try:
        codes = Controller(text, burns=True, splines=True).codes
    except AssertionError as fault:
        return f"no controller takes it: {fault}"
    switched = [value for letter, value in codes if letter == "M" and value in (3, 4, 5)]
    if not codes or codes[-1] not in (("M", 2), ("M", 30)):
        return "does not end"
    return "ends with its tool on" if switched and switched[-1] != 5 else ""


def call(case, program, arguments, output):
    output.unlink(missing_ok=True)
    done, seconds = started([program, "cut", str(case.path), *arguments, "-o", str(output), "--json"])
    outcome = {"name": case.name, "group": case.group, "tolerance": case.tolerance, "exit": done.returncode,
               "error": "", "text": "", "process_seconds": seconds}
    if done.returncode != 0:
        line = next((s for s in done.stderr.splitlines() if s.startswith("obvid: error")), "")
        outcome["error"], _, outcome["text"] = line.removeprefix("obvid: error ").partition(": ")
        if output.exists() and done.returncode == PARTIAL:
            said = json.loads(done.stdout) if done.stdout.startswith("{") else {}
            outcome["partial"] = fault_of_partial(outcome["error"], said, output.read_text())
        elif output.exists():
            outcome["exit"] = "refused, but written"
        return outcome, None
    return outcome, json.loads(done.stdout)


def run(cases, options):
    """`obvid cut` in place of `obvid fit`."""
    return [run_case(case, options.program, options.work) for case in cases]


def run_case(case, program, work):
    output = work / "program.nc"
    if case.group in (MADE, DICE):
        shapes, outside, diameter = case.truth
        outcome, said = call(case, program, case.arguments, output)
        if not said:
            return outcome
        exact = [k for k, s in enumerate(shapes) if not isinstance(s, plates.Ellipse)]
        found = plates.simulated(shapes, outside, Controller(output.read_text(), splines="splines" in case.arguments), diameter, exact)
        if "conventional" in case.arguments:
            found["wrong_way"] = len(shapes) - found["wrong_way"]
        found["left"] = max(0.0, found["left"] - diameter / 200)  # ways are looked at a radius/20 apart
        return {**outcome, **found, "outlines": len(said["outlines"])}
    return run_drawing(case, program, work, output)


def run_drawing(case, program, work, output):
    arguments, radius = list(case.arguments), 0.0
    contours = converted_outlines(case.path, program, work, case.group != MILLED)
    size = diagonal([polyline(pieces, math.inf) for pieces, _ in contours])
    if case.group == MILLED and size:
        radius = size / PARTS_OF_SIZE / 2
        arguments += ["--diameter", repr(2 * radius)]
    outcome, said = call(case, program, arguments, output)
    if not said or not contours:
        return outcome
    unit = {"in": 25.4, "m": 1e3, "cm": 10.0, "ft": 304.8}.get(said.get("units"), 1.0)  # mm
    scale = 1.0 if unit == 25.4 else unit  # of the program: inches stay inches, all else is mm
    tolerance = outcome["tolerance"] = TOLERANCE / (unit / scale)
    radius, size = radius * scale, size * scale
    controller = Controller(output.read_text(), burns=case.group != MILLED, splines=case.group == SPLINES)
    scaled = lambda line: [(x * scale, y * scale) for x, y in line]  # noqa: E731
    step = max(size / 2000, tolerance) / scale
    outlines = [(scaled(polyline(pieces, step)), closed) for pieces, closed in contours]
    outcome["outlines"] = len(outlines)
    if case.group == MILLED:
        return {**outcome, **milled(outlines, controller, radius, tolerance),
                "rapids": len(plates.rapids_through(controller.moves))}
    lines = dxf_outlines(case.path, tolerance / scale / 20) if case.path.suffix.lower() == ".dxf" else None
    outcome["read_by"] = "ezdxf" if lines else "convert"
    rapids = sum(m.spins for m in controller.moves if m.code == 0 and math.dist(m.a, m.b) > 0)
    return {**outcome, **covered([scaled(line) for line in lines] if lines else [line for line, _ in outlines], controller, tolerance), "rapids": rapids}


def diagonal(lines):
    points = [p for line in lines for p in line]
    if not points:
        return 0.0
    return math.hypot(*(max(p[i] for p in points) - min(p[i] for p in points) for i in (0, 1)))


# ---------------------------------------------------------------------------------------- tables
def parts(outcomes, key):
    """Largest of a figure in tolerances; None without one."""
    return max((o[key] / o["tolerance"] for o in outcomes if key in o), default=None)


def summary(outcomes):
    rows = []
    for name, group in tables.groups_of(outcomes).items():
        done = [o for o in group if o["exit"] == 0]
        count = lambda key, of=done: sum(o[key] for o in of if key in o)  # noqa: E731
        rows.append([name, len(group), len(done), count("outlines"), tables.number(parts(done, "gouge")),
                     tables.number(parts(done, "off")), tables.number(parts(done, "left")), count("rapids"),
                     count("early"), tables.number(max((o["compensation"] for o in done if "compensation" in o),
                                                       default=None)),
                     tables.number(1e3 * max(o["process_seconds"] for o in group))])
    return tables.markdown(["group", "programs", "done", "outlines", "gouge / tolerance", "way off / tolerance",
                            "left / tolerance", "rapid moves through stock", "cut too early", "compensation off, units",
                            "longest ms"], rows)


def details(outcomes):
    refused = [o for o in outcomes if o["exit"] != 0]
    why = lambda o: o.get("partial") or o["text"].split("; ")[0].split(" (")[0][:90]  # noqa: E731
    return tables.markdown(["refused, or a part", "group", "exit", "code", "why"],
                           [[o["name"], o["group"], o["exit"], o["error"], why(o)] for o in refused])


def criteria(outcomes):
    done = [o for o in outcomes if o["exit"] == 0]
    made = [o for o in outcomes if o["group"] in (MADE, DICE)]
    most = 1 + ROUGH
    worst = lambda key: max((o[key] / o["tolerance"] for o in done if key in o), default=math.inf)  # noqa: E731
    off = max((o["compensation"] for o in made if "compensation" in o), default=math.inf)
    rapids, early = (sum(o.get(key, 0) for o in done) for key in ("rapids", "early"))
    coded = [o for o in outcomes if o["exit"] != 0 and "partial" not in o]
    partial = [o["partial"] for o in outcomes if "partial" in o]
    return [("every plate is done", f"{sum(o['exit'] == 0 for o in made)} of {len(made)}",
             all(o["exit"] == 0 for o in made)),
            ("plates: every outline cut, the right way round",
             f"{sum(o.get('missed', 0) + o.get('wrong_way', 0) for o in made)} not",
             not any(o.get("missed", 1) + o.get("wrong_way", 1) for o in made)),
            ("what is refused has a code, and no file", f"{sum(bool(o['error']) for o in coded)} of {len(coded)}",
             all(o["error"] and o["exit"] in (3, 4, 5) for o in coded)),
            ("programs of parts of drawings say so, with what is missing, and are whole",
             f"{partial.count('')} of {len(partial)}", not any(partial)),
            (f"no gouge beyond {most} tolerances", f"{worst('gouge'):.3f}", worst("gouge") <= most),
            (f"ways no farther from outlines than {most} tolerances", f"{worst('off'):.3f}", worst("off") <= most),
            (f"outlines no farther from the cut than {most} tolerances", f"{worst('left'):.3f}", worst("left") <= most),
            ("rapid moves through stock, or with the beam on", f"{rapids}", rapids == 0),
            ("outlines cut after one around them", f"{early}", early == 0),
            (f"compensation of lines and arcs within {COMPENSATION:g}", f"{off:.2g}", off <= COMPENSATION)]
