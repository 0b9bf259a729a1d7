# SPDX-License-Identifier: Apache-2.0
# Run by FreeCAD's window at its start: names the workbench, loads it when it is first chosen.
import FreeCADGui


class ObvidWorkbench(FreeCADGui.Workbench):
    MenuText = "Obvid"
    ToolTip = "Fair curves and skins through points, with proofs"

    def __init__(self):
        import obvid_freecad.views

        self.__class__.Icon = obvid_freecad.views.icon("Obvid")

    def Initialize(self):
        import obvid_freecad.commands

        names = obvid_freecad.commands.register()
        self.appendToolbar("Obvid", names)
        self.appendMenu("&Obvid", names)

    def GetClassName(self):
        return "Gui::PythonWorkbench"


FreeCADGui.addWorkbench(ObvidWorkbench())


def _preferences():
    import os

    import obvid_freecad.views

    page = os.path.join(os.path.dirname(obvid_freecad.views.ICONS), "preferences.ui")
    FreeCADGui.addPreferencePage(page, "Obvid")
    FreeCADGui.addIconPath(obvid_freecad.views.ICONS)


_preferences()
del _preferences
