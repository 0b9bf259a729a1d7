# SPDX-License-Identifier: Apache-2.0
"""Obvid in FreeCAD: fair curves, audits of curvature, regions, fair skins, checks (docs/freecad.md).

Modules below `window` need FreeCAD's window; all others run in freecadcmd too.
"""
