# SPDX-License-Identifier: Apache-2.0
"""Task panels: what goes into a feature, and beside it what was proved. All that happens until OK is one step
of undoing; Cancel leaves the document as it was."""
import FreeCAD
import FreeCADGui

from . import audit, check, fair_curve, fair_skin, feature, preferences, region, sources
from .qt import QtCore, QtWidgets, number

WAIT_MS = 150  #: between the last key and the computation


def selected():
    """(object, [names of parts]) of the selection, in order; nothing of the object that is edited."""
    return [(one.Object, list(one.SubElementNames) or [""]) for one in FreeCADGui.Selection.getSelectionEx()]


def named(value):
    """Links in words."""
    out = []
    for link, subs in sources.links(value):
        parts = [sub for sub in subs if sub]
        shown = ", ".join(parts[:6]) + (f", ... ({len(parts)})" if len(parts) > 6 else "")
        out.append(link.Label + (f": {shown}" if shown else ""))
    return "\n".join(out) or "nothing yet"


class Field:
    """One property and its widget."""

    def __init__(self, panel, name):
        self.panel, self.item, self.name = panel, panel.item, name

    def put(self, value):
        setattr(self.item, self.name, value)
        self.panel.changed()


class Choice(Field):
    def widget(self):
        box = QtWidgets.QComboBox()
        box.addItems(self.item.getEnumerationsOfProperty(self.name))
        box.setCurrentIndex(box.findText(getattr(self.item, self.name)))
        box.currentIndexChanged.connect(lambda _: self.put(box.currentText()))
        return box


class Number(Field):
    def __init__(self, panel, name, most=1e9, decimals=6):
        super().__init__(panel, name)
        self.most, self.decimals = most, decimals

    def widget(self):
        box = QtWidgets.QDoubleSpinBox()
        box.setDecimals(self.decimals)
        box.setRange(0.0, self.most)
        step = QtWidgets.QAbstractSpinBox
        box.setStepType(getattr(step, "StepType", step).AdaptiveDecimalStepType)
        box.setValue(feature.length(getattr(self.item, self.name)))
        box.valueChanged.connect(self.put)
        return box


class Switch(Field):
    def widget(self):
        box = QtWidgets.QCheckBox()
        box.setChecked(bool(getattr(self.item, self.name)))
        box.toggled.connect(self.put)
        return box


class Line(Field):
    """Text as it is."""

    def widget(self):
        line = QtWidgets.QLineEdit(str(getattr(self.item, self.name)))
        line.textEdited.connect(self.put)
        return line


class Points(Field):
    """Numbers of points: 3, 7."""

    def widget(self):
        line = QtWidgets.QLineEdit(", ".join(str(k) for k in getattr(self.item, self.name)))
        line.setPlaceholderText("3, 7")
        line.textEdited.connect(self.read)
        return line

    def read(self, text):
        words = text.replace(",", " ").split()
        if all(word.isdigit() and int(word) > 0 for word in words):
            self.put([int(word) for word in words])


class Given(Field):
    """One line for each point: 3 = 45, 5 = 40..50."""

    def widget(self):
        box = QtWidgets.QPlainTextEdit("\n".join(getattr(self.item, self.name)))
        box.setPlaceholderText("1 = 0\n4 = 76..78" if self.name == "Headings" else "1 = inf\n5 = 20..30")
        box.setMaximumHeight(60)
        box.textChanged.connect(lambda: self.put(box.toPlainText().split("\n") if box.toPlainText() else []))
        return box


class File(Field):
    def widget(self):
        row = QtWidgets.QWidget()
        layout = QtWidgets.QHBoxLayout(row)
        layout.setContentsMargins(0, 0, 0, 0)
        self.line = QtWidgets.QLineEdit(getattr(self.item, self.name))
        self.line.textEdited.connect(self.put)
        button = QtWidgets.QPushButton("...")
        button.clicked.connect(self.choose)
        layout.addWidget(self.line)
        layout.addWidget(button)
        return row

    def choose(self):
        name = QtWidgets.QFileDialog.getOpenFileName(self.panel.form, "Points or drawing")[0]
        if name:
            self.line.setText(name)
            self.put(name)


class Links(Field):
    """What is linked, and a button that takes the selection."""

    def widget(self):
        box = QtWidgets.QWidget()
        layout = QtWidgets.QVBoxLayout(box)
        layout.setContentsMargins(0, 0, 0, 0)
        self.label = QtWidgets.QLabel(self.words())
        button = QtWidgets.QPushButton("Take the selection")
        button.setObjectName("take" + self.name)
        button.clicked.connect(lambda: self.take(selected()))
        layout.addWidget(self.label)
        layout.addWidget(button)
        return box

    def words(self):
        return named(getattr(self.item, self.name))

    def take(self, links):
        links = [link for link in links if link[0] is not self.item]
        if links:
            self.put(links)
            self.label.setText(self.words())


class OneLink(Links):
    """A link to one object, or to parts of it."""

    def words(self):
        value = getattr(self.item, self.name)
        if isinstance(value, tuple):
            return named([value])
        return value.Label if value is not None else "nothing yet"

    def take(self, links):
        if links:
            plain = self.item.getTypeIdOfProperty(self.name) == "App::PropertyLink"
            self.put(links[0][0] if plain else links[0])
            self.label.setText(self.words())


class Panel:
    """The panel of a feature; FreeCAD asks for `form`, `accept` and `reject`."""

    TITLE, ICON = "", ""

    def __init__(self, item):
        from . import views

        self.item = item
        self.document = item.Document
        self.form = QtWidgets.QWidget()
        self.form.setObjectName("ObvidPanel")
        self.form.setWindowTitle(self.TITLE)
        self.form.setWindowIcon(views.qt_icon(self.ICON))
        layout = QtWidgets.QVBoxLayout(self.form)
        rows = QtWidgets.QFormLayout()
        policies = getattr(QtWidgets.QFormLayout, "RowWrapPolicy", QtWidgets.QFormLayout)
        rows.setRowWrapPolicy(policies.WrapLongRows)
        for text, field in self.fields():
            rows.addRow(text, field.widget())
        layout.addLayout(rows)
        self.verdict = QtWidgets.QLabel()
        self.verdict.setObjectName("ObvidVerdict")
        self.verdict.setWordWrap(True)
        self.verdict.setMinimumHeight(70)
        self.verdict.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
        layout.addWidget(self.verdict)
        self.bounds = QtWidgets.QTableWidget(0, 2)
        self.bounds.setObjectName("ObvidBounds")
        self.bounds.horizontalHeader().hide()
        self.bounds.verticalHeader().hide()
        self.bounds.horizontalHeader().setStretchLastSection(True)
        layout.addWidget(self.bounds)
        self.timer = QtCore.QTimer(self.form)
        self.timer.setSingleShot(True)
        self.timer.timeout.connect(self.compute)
        self.tell()

    def fields(self):
        return []

    def figures(self):
        """Rows of the table of bounds."""
        return []

    def good(self):
        """Whether the verdict is one to be glad of."""
        return getattr(self.item, "Proved", getattr(self.item, "Good", True))

    def changed(self):
        if preferences.live():
            self.timer.start(WAIT_MS)

    def compute(self):
        self.timer.stop()
        self.document.recompute()
        self.tell()

    def tell(self):
        bad = "Invalid" in self.item.State
        good = not bad and self.good()
        colour = "#b00020" if bad else "#00692b" if good else "#8a5a00"
        text = self.item.Verdict or "Choose what it is made of."
        shown = text.replace("&", "&amp;").replace("<", "&lt;")
        self.verdict.setText(f'<span style="color:{colour}"><b>{shown}</b></span>')
        rows = [] if bad else self.figures()
        self.bounds.setRowCount(len(rows))
        self.bounds.setVisible(bool(rows))
        for k, (name, value) in enumerate(rows):
            self.bounds.setItem(k, 0, QtWidgets.QTableWidgetItem(name))
            self.bounds.setItem(k, 1, QtWidgets.QTableWidgetItem(str(value)))
        self.bounds.resizeColumnToContents(0)
        self.bounds.resizeRowsToContents()

    # ---- what FreeCAD asks -----------------------------------------------------------------

    def getStandardButtons(self):
        box = QtWidgets.QDialogButtonBox
        kinds = getattr(box, "StandardButton", box)
        return number(kinds.Ok) | number(kinds.Cancel)

    def accept(self):
        self.compute()
        self.document.commitTransaction()
        FreeCADGui.Control.closeDialog()
        return True

    def reject(self):
        self.timer.stop()
        self.document.abortTransaction()
        FreeCADGui.Control.closeDialog()
        self.document.recompute()
        return True


class FairCurvePanel(Panel):
    TITLE, ICON = "Fair Curve", "FairCurve"

    def fields(self):
        return [
            ("Points", Links(self, "Sources")),
            ("Cells", Line(self, "Cells")),
            ("File", File(self, "File")),
            ("Noise (mm)", Number(self, "Noise")),
            ("Tangents (degrees)", Given(self, "Headings")),
            ("Radii (mm)", Given(self, "Radii")),
            ("Corners at points", Points(self, "Corners")),
            ("Ends", Choice(self, "Closed")),
            ("Continuity", Choice(self, "Continuity")),
            ("Carrier", Choice(self, "Carrier")),
            ("No inflection", Switch(self, "Convex")),
            ("Keep lines and arcs", Switch(self, "LinesAndArcs")),
        ]

    def figures(self):
        item = self.item
        return [
            ("points", item.PointCount),
            ("vertices", item.Vertices),
            ("forced by the points", item.LowerBound),
            ("inflections", item.Inflections),
            ("largest move of a point", fair_curve.figure(item.LargestMove.Value)),
            ("error bound", fair_curve.figure(item.ErrorBound.Value)),
            ("computed in", f"{item.Milliseconds:.1f} ms"),
        ]


class AuditPanel(Panel):
    TITLE, ICON = "Curvature Comb and Audit", "CurvatureAudit"

    def fields(self):
        return [
            ("Edges", Links(self, "Edges")),
            ("Points", Links(self, "Points")),
            ("Teeth on an edge", Whole(self, "Teeth")),
            ("Height (share of the size)", Number(self, "Height", 2.0, 3)),
            ("Mark vertices", Switch(self, "ShowVertices")),
        ]

    def good(self):
        return self.item.Vertices <= max(self.item.LowerBound, 0) and self.item.Steps == 0

    def figures(self):
        item = self.item
        return [
            ("vertices", item.Vertices),
            ("forced by the points", item.LowerBound if item.LowerBound >= 0 else "unknown"),
            ("inflections", item.Inflections),
            ("steps of curvature or direction", item.Steps),
            ("smallest radius", fair_curve.figure(item.LeastRadius.Value)),
        ]


class Whole(Field):
    def widget(self):
        box = QtWidgets.QSpinBox()
        box.setRange(10, 5000)
        box.setValue(getattr(self.item, self.name))
        box.valueChanged.connect(self.put)
        return box


class RegionPanel(Panel):
    TITLE, ICON = "Region", "Region"

    def fields(self):
        return [
            ("Fair Curve", OneLink(self, "Curve")),
            ("or points", Links(self, "Sources")),
            ("Cells", Line(self, "Cells")),
            ("File", File(self, "File")),
            ("Tangents (degrees)", Given(self, "Headings")),
            ("Radii (mm)", Given(self, "Radii")),
            ("Corners at points", Points(self, "Corners")),
            ("Ends", Choice(self, "Closed")),
        ]

    def figures(self):
        rows = enumerate(self.item.Widths, 1)
        return [(f"points {k} to {k + 1}", fair_curve.figure(width)) for k, width in rows]


class SkinPanel(Panel):
    TITLE, ICON = "Fair Skin", "FairSkin"

    def fields(self):
        return [
            ("Sections", Links(self, "Sections")),
            ("Noise (mm)", Number(self, "Noise")),
            ("Tolerance (mm)", Number(self, "Tolerance")),
            ("Match", Choice(self, "Match")),
            ("Sections", Choice(self, "Closed")),
        ]

    def figures(self):
        item = self.item
        return [
            ("sections proved", item.ProvedSections),
            ("from the contours", fair_curve.figure(item.FromContours.Value)),
            ("from the points", fair_curve.figure(item.FromPoints.Value)),
            ("faces", item.Patches),
        ]


class CheckPanel(Panel):
    TITLE, ICON = "Check", "Check"

    def fields(self):
        return [("Target", OneLink(self, "Target"))]

    def figures(self):
        return [tuple(line.split(": ", 1)) for line in self.item.Findings]


PANELS = {
    fair_curve.FairCurve.KIND: FairCurvePanel,
    audit.CurvatureAudit.KIND: AuditPanel,
    region.Region.KIND: RegionPanel,
    fair_skin.FairSkin.KIND: SkinPanel,
    check.Check.KIND: CheckPanel,
}


def show(item):
    """The panel of a feature inside a transaction that is open."""
    panel = PANELS[item.Proxy.KIND](item)
    FreeCADGui.Control.showDialog(panel)
    return panel


def edit(item):
    """The panel of a feature that is there, as one step of undoing."""
    if FreeCADGui.Control.activeDialog():
        FreeCAD.Console.PrintWarning("Another task is open\n")
        return None
    item.Document.openTransaction(f"Edit {item.Label}")
    return show(item)
