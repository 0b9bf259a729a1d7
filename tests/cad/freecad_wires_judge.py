# SPDX-License-Identifier: Apache-2.0
"""Tells what FreeCAD finds in CAD files: run by freecadcmd, OBVID_JUDGE names a list of files, one
a line. Prints one line per file: FOUND name edges wires faces shells valid length area free, and a
last line JUDGE DONE. Edges, wires and length are those of the curves beside the faces, in mm; free
edges of shells belong to one face.
"""
import os

import Part


def free_edges(shell):
    """Edges with one face; a seam is met twice by its face."""
    count = 0
    for edge in shell.Edges:
        met = sum(edge.isSame(other) for face in shell.Faces for wire in face.Wires
                  for other in wire.OrderedEdges)
        count += met == 1
    return count


def tell(file):
    shape = Part.Shape()
    shape.read(file)
    in_faces = [edge for face in shape.Faces for edge in face.Edges]
    edges = [e for e in shape.Edges if not any(e.isSame(other) for other in in_faces)]
    in_bounds = [wire for face in shape.Faces for wire in face.Wires]
    wires = [w for w in shape.Wires if not any(w.isSame(other) for other in in_bounds)]
    return (len(edges), len(wires), len(shape.Faces), len(shape.Shells), int(shape.isValid()),
            repr(sum(e.Length for e in edges)), repr(sum(f.Area for f in shape.Faces)),
            sum(free_edges(shell) for shell in shape.Shells))


with open(os.environ["OBVID_JUDGE"], encoding="utf-8") as names:
    for name in names.read().split():
        print("FOUND", os.path.basename(name), *tell(name), flush=True)
print("JUDGE DONE", flush=True)
