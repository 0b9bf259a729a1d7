# SPDX-License-Identifier: Apache-2.0
"""How features look in the 3D view and in the tree; needs FreeCAD's window."""
import os

from . import preferences

ICONS = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "resources", "icons")

#: Kinds whose objects stand in the tree below the feature.
CHILDREN = {"Region": ("Curve",)}


def icon(name):
    return os.path.join(ICONS, f"{name}.svg")


def qt_icon(name):
    from .qt import QtGui

    return QtGui.QIcon(icon(name))


class View:
    """Icon, colours, double click; an audit also writes its verdict beside the curve."""

    def __init__(self, view):
        view.Proxy = self

    def attach(self, view):
        self.item = view.Object
        self.label = None
        if kind_of(view.Object) == "CurvatureAudit":
            self.label = Label(view)
            self.label.show(view.Object)

    def getIcon(self):
        return icon(kind_of(getattr(self, "item", None)) or "Obvid")

    def updateData(self, item, name):
        label = getattr(self, "label", None)
        if label is not None and name in ("Shape", "Verdict", "Places", "ShowVertices"):
            label.show(item)

    def onChanged(self, view, name):
        label = getattr(self, "label", None)
        if label is not None and name == "Visibility":
            label.switch(view.Visibility)

    def doubleClicked(self, view):
        from . import panels

        panels.edit(view.Object)
        return True

    def claimChildren(self):
        item = getattr(self, "item", None)
        names = CHILDREN.get(kind_of(item), ())
        return [getattr(item, name) for name in names if getattr(item, name, None) is not None]

    def __getstate__(self):
        return None

    def __setstate__(self, state):
        return None

    dumps = __getstate__
    loads = __setstate__


class Label:
    """The verdict of an audit as a text of the 3D view, and a mark at each vertex."""

    SIZE = 15.0
    MARK = 7.0
    RED = (0.8, 0.0, 0.0)

    def __init__(self, view):
        from pivy import coin

        self.place, self.text = coin.SoTranslation(), coin.SoText2()
        self.places, self.marks = coin.SoCoordinate3(), coin.SoPointSet()
        words, red, font, style = coin.SoBaseColor(), coin.SoBaseColor(), coin.SoFont(), coin.SoDrawStyle()
        words.rgb.setValue(*preferences.comb_colour())
        red.rgb.setValue(*self.RED)
        font.name.setValue("sans")
        font.size.setValue(self.SIZE)
        style.pointSize.setValue(self.MARK)
        self.shown = coin.SoSwitch()
        for nodes in ((self.place, words, font, self.text), (red, style, self.places, self.marks)):
            group = coin.SoSeparator()
            for node in nodes:
                group.addChild(node)
            self.shown.addChild(group)
        view.RootNode.addChild(self.shown)
        self.switch(view.Visibility)

    def switch(self, on):
        self.shown.whichChild.setValue(-3 if on else -1)  # SO_SWITCH_ALL, SO_SWITCH_NONE

    def show(self, item):
        shape = item.Shape
        lines, places = [], []
        if not shape.isNull():
            box = shape.BoundBox
            lift = 0.04 * box.DiagonalLength
            self.place.translation.setValue(box.XMin, box.YMax + lift, box.ZMax)
            lines = item.Verdict.split("; ")
            places = [tuple(p) for p in item.Places] if item.ShowVertices else []
        self.text.string.deleteValues(0)
        self.text.string.setValues(0, len(lines), lines)
        self.places.point.deleteValues(0)
        self.places.point.setValues(0, len(places), places)
        self.marks.numPoints.setValue(len(places))


def kind_of(item):
    return getattr(getattr(item, "Proxy", None), "KIND", "")


def attach(item):
    """The view of a new feature."""
    view = item.ViewObject
    if view is None:
        return
    View(view)
    View.attach(view.Proxy, view)
    kind = kind_of(item)
    if kind == "FairCurve":
        colour_lines(view, preferences.curve_colour(), 3.0)
    elif kind == "CurvatureAudit":
        colour_lines(view, preferences.comb_colour(), 1.0)
    elif kind == "Region":
        view.ShapeColor = (0.91, 0.64, 0.24)
        view.Transparency = 50
        view.Deviation = 0.01  # regions are thin: arcs drawn coarsely would cross
        view.AngularDeflection = 2.0
        colour_lines(view, (0.91, 0.64, 0.24), 1.0)


def colour_lines(view, colour, width):
    view.LineColor = colour
    view.LineWidth = width
    view.PointColor = colour
    view.PointSize = 1.0
