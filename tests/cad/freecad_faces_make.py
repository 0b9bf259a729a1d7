# SPDX-License-Identifier: Apache-2.0
"""Makes files of faces of all kinds inside FreeCAD: run by freecadcmd, OBVID_MAKE names the folder."""
import math
import os

import FreeCAD
import Part

FOLDER = os.environ["OBVID_MAKE"]
Z = FreeCAD.Vector(0, 0, 1)
ORIGIN = FreeCAD.Vector(0, 0, 0)


def save(name, shape):
    shape.exportStep(os.path.join(FOLDER, name + ".step"))
    shape.exportBrep(os.path.join(FOLDER, name + ".brep"))
    shape.exportIges(os.path.join(FOLDER, name + ".igs"))


save("sphere", Part.makeSphere(5))
save("torus", Part.makeTorus(10, 3))
save("cone", Part.makeCone(4, 0, 3).Faces[0])
save("cylinder", Part.makeCylinder(2, 7).Faces[0])
CIRCLE = Part.Circle(ORIGIN, Z, 2)
save("extrusion", Part.SurfaceOfExtrusion(CIRCLE, Z).toShape(0, 2 * math.pi, 0, 7))
SPLINE = Part.BSplineCurve()  # half a circle of radius 5
SPLINE.buildFromPolesMultsKnots(
    [FreeCAD.Vector(x, 0, z) for x, z in ((0, -5), (5, -5), (5, 0), (5, 5), (0, 5))],
    [3, 2, 3], [0, 1, 2], False, 2, [1, math.sqrt(0.5), 1, math.sqrt(0.5), 1])
save("revolution", Part.SurfaceOfRevolution(SPLINE, ORIGIN, Z).toShape())
BALL = Part.Sphere()
BALL.Radius = 4
save("offset", Part.OffsetSurface(BALL, 1).toShape(0, 3, -1, 1))
print("MADE ALL", flush=True)
