"""Lists what can be chosen in each setting, with Blender's words for it.

A .blend stores the number of an item. A number that was given away is never given to another item;
a new item takes one that is free.
"""

from __future__ import annotations

import tomllib
from pathlib import Path

from ...methods import RECORDS
from ..drawing import judges

Item = tuple[str, str, str, int]  # identifier, name, description, number
Unstored = tuple[str, str, str]  # identifier, name, description of what no .blend stores

METHODS: tuple[Item, ...] = tuple(
    (m.value, r.label, r.description, r.number) for m, r in reversed(RECORDS.items())
)

PRECISIONS: tuple[Item, ...] = (
    ("float64", "float64", "Double precision", 0),
    ("float32", "float32", "Single precision, as graphics hardware has it", 1),
)

SHADINGS: tuple[Item, ...] = (
    (
        "LIKE_FOR_LIKE",
        "Like for Like",
        "Blender draws what the tracer does: flat light, the same colours, no effects, raw view",
        0,
    ),
    ("AS_IS", "As It Is", "Blender draws with the shading that the scene has", 1),
)

PALETTES: tuple[Item, ...] = (
    (
        "AUTOMATIC",
        "Automatic",
        "The viewport's colours where they tell objects apart, else a clear colour for each "
        "object; F12 does the same",
        0,
    ),
    ("VIEWPORT", "Viewport", "The colours that the scene's solid shading has", 1),
    ("OBJECT", "Object", "A clear colour for each object", 2),
    (
        "MATERIAL",
        "Material",
        "The base colour of each material's Principled BSDF, where it is one colour",
        3,
    ),
)

JUDGES: tuple[Item, ...] = (
    (
        judges.AUTO,
        "Automatic",
        "The viewport in a window, Workbench in background; Cycles of a panorama",
        0,
    ),
    *(
        (name.upper(), judge.label, judge.description, judge.number or 0)
        for name, judge in judges.choices().items()
    ),
    (
        judges.ENGINE,
        "Another Engine",
        "A render of the same constant colours by an engine that an add-on registers",
        10,
    ),
    (judges.RENDER_RESULT, "Render Result", "What was rendered last of this scene", 11),
    (judges.IMAGE, "Image", "An image of this file, whatever made it", 12),
)

# How a picture that no engine drew for the comparison was made.
RENDERERS: tuple[Item, ...] = (
    ("AUTO", "Automatic", "As the picture says, else rays", 0),
    ("RAYS", "Rays", "Float32 rays", 1),
    ("RASTER", "Rasterised", "A depth buffer of 24 bits, and rounded corners", 2),
)

# Colours of a render's surfaces: `tracer/coloring.py` has the functions.
COLORS: tuple[Item, ...] = (
    ("object", "Object", "The object's own colour", 0),
    ("normal", "Normal", "The normal in world space: red, green, blue are X, Y, Z", 1),
    ("facing", "Facing", "Light where it faces the ray, dark edge-on, reddish at backs", 2),
    ("depth", "Depth", "From white at the nearest hit to dark at the farthest, evenly", 3),
)

# Pictures of a 3D view: `live/shows.py` has the functions. The colours follow, 4 and more.
SHOWS: tuple[Item, ...] = (
    ("PICTURE", "Picture", "What a render shows", 0),
    (
        "WRONG",
        "Wrong Pixels",
        "The chosen method's picture, dimmed, with wrong pixels in red: there the method sees "
        "another surface than is proven. The view's corner counts them",
        1,
    ),
    (
        "DIFFERENCE",
        "Difference",
        "Once the view rests, Blender's viewport draws it, too, flat and unsmoothed. Pixels that "
        "differ have the colour of their cause, as in a comparison",
        2,
    ),
    (
        "CERTAINTY",
        "Certainty",
        "How each pixel was decided: dark by an error bound, blue by integers, yellow by a rule, "
        "as the ray meets an edge or two surfaces at once",
        3,
    ),
    *((name.upper(), label, text, 4 + number) for name, label, text, number in COLORS),
)

# Each number is one bit: that of the pass's place among `tracer.frame.PASSES`.
PASSES: tuple[Item, ...] = (
    ("Depth", "Depth", "Distance along the view axis, in metres; 1e10 where nothing is hit", 0x002),
    ("T", "T", "The ray's parameter at the hit: also the depth in metres", 0x004),
    ("Position", "Position", "Where the ray hits, in world space, in metres", 0x008),
    ("Normal", "Normal", "The surface's normal in world space, of length 1", 0x010),
    (
        "Barycentrics",
        "Barycentrics",
        "The weights of the triangle's three corners at the hit",
        0x020,
    ),
    ("Object Index", "Object Index", "The number of the object, from 1; 0 for none", 0x040),
    (
        "Triangle Index",
        "Triangle Index",
        "The number of the triangle in its mesh, from 1; 0 for none",
        0x100,
    ),
    (
        "Certainty",
        "Certainty",
        "How each pixel was decided, as a number: 0 is not proven",
        0x200,
    ),
)

# Which export of the scene a pixel is derived from.
SOURCES: tuple[Unstored, ...] = (
    ("SCENE", "Scene", "The scene now, as Trace and Compare takes it"),
    ("RENDER", "Render", "The scene now, as a render takes it"),
    ("COMPARISON", "Comparison", "The scene as the latest comparison took it"),
    ("PUT_RIGHT", "Put Right", "That scene, with what 'Show as Put Right' shows put right"),
)


_SCENARIOS = tomllib.loads(
    (Path(__file__).parents[2] / "study/scenarios/sweeps.toml").read_text(encoding="utf-8")
)


EVERY = "ALL"  # in place of a scenario's name
STUDIES = (
    (EVERY, "All", "Every scenario"),
    *((s["name"], s["title"], s["explanation"].rstrip(".")) for s in _SCENARIOS["scenario"]),
)
