# SPDX-License-Identifier: Apache-2.0
"""What the user chose on the page Edit > Preferences > Obvid; first values of new features."""
import FreeCAD

GROUP = "User parameter:BaseApp/Preferences/Mod/Obvid"


def _group():
    return FreeCAD.ParamGet(GROUP)


def teeth():
    return max(10, min(5000, _group().GetInt("Teeth", 200)))


def comb_height():
    return max(0.001, min(2.0, _group().GetFloat("CombHeight", 0.15)))


def noise():
    return max(0.0, _group().GetFloat("Noise", 0.0))


def continuity():
    return ("automatic", "G2", "G3")[max(0, min(2, _group().GetInt("Continuity", 0)))]


def live():
    """Whether panels compute while something is typed."""
    return _group().GetBool("Live", True)


def colour(name, first):
    """A colour as three shares of 1; stored as 0xRRGGBBAA."""
    value = _group().GetUnsigned(name, first)
    return tuple(((value >> shift) & 255) / 255.0 for shift in (24, 16, 8))


def comb_colour():
    return colour("CombColour", 0xE67319FF)


def curve_colour():
    return colour("CurveColour", 0x1A4DE6FF)
