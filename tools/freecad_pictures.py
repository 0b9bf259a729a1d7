# SPDX-License-Identifier: Apache-2.0
"""Run inside FreeCAD's window by make_freecad_pictures: each command as a user sees it."""
import math
import os
import time
import traceback

import FreeCAD
import FreeCADGui
import Part
from FreeCAD import Placement, Rotation, Vector
from PySide import QtCore, QtGui

try:
    from PySide import QtWidgets
except ImportError:  # FreeCAD 0.20
    QtWidgets = QtGui

SIZE = (1380, 860)
SETTLE_S = 1.0
HIDDEN = ("Report view", "Python console", "Selection view")


def settle(seconds=SETTLE_S):
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        QtWidgets.QApplication.processEvents()
        time.sleep(0.01)


def reference():
    with open(os.path.join(os.environ["OBVID_SOURCES"], "examples/series10.csv"), encoding="utf-8") as text:
        rows = text.read().split("\n")[1:]
    return [tuple(float(word) for word in row.split(",")) for row in rows if row.strip()]


SERIES = reference()


def sketch(doc, points, placement=None, name="Sketch"):
    item = doc.addObject("Sketcher::SketchObject", name)
    item.addGeometry([Part.Point(Vector(x, y, 0)) for x, y in points], False)
    if placement is not None:
        item.Placement = placement
    return item


def new_document():
    made = FreeCAD.newDocument("Obvid")
    view = FreeCADGui.activeDocument().activeView()
    view.setAnimationEnabled(False)
    view.setCameraType("Orthographic")
    return made, view


def run(command, *links):
    FreeCADGui.Selection.clearSelection()
    for link in links:
        item, name = link if isinstance(link, tuple) else (link, "")
        FreeCADGui.Selection.addSelection(item, name)
    FreeCADGui.runCommand(f"Obvid_{command}")
    settle()
    FreeCADGui.Selection.clearSelection()
    return FreeCAD.ActiveDocument.ActiveObject


def done():
    for box in FreeCADGui.getMainWindow().findChildren(QtWidgets.QDialogButtonBox):
        if box.isVisible():
            kinds = getattr(QtWidgets.QDialogButtonBox, "StandardButton", QtWidgets.QDialogButtonBox)
            box.button(kinds.Ok).click()
            settle(0.3)
            return


def save(name, view, closer=0.85, top=True):
    if top:
        view.viewTop()
    else:
        view.viewIsometric()
    view.fitAll()
    camera = view.getCameraNode()
    camera.height.setValue(closer * camera.height.getValue())
    settle()
    window = FreeCADGui.getMainWindow()
    screen = QtWidgets.QApplication.primaryScreen()
    frame = window.frameGeometry()
    picture = screen.grabWindow(0, frame.x(), frame.y(), frame.width(), frame.height())
    path = os.path.join(os.environ["OBVID_PICTURES"], f"freecad-{name}.png")
    picture.save(path)
    print(f"\nPICTURE {path}", flush=True)


def fair_curve():
    doc, view = new_document()
    drawn = sketch(doc, SERIES)
    doc.recompute()
    item = run("FairCurve", drawn)
    audit.new(doc, [item])
    doc.recompute()
    save("fair-curve", view)
    done()


def curvature_audit():
    """A spline through measured points as CAD systems draw it."""
    doc, view = new_document()
    points = [(10.0 * k, 30 * math.sin(k / 3.0) + 1.5 * (7919 * k * k % 101) / 101) for k in range(19)]
    curve = Part.BSplineCurve()
    curve.interpolate([Vector(x, y, 0) for x, y in points])
    item = doc.addObject("Part::Feature", "Spline")
    item.Shape = curve.toShape()
    item.ViewObject.LineColor = (0.1, 0.1, 0.1)
    item.ViewObject.LineWidth = 3.0
    doc.recompute()
    made = run("CurvatureAudit", (item, "Edge1"))
    made.Points = [(sketch(doc, points, name="Measured"), [""])]
    doc.recompute()
    done()
    panels.edit(made)
    save("audit", view)
    done()


def region():
    doc, view = new_document()
    drawn = sketch(doc, SERIES[2::2])
    doc.recompute()
    curve = run("FairCurve", drawn)
    done()
    run("Region", curve)
    save("region", view)
    done()


def fair_skin():
    doc, view = new_document()
    made = []
    for k, scale in enumerate((1.0, 1.25, 1.4, 1.3, 0.9)):
        place = Placement(Vector(0, 0, 45 * k), Rotation(Vector(0, 0, 1), 6 * k))
        made.append(sketch(doc, [(scale * x, scale * y) for x, y in SERIES], place, f"Section{k + 1}"))
    doc.recompute()
    run("FairSkin", *made)
    save("skin", view, 0.9, top=False)
    done()
    skin = doc.FairSkin
    run("Check", skin)
    save("check", view, 0.9, top=False)
    done()


def main():
    global audit, panels
    from obvid_freecad import audit, panels

    try:
        FreeCADGui.activateWorkbench("ObvidWorkbench")
        settle()
        window = FreeCADGui.getMainWindow()
        for pane in window.findChildren(QtWidgets.QDockWidget):
            if pane.objectName() in HIDDEN:
                pane.hide()
        window.showNormal()
        window.resize(*SIZE)
        window.move(0, 0)
        combo = window.findChild(QtWidgets.QDockWidget, "Combo View")
        if combo is not None:
            window.resizeDocks([combo], [400], QtCore.Qt.Horizontal)
        for picture in (fair_curve, curvature_audit, region, fair_skin):
            picture()
            for name in list(FreeCAD.listDocuments()):
                FreeCAD.closeDocument(name)
    except BaseException:
        traceback.print_exc()
    os._exit(0)  # no question about saving


QtCore.QTimer.singleShot(1500, main)
