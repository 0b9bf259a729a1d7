# SPDX-License-Identifier: Apache-2.0
"""A picture of FreeCAD's window with a CAD file and the curvature comb that FreeCAD measures on it.

usage: OBVID_CAD_FILE=part.step OBVID_PICTURE=out.png \
         xvfb-run -a -s "-screen 0 1600x900x24" freecad tools/freecad_screenshot.py
Needs the Debian packages freecad and xvfb; as root set QTWEBENGINE_DISABLE_SANDBOX=1.
"""
import os

import FreeCAD
import FreeCADGui
import Part
from PySide2 import QtCore, QtWidgets

TEETH = 400
HIGHEST = 0.12  # tallest tooth, of the size
CLOSER = 0.72  # a curve fills less of the window than the ball around it, which is what fits
WAIT_MS = 1500  # what the window needs to draw itself


def comb(edge):
    """Teeth and outline: along the left normal, as long as the curvature is large."""
    first, last = edge.ParameterRange
    parameters = [first + (last - first) * k / TEETH for k in range(TEETH + 1)]
    size = edge.BoundBox.DiagonalLength
    values = []
    for u in parameters:
        bend = edge.curvatureAt(u)
        normal = edge.normalAt(u) if bend > 1e-9 / size else FreeCAD.Vector()
        values.append((edge.valueAt(u), normal, bend))
    scale = HIGHEST * size / max(bend for _, _, bend in values)
    tips = [point - normal * (scale * bend) for point, normal, bend in values]
    teeth = [Part.makeLine(p, tip) for (p, _, _), tip in zip(values, tips) if (tip - p).Length > 0]
    return Part.makeCompound(teeth + [Part.makePolygon(tips)])


def colour(item, rgb, width):
    item.ViewObject.LineColor = rgb
    item.ViewObject.LineWidth = width
    item.ViewObject.PointColor = rgb
    item.ViewObject.PointSize = 1


def save():
    window = FreeCADGui.getMainWindow().frameGeometry()
    screen = QtWidgets.QApplication.primaryScreen()  # the window's own picture lacks the 3D view
    picture = screen.grabWindow(0, window.x(), window.y(), window.width(), window.height())
    picture.save(os.environ["OBVID_PICTURE"])
    print("EDGES", len(curve.Shape.Edges), curve.Shape.Edges[0].Continuity, flush=True)
    os._exit(0)  # no question about saving


FreeCADGui.activateWorkbench("PartWorkbench")
document = FreeCAD.newDocument("Contour")
Part.insert(os.environ["OBVID_CAD_FILE"], document.Name)
curve = document.Objects[0]
curve.Label = "Obvid contour"
colour(curve, (0.1, 0.3, 0.9), 3)
teeth = document.addObject("Part::Feature", "Comb")
teeth.Label = "Comb by FreeCAD"
teeth.Shape = comb(curve.Shape.Edges[0])
colour(teeth, (0.9, 0.45, 0.1), 1)
document.recompute()
for pane in FreeCADGui.getMainWindow().findChildren(QtWidgets.QDockWidget):
    if pane.objectName() in ("Report view", "Python console", "Selection view"):
        pane.hide()
FreeCADGui.getMainWindow().resize(1280, 720)
view = FreeCADGui.activeDocument().activeView()
view.setAnimationEnabled(False)
view.setCameraType("Orthographic")
view.viewTop()


def fit():
    view.fitAll()
    camera = view.getCameraNode()
    camera.height.setValue(CLOSER * camera.height.getValue())


QtCore.QTimer.singleShot(WAIT_MS, fit)
QtCore.QTimer.singleShot(2 * WAIT_MS, save)
