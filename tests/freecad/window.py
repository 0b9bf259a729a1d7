# SPDX-License-Identifier: Apache-2.0
"""Every command of the workbench in FreeCAD's window: selection, panel, verdict, OK, undo, cancel. Run by
freecad_test.py under a virtual screen; prints a line for each test and a last line FREECAD DONE."""
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
except ImportError:
    QtWidgets = QtGui

SOURCES = os.environ["OBVID_TEST_SOURCES"]
FOLDER = os.environ["OBVID_TEST_FOLDER"]
SETTLE_S = 0.3  # longer than panels wait for the next key


def reference():
    with open(os.path.join(SOURCES, "examples/series10.csv"), encoding="utf-8") as text:
        rows = text.read().split("\n")[1:]
    return [tuple(float(word) for word in row.split(",")) for row in rows if row.strip()]


SERIES = reference()


def settle(seconds=SETTLE_S):
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        QtWidgets.QApplication.processEvents()
        time.sleep(0.01)


def document():
    made = FreeCAD.newDocument("Test")
    settle(0.05)
    return made


def sketch(doc, points=None, placement=None, name="Sketch"):
    item = doc.addObject("Sketcher::SketchObject", name)
    item.addGeometry([Part.Point(Vector(x, y, 0)) for x, y in points or SERIES], False)
    if placement is not None:
        item.Placement = placement
    doc.recompute()
    return item


def spline(doc, name="Spline"):
    curve = Part.BSplineCurve()
    curve.interpolate([Vector(x, y, 0) for x, y in SERIES])
    item = doc.addObject("Part::Feature", name)
    item.Shape = curve.toShape()
    return item


def choose(*links):
    FreeCADGui.Selection.clearSelection()
    for link in links:
        item, name = link if isinstance(link, tuple) else (link, "")
        FreeCADGui.Selection.addSelection(item, name)


def form():
    forms = [w for w in FreeCADGui.getMainWindow().findChildren(QtWidgets.QWidget, "ObvidPanel") if w.isVisible()]
    assert len(forms) == 1, f"{len(forms)} panels"
    return forms[0]


def shown(name="ObvidVerdict"):
    return form().findChild(QtWidgets.QLabel, name).text()


def press(text):
    """A button of the task panel."""
    for box in FreeCADGui.getMainWindow().findChildren(QtWidgets.QDialogButtonBox):
        if box.isVisible():
            kinds = getattr(QtWidgets.QDialogButtonBox, "StandardButton", QtWidgets.QDialogButtonBox)
            box.button(getattr(kinds, text)).click()
            settle()
            return
    raise AssertionError("no buttons")


def run(command, *links):
    """The command on a selection; its panel is open then. The feature that it made."""
    choose(*links)
    before = {one.Name for one in FreeCAD.ActiveDocument.Objects}
    FreeCADGui.runCommand(f"Obvid_{command}")
    settle()
    new = [one for one in FreeCAD.ActiveDocument.Objects if one.Name not in before]
    assert len(new) == 1, [one.Name for one in new]
    return new[0]


def one_step(command, *links):
    """Command, OK, undo, redo: one step each. The feature, and what its panel said."""
    doc = FreeCAD.ActiveDocument
    steps, there = doc.UndoCount, len(doc.Objects)
    item = run(command, *links)
    said = shown()
    press("Ok")
    assert not FreeCADGui.Control.activeDialog()
    assert doc.UndoCount == steps + 1, (doc.UndoCount, steps)
    name = item.Name
    doc.undo()
    settle(0.1)
    assert len(doc.Objects) == there and doc.getObject(name) is None
    doc.redo()
    settle(0.1)
    item = doc.getObject(name)
    assert item is not None and not (hasattr(item, "Shape") and item.Shape.isNull())
    return item, said


def test_the_workbench_is_there():
    assert "ObvidWorkbench" in FreeCADGui.listWorkbenches()
    FreeCADGui.activateWorkbench("ObvidWorkbench")
    settle()
    names = FreeCADGui.listCommands()
    for name in ("FairCurve", "CurvatureAudit", "Region", "FairSkin", "Check"):
        assert f"Obvid_{name}" in names, name
        assert not QtGui.QIcon(os.path.join(ICONS, f"{name}.svg")).pixmap(32, 32).isNull(), name
    bars = [b.windowTitle() for b in FreeCADGui.getMainWindow().findChildren(QtWidgets.QToolBar)]
    assert "Obvid" in bars, bars


def test_fair_curve():
    doc = document()
    item, said = one_step("FairCurve", sketch(doc))
    assert "Proved: 0 vertices, the points force 0" in said, said
    assert len(item.Shape.Edges) == 1 and item.Proved
    polygon = doc.addObject("Part::Feature", "Polygon")
    polygon.Shape = Part.makePolygon([Vector(x, y, 0) for x, y in SERIES])
    doc.recompute()
    item, said = one_step("FairCurve", *[(polygon, f"Vertex{k}") for k in (4, 3, 2)])
    assert item.PointCount == 3 and "Proved" in said, said


def test_fair_curve_without_a_selection_takes_it_later_and_cancel_leaves_nothing():
    doc = document()
    drawn = sketch(doc)
    steps, there = doc.UndoCount, len(doc.Objects)
    item = run("FairCurve")
    assert "Choose" in shown(), shown()
    choose(drawn)
    form().findChild(QtWidgets.QPushButton, "takeSources").click()
    settle()
    assert item.Proved and "Proved" in shown(), shown()
    press("Cancel")
    assert len(doc.Objects) == there and doc.UndoCount == steps, (doc.UndoCount, steps)


def test_typing_in_a_panel_computes():
    doc = document()
    item = run("FairCurve", sketch(doc))
    free = item.Shape.Length
    tangents = [w for w in form().findChildren(QtWidgets.QPlainTextEdit)][0]
    tangents.setPlainText("1 = -60")
    settle()
    start = item.Shape.Edges[0].tangentAt(item.Shape.Edges[0].FirstParameter)
    assert abs(start.getAngle(Vector(0.5, -(0.75**0.5), 0))) < 1e-6, item.Verdict
    assert item.Shape.Length != free
    tangents.setPlainText("nonsense")
    settle()
    assert "not of the form" in shown(), shown()
    tangents.setPlainText("")
    settle()
    assert "Proved" in shown() and item.Shape.Length == free
    rows = form().findChild(QtWidgets.QTableWidget, "ObvidBounds")
    assert rows.rowCount() >= 5 and rows.item(1, 0).text() == "vertices" and rows.item(1, 1).text() == "0"
    press("Ok")
    steps = doc.UndoCount
    item.ViewObject.Proxy.doubleClicked(item.ViewObject)
    settle()
    form().findChildren(QtWidgets.QPlainTextEdit)[0].setPlainText("1 = -62")
    press("Ok")
    assert item.Headings == ["1 = -62"] and doc.UndoCount == steps + 1, (item.Headings, doc.UndoCount)
    doc.undo()
    assert item.Headings == [], item.Headings


def test_curvature_audit():
    doc = document()
    item, said = one_step("CurvatureAudit", (spline(doc), "Edge1"))
    assert "The joints force 0, this edge has 9 vertices; 1 inflection" in said, said
    assert item.Vertices == 9


def test_region():
    doc = document()
    curve, _ = one_step("FairCurve", sketch(doc))
    item, said = one_step("Region", curve)
    assert "lies within" in said and len(item.Shape.Faces) == 9, said
    item, said = one_step("Region", doc.Sketch)
    assert len(item.Shape.Faces) == 9, said


def test_fair_skin():
    doc = document()
    made = [sketch(doc, [(x * (1 + 0.1 * k), y * (1 + 0.1 * k)) for x, y in SERIES],
                   Placement(Vector(0, 0, 40 * k), Rotation()), f"Section{k}") for k in range(4)]  # fmt: skip
    item, said = one_step("FairSkin", *made)
    assert "4 of 4 contours proved" in said, said
    assert item.Shape.ShapeType == "Face" and item.Shape.isValid()


def test_check():
    doc = document()
    curve, _ = one_step("FairCurve", sketch(doc))
    item, said = one_step("Check", curve)
    assert "Nothing bad" in said and item.Good, said


def test_dragging_a_point_in_the_window():
    doc = document()
    item, _ = one_step("FairCurve", sketch(doc))
    for k in range(5):
        place = Vector(18 + 0.1 * k, 55.3, 0)
        doc.Sketch.movePoint(6, 1, place)
        doc.recompute()
        settle(0.05)
        assert item.Shape.distToShape(Part.Vertex(place))[0] < 1e-9


def test_preferences():
    import obvid_freecad.preferences as preferences

    group = FreeCAD.ParamGet(preferences.GROUP)
    page = FreeCADGui.PySideUic.loadUi(os.path.join(os.path.dirname(ICONS), "preferences.ui"))
    assert page.findChild(QtWidgets.QWidget, "teeth") is not None
    group.SetInt("Teeth", 33)
    group.SetFloat("Noise", 0.25)
    group.SetInt("Continuity", 1)
    try:
        doc = document()
        comb = one_step("CurvatureAudit", (spline(doc), "Edge1"))[0]
        assert comb.Teeth == 33
        curve = one_step("FairCurve", sketch(doc))[0]
        assert curve.Noise.Value == 0.25 and curve.Continuity == "G2"
    finally:
        for name in ("Teeth", "Noise", "Continuity"):
            group.RemInt(name)
            group.RemFloat(name)


def test_a_comb_and_its_verdict_are_seen():
    """The colours of comb and words are in the picture of the view; without the audit they are not."""
    doc = document()
    line = spline(doc)
    line.ViewObject.LineColor = (0.1, 0.3, 0.9)
    view = FreeCADGui.activeDocument().activeView()
    view.setAnimationEnabled(False)
    view.viewTop()
    view.fitAll()
    settle()
    assert orange(view) == 0
    item, _ = one_step("CurvatureAudit", (line, "Edge1"))
    view.fitAll()
    settle()
    with_words = orange(view)
    assert with_words > 1000, with_words
    item.ViewObject.Visibility = False
    settle()
    assert orange(view) == 0


def orange(view):
    path = os.path.join(FOLDER, "view.png")
    view.saveImage(path, 800, 600, "White")
    picture = QtGui.QImage(path)
    count = 0
    for x in range(picture.width()):
        for y in range(picture.height()):
            pixel = picture.pixelColor(x, y)
            if pixel.red() > 200 and 70 < pixel.green() < 160 and pixel.blue() < 90:
                count += 1
    return count


def main():
    only = os.environ.get("OBVID_TEST_ONLY", "")
    tests = [(name, test) for name, test in globals().items() if name.startswith("test_")]
    count = 0
    FreeCADGui.activateWorkbench("ObvidWorkbench")
    for name, test in tests:
        if only not in name:
            continue
        count += 1
        try:
            test()
            print(f"\nTEST {name} ok", flush=True)
        except BaseException:
            print(f"\nTEST {name} FAILED\n{traceback.format_exc()}", flush=True)
        if FreeCADGui.Control.activeDialog():
            FreeCADGui.Control.closeDialog()
        for one in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(one)
    print(f"\nFREECAD DONE {count}", flush=True)
    os._exit(0)  # no question about saving


def begin():
    global ICONS
    from obvid_freecad import views

    ICONS = views.ICONS
    main()


ICONS = ""
QtCore.QTimer.singleShot(1000, begin)
