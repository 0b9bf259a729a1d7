# SPDX-License-Identifier: Apache-2.0
"""Qt as FreeCAD brings it: PySide2 up to 0.21, PySide6 in newer builds, both behind the name PySide."""
from PySide import QtCore, QtGui

try:
    from PySide import QtWidgets
except ImportError:  # FreeCAD 0.20: widgets are in QtGui
    QtWidgets = QtGui


def number(flag):
    """The whole number of a flag; PySide6 has enumerations of Python."""
    return int(getattr(flag, "value", flag))


__all__ = ["QtCore", "QtGui", "QtWidgets", "number"]
