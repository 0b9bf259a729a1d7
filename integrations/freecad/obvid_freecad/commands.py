# SPDX-License-Identifier: Apache-2.0
"""Commands of the workbench: each makes one feature of the selection and opens its panel."""
import FreeCAD
import FreeCADGui

from . import audit, check, fair_curve, fair_skin, feature, panels, preferences, region, views


class Command:
    NAME, TEXT, TIP, KEY = "", "", "", ""

    def GetResources(self):
        return {"Pixmap": views.icon(self.NAME), "MenuText": self.TEXT, "ToolTip": self.TIP, "Accel": self.KEY}

    def IsActive(self):
        return FreeCAD.ActiveDocument is not None and not FreeCADGui.Control.activeDialog()

    def Activated(self):
        document = FreeCAD.ActiveDocument
        links = panels.selected()
        document.openTransaction(self.TEXT)
        try:
            item = self.make(document, links)
            if links:
                document.recompute()
            panels.show(item)
        except BaseException:
            document.abortTransaction()
            raise

    def make(self, document, links):
        raise NotImplementedError


class FairCurveCommand(Command):
    NAME, TEXT, KEY = "FairCurve", "Fair Curve", "O, C"
    TIP = (
        "A fair curve through points of a sketch, vertices, edges, a wire, a spreadsheet or a file, proved to"
        " have no more vertices than it says; follows its points"
    )

    def make(self, document, links):
        values = {"Noise": preferences.noise(), "Continuity": preferences.continuity()}
        return fair_curve.new(document, links, **values)


class AuditCommand(Command):
    NAME, TEXT, KEY = "CurvatureAudit", "Curvature Comb and Audit", "O, A"
    TIP = "The curvature comb of edges, their vertices, and how many of them the points force"

    def make(self, document, links):
        return audit.new(document, links)


class RegionCommand(Command):
    NAME, TEXT, KEY = "Region", "Region", "O, R"
    TIP = "Where every fair contour through the points of a Fair Curve, or through points, must lie"

    def make(self, document, links):
        if links and feature.of_kind(links[0][0], fair_curve.FairCurve):
            return region.new(document, Curve=links[0][0])
        return region.new(document, links)


class SkinCommand(Command):
    NAME, TEXT, KEY = "FairSkin", "Fair Skin", "O, S"
    TIP = "One face through fair contours of sections: sketches, wires, edges or Fair Curves, in order"

    def make(self, document, links):
        return fair_skin.new(document, links)


class CheckCommand(Command):
    NAME, TEXT, KEY = "Check", "Check", "O, K"
    TIP = "Proves a Fair Curve again from what the document holds, measures joints of edges and faces"

    def make(self, document, links):
        return check.new(document, links[0] if links else None)


COMMANDS = (FairCurveCommand, AuditCommand, RegionCommand, SkinCommand, CheckCommand)


def register():
    """Names of the commands, which FreeCAD knows from now on."""
    names = []
    for kind in COMMANDS:
        name = f"Obvid_{kind.NAME}"
        FreeCADGui.addCommand(name, kind())
        names.append(name)
    return names
