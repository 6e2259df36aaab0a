"""Notes what the panels draw, and how much room each text has, while Blender draws them."""

from contextlib import contextmanager

import blf
import bpy

TABS = 44  # of a sidebar's width, in pixels at a scale of 1: its tabs and margins
MARGINS = 43  # of another region's
INSET = 12  # of a box
HEAD = 29  # of a folded part's head: its arrow
ICON = 21
NAME, VALUE = 0.37, 0.58  # the shares that a setting's name and its value have of a line


class Noting:
    """A layout of Blender's that notes the texts and icons that are drawn in it, and their room.

    What is folded is drawn, too.
    """

    def __init__(self, layout, found, width, shares=None):
        object.__setattr__(self, "layout", layout)
        object.__setattr__(self, "found", found)
        object.__setattr__(self, "width", width)
        object.__setattr__(self, "shares", shares)  # of a split: those of its parts
        object.__setattr__(self, "shared", False)  # a row's buttons share its width
        object.__setattr__(self, "items", [])

    def __getattr__(self, name):
        return getattr(self.layout, name)

    def __setattr__(self, name, value):
        setattr(self.layout, name, value)

    def part(self, layout, less=0.0, shares=None):
        width = self.width * (self.shares.pop(0) if self.shares else 1.0) - less
        return Noting(layout, self.found, width, shares)

    def column(self, **options):
        return self.part(self.layout.column(**options))

    def row(self, **options):
        made = self.part(self.layout.row(**options))
        object.__setattr__(made, "shared", True)
        return made

    def box(self):
        return self.part(self.layout.box(), INSET * scale())

    def split(self, factor=0.0, **options):
        made = self.layout.split(factor=factor, **options)
        return self.part(made, shares=[factor, 1 - factor])

    def panel(self, idname, default_closed=False):
        head, body = self.layout.panel(idname, default_closed=default_closed)
        self.found.setdefault("folded", []).append(body is None)
        return self.part(head, HEAD * scale()), self.part(body or self.layout.column())

    def label(self, text="", icon="NONE", **options):
        self.layout.label(text=text, icon=icon, **options)
        self.note("label", text, icon, swatch=options.get("icon_value"))

    def operator(self, idname, text=None, icon="NONE", **options):
        family, name = idname.split(".")
        label = getattr(getattr(bpy.ops, family), name).get_rna_type().name
        made = self.layout.operator(idname, text=text, icon=icon, **options)
        if text == "":  # an icon alone
            object.__setattr__(self, "width", self.width - ICON * scale())
        swatch = options.get("icon_value")
        self.note("button", label if text is None else text, icon, swatch=swatch)
        return made

    def menu(self, idname, text=None, icon="NONE"):
        self.layout.menu(idname, text=text, icon=icon)
        self.note("button", getattr(bpy.types, idname).bl_label if text is None else text, icon)

    def prop(self, owner, name, text=None, **options):
        self.layout.prop(owner, name, text=text, **options)
        known = owner.bl_rna.properties[name]
        if known.type == "ENUM":
            longest = max((_shown(item.name) for item in known.enum_items), key=len)
            self.note("choice", longest, "DOWNARROW_HLT", 1.0 if text == "" else VALUE)
        is_split, is_box = self.layout.use_property_split, known.type == "BOOLEAN"
        if is_box:
            self.note("box", known.name, "CHECKBOX_HLT", VALUE if is_split else 1.0)
        elif is_split and text is None:
            self.note("name", known.name, "NONE", NAME)

    def note(self, kind, text, icon, share=1.0, swatch=None):
        text = _shown(text)
        entry = {"kind": kind, "text": text, "icon": icon, "room": self.width * share}
        if self.shared and kind == "button":
            if text:
                self.items.append(entry)
            for item in self.items:
                item["room"] = self.width / len(self.items)
        self.found.setdefault("drawn", []).append(entry)
        blf.size(0, bpy.context.preferences.ui_styles[0].widget.points * scale())
        entry["width"] = blf.dimensions(0, text)[0] + (
            ICON * scale() if icon != "NONE" or swatch else 0
        )


def _shown(text):
    """A text in the language that Blender has."""
    return bpy.app.translations.pgettext(text)


def scale():
    return bpy.context.preferences.system.ui_scale


@contextmanager
def noting(main, parts):
    """Note what a panel and its parts draw, by their names, for as long as this lasts.

    A part that is folded is drawn within the main panel, too.
    """
    found = {}
    owner = getattr(bpy.types, main)
    own, real = owner.__dict__.get("draw"), owner.draw

    def note(self, context):
        region = context.region
        taken = TABS if region.type == "UI" else MARGINS
        width = region.width - taken * scale()
        for kind in (main, *parts):
            panel = getattr(bpy.types, kind)
            if getattr(panel, "poll", lambda _: True)(context):
                found[kind] = {}
                layout = Noting(self.layout, found[kind], width)
                shown = type("Shown", (), {"layout": layout})()
                (real if kind == main else panel.draw)(shown, context)

    owner.draw = note
    try:
        yield found
    finally:
        if own is None:
            del owner.draw
        else:
            owner.draw = own


def cut(found, share=1.0):
    """The texts that need more than a share of their room, of each panel."""
    return {
        kind: texts
        for kind, noted in found.items()
        if (
            texts := [
                (e["text"], round(e["width"]), round(e["room"]))
                for e in noted.get("drawn", ())
                if e["width"] > share * e["room"]
            ]
        )
    }
