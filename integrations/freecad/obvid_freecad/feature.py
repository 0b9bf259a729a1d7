# SPDX-License-Identifier: Apache-2.0
"""What all features have in common."""
import FreeCAD
import obvid

#: Attributes of App properties.
READ_ONLY, HIDDEN, OUTPUT, NOT_STORED = 1, 4, 8, 16


class NotThere(Exception):
    """What a feature cannot make, in words for the user."""


def words(error):
    """An error in words for the user, with what to do."""
    if isinstance(error, obvid.ObvidError):
        text = f"{error.message[:1].upper()}{error.message[1:]} (E{error.code}"
        text += f", {error.where})" if error.where else ")"
        if error.points:
            shown = ", ".join(str(k + 1) for k in error.points[:10])
            text += f". Points {shown}"
        if error.advice:
            text += f". {error.advice[:1].upper()}{error.advice[1:]}"
        return text
    return str(error)


class Feature:
    """A feature of Python: `build` makes it. Errors become its verdict and FreeCAD's mark of an error; the
    shape of before stays, so that what was built on it stays too until it can be computed again."""

    KIND = ""
    #: name: (type, group, explanation, first value)
    INPUTS = {}
    #: name: (type, explanation)
    RESULTS = {"Verdict": ("App::PropertyString", "What is known of the result")}

    def __init__(self, item):
        item.Proxy = self
        self.add_properties(item)

    def add_properties(self, item):
        """Those that are missing: files of older versions get them when they are opened."""
        present = set(item.PropertiesList)
        for name, (kind, group, explanation, first) in self.INPUTS.items():
            if name in present:
                continue
            item.addProperty(kind, name, group, explanation)
            if first is not None:
                setattr(item, name, first)
                if isinstance(first, list) and kind == "App::PropertyEnumeration":
                    setattr(item, name, first[0])
        for name, (kind, explanation) in self.RESULTS.items():
            if name not in present:
                hidden = HIDDEN if name == "Stored" else 0
                item.addProperty(kind, name, "Result", explanation, READ_ONLY | OUTPUT | hidden)

    def onDocumentRestored(self, item):
        self.add_properties(item)

    def execute(self, item):
        try:
            self.build(item)
        except (obvid.ObvidError, ValueError, NotThere) as error:
            text = words(error)
            if item.Verdict != text:
                item.Verdict = text
            raise RuntimeError(f"{item.Label}: {text}") from None
        except Exception as error:  # the kernel's, or ours
            item.Verdict = f"Not expected: {type(error).__name__}: {error}"
            raise

    def build(self, item):
        raise NotImplementedError

    # FreeCAD up to 0.21 and from 0.21.2 on; nothing of a feature is outside its properties
    def __getstate__(self):
        return None

    def __setstate__(self, state):
        return None

    dumps = __getstate__
    loads = __setstate__


def of_kind(item, kind):
    """Whether an object is a feature of this class."""
    return isinstance(getattr(item, "Proxy", None), kind)


def new_object(document, feature, name, kind="Part::FeaturePython"):
    """A new feature in a document, with its view where there is a window."""
    item = document.addObject(kind, name)
    feature(item)
    if FreeCAD.GuiUp:
        from . import views

        views.attach(item)
    return item


def place(item, shape, plane):
    """Gives a feature its shape, in coordinates of a plane, and the plane as its placement. (While it is
    recomputed FreeCAD moves shapes to the placement, not the placement to shapes.)"""
    item.Placement = plane
    item.Shape = shape


def length(value):
    """A number of mm of a property with a unit."""
    return float(getattr(value, "Value", value))
