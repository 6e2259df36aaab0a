"""Writes and reads the colours of a scene's objects, for other renderers: a palette as JSON.

`colors.schema.json` in `report/page/` says what it holds.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..arrays import Colors, Floats
from ..files import checked_json
from ..files.checked_json import Content, numbers, objects, part
from ..scene import Scene, SceneError
from .palette import By, GivenColors, Key, automatic_note, clear_palette, eight_bits, not_told_apart

SCHEMA = "reference_tracer.colors/1"
_LAST = "show the last colour"


def owners_of(scene: Scene, owners: Sequence[str] = ()) -> tuple[str, ...]:
    """Return what gives each instance and plane its colour: by default, its own object."""
    return tuple(owners) or tuple(scene.objects[k] for k in scene.instance_objects[:-1])


def text(scene: Scene, owners: Sequence[str]) -> str:
    """Return the colours that a scene's objects show in the view, as the text of a file.

    Raises
    ------
    SceneError
        If an object has other colours than one for each slot.
    """
    found: dict[Key, Colors] = {}
    owners = owners_of(scene, owners)
    for instance, owner in zip(scene.instances, owners, strict=False):
        name = scene.objects[instance.object]
        if scene.meshes[instance.mesh].corner_colors is not None:
            raise SceneError(_no_slots(name, "shows a colour attribute"))
        if not np.array_equal(found.setdefault((name, owner), instance.colors), instance.colors):
            raise SceneError(_no_slots(name, "has instances in several colours"))
    for plane, owner in zip(scene.planes, owners[len(scene.instances) :], strict=True):
        found[scene.objects[plane.object], owner] = plane.color[None]
    content = {
        "schema": SCHEMA,
        "slots_past_the_end": _LAST,
        "background": _color(scene.background) | {"alpha": float(scene.background[3])},
        "objects": [
            {"name": name, "instanced_by": owner, "slots": [_color(c) for c in colors]}
            for (name, owner), colors in sorted(found.items())
        ],
    }
    return json.dumps(content, indent=1, ensure_ascii=False) + "\n"


def _no_slots(name: str, why: str) -> str:
    return f"--colors-out: '{name}' {why}, which no palette can name: choose --colors object"


def _color(color: Floats) -> dict[str, object]:
    return {"linear": color[:3].tolist(), "srgb": eight_bits(color[:3]).tolist()}


def read(path: Path) -> GivenColors:
    """Read a file of colours.

    Raises
    ------
    SceneError
        If there is no such file, it holds no colours, or something in it is wrong, which is named.
    """
    slots = checked_json.read(path, SCHEMA, "--colors-out writes such files", _slots)
    return GivenColors(str(path), slots)


def _slots(content: Content) -> dict[Key, Colors]:
    if content.get("slots_past_the_end", _LAST) != _LAST:
        raise SceneError(f"slots_past_the_end must be {_LAST!r}, as Blender has it")
    found: dict[Key, Colors] = {}
    for entry, where in objects(content, "objects"):
        name = part(entry, "name", where, str)
        owner = part({"instanced_by": name} | entry, "instanced_by", where, str)
        slots = part(entry, "slots", where, list)
        if not slots:
            raise SceneError(f"{where}slots of '{name}' is empty: it needs a colour")
        if (name, owner) in found:
            raise SceneError(f"{where}name is '{name}', which is there twice")
        rows = [_read(slot, f"{where}slots[{k}] of '{name}'") for k, slot in enumerate(slots)]
        found[name, owner] = np.array(rows, np.float32)
    return found


def _read(slot: Content, where: str) -> Floats:
    """Return a colour, (3,) linear RGB; where sRGB is given, too, both must be the same."""
    if not isinstance(slot, dict):
        raise SceneError(f"{where} must be an object in braces")
    linear = numbers(slot, "linear", f"{where}: ", (3,))
    if not ((linear >= 0) & (linear <= 1)).all():
        raise SceneError(f"{where}: linear is {linear.tolist()}; each must be from 0 to 1")
    if "srgb" in slot:
        srgb = numbers(slot, "srgb", f"{where}: ", (3,))
        if np.abs(srgb - eight_bits(linear)).max() > 1:
            own = eight_bits(linear).tolist()
            raise SceneError(
                f"{where}: srgb is {slot['srgb']}, but linear is {own} in 8 bits: leave out srgb, "
                "or make both the same"
            )
    return linear


def in_colors(scene: Scene, by: By | GivenColors) -> tuple[Scene, tuple[str, ...]]:
    """Return a scene that was read from a file in other colours, and what there is to say of it.

    Raises
    ------
    SceneError
        If it has no such colours, an object in the view has none, or one that has is not there.
    """
    if by == By.MATERIAL:
        raise SceneError("--colors material is for a .blend: other scenes have no materials")
    owners = owners_of(scene)
    notes: tuple[str, ...] = ()
    if by == By.AUTOMATIC and (pair := not_told_apart(scene, owners)):
        by = By.OBJECT
        notes = (automatic_note("file", pair),)
    if isinstance(by, GivenColors):
        by.check_known(scene.objects)
        return recolored(scene, by, owners), notes
    if by != By.OBJECT:
        return scene, notes
    clear = clear_palette(sorted(scene.objects)).colors
    given = GivenColors("--colors", {(name, name): c[None] for name, c in clear.items()})
    return recolored(scene, given, owners), notes


def recolored(scene: Scene, given: GivenColors, owners: Sequence[str]) -> Scene:
    """Return a scene in given colours; the owners are those of its instances, then its planes.

    Raises
    ------
    SceneError
        If an object in the view has none.
    """

    def opaque(number: int, owner: str) -> Colors:
        colors = given.of(scene.objects[number], owner)
        return np.hstack((colors, np.ones((len(colors), 1), np.float32)))

    instances = tuple(
        replace(i, colors=opaque(i.object, owner))
        for i, owner in zip(scene.instances, owners, strict=False)
    )
    of_planes = zip(scene.planes, owners[len(instances) :], strict=True)
    planes = tuple(replace(p, color=opaque(p.object, owner)[0]) for p, owner in of_planes)
    meshes = tuple(replace(m, corner_colors=None) for m in scene.meshes)
    return replace(scene, meshes=meshes, instances=instances, planes=planes)
