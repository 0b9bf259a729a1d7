# SPDX-License-Identifier: Apache-2.0
"""Opens a document of features where the addon is not installed: shapes are there and go on. Run by
freecad_test.py."""
import os

import FreeCAD
import Part

try:
    import obvid_freecad  # noqa: F401

    raise SystemExit("the addon is there")
except ImportError:
    pass
doc = FreeCAD.openDocument(os.path.join(os.environ["OBVID_TEST_FOLDER"], "all.FCStd"))
for name, kind in (("FairCurve", "Wire"), ("CurvatureAudit", "Compound"), ("Region", "Compound"), ("FairSkin", "Face")):
    shape = doc.getObject(name).Shape
    assert shape.ShapeType == kind and shape.isValid(), name
curve = doc.FairCurve
assert isinstance(curve.Shape.Edges[0].Curve, Part.BSplineCurve)
before = curve.Shape.Length
extrusion = doc.addObject("Part::Extrusion", "Extrusion")
extrusion.Base, extrusion.Dir = curve, FreeCAD.Vector(0, 0, 5)
doc.Sketch.movePoint(6, 1, FreeCAD.Vector(19, 56, 0))
doc.recompute()
assert abs(extrusion.Shape.Area / (5 * before) - 1) < 1e-2, (extrusion.Shape.Area, before)  # the kernel integrates
assert curve.Shape.Length == before, (curve.Shape.Length, before)
path = os.path.join(os.environ["OBVID_TEST_FOLDER"], "again.FCStd")
doc.saveAs(path)
FreeCAD.closeDocument(doc.Name)
assert abs(FreeCAD.openDocument(path).FairCurve.Shape.Length - before) < 1e-9 * before
print("\nTEST the shapes are there without the addon ok\nFREECAD DONE 1", flush=True)
