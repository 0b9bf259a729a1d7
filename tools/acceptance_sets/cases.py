# SPDX-License-Identifier: Apache-2.0
"""What is run: a case is one call of `obvid fit`, with the truth that its result is held
against."""
import dataclasses
import pathlib


@dataclasses.dataclass
class Case:
    name: str
    path: pathlib.Path  # what obvid reads
    arguments: list  # of `obvid fit`, besides input and output
    tolerance: float  # largest distance that a point may move, units of the file
    group: str = ""
    # Truth, any value that can be sent to another process, and the function that compares:
    # compare(truth, contour) -> dict of figures; contour is None when none was formed.
    truth: object = None
    compare: object = None


def write_points(path, points, comment, tolerances=None):
    """A point file with every digit of its doubles; `comment` says where the points come from."""
    lines = [f"# {line}" for line in comment.splitlines()]
    lines.append("x,y,tol" if tolerances else "x,y")
    for i, (x, y) in enumerate(points):
        lines.append(f"{x!r},{y!r}" + (f",{tolerances[i]!r}" if tolerances else ""))
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def noise_case(work, name, points, tolerance, comment, options=(), **more):
    """A case whose points may all move equally far."""
    path = write_points(work / (name + ".csv"), points, f"{comment}\ntolerance {tolerance:g}")
    return Case(name, path, ["--noise", repr(float(tolerance)), *options], tolerance, **more)


def numbers(line):
    """The numbers of a row, or nothing when one of its words is no number."""
    try:
        return [float(word) for word in line.replace(",", " ").replace(";", " ").split()]
    except ValueError:
        return []


def number_rows(path, width):
    """Rows with at least `width` numbers, in the order of the file."""
    text = pathlib.Path(path).read_text(encoding="utf-8", errors="replace")
    rows = (numbers(line) for line in text.splitlines())
    return [row for row in rows if len(row) >= width]
