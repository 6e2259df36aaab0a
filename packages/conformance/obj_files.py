"""Writes a kit's scene as .obj and .mtl: in world space, Z up, an object for each."""

from __future__ import annotations

from collections.abc import Iterator

from reference_tracer.tracer.vector import transform_points

from .scenes import PALETTE, KitScene


def obj_text(kit: KitScene, library: str) -> str:
    """Return the .obj, whose materials are in the file `library`."""
    return "\n".join(["# Z is up, in metres", f"mtllib {library}", *_lines(kit), ""])


def _lines(kit: KitScene) -> Iterator[str]:
    before = 1
    for item in kit.items:
        points = transform_points(item.world_from_object, item.shape.vertices.T.astype(float)).T
        yield f"o {item.name}"
        yield from (f"v {x!r} {y!r} {z!r}" for x, y, z in points.tolist())
        used = -1
        for polygon, slot in zip(item.shape.polygons, item.shape.slot_of, strict=True):
            if slot != used:
                yield f"usemtl color{item.colors[slot]}"
                used = slot
            yield "f " + " ".join(str(before + v) for v in polygon)
        before += len(points)


def mtl_text(kit: KitScene) -> str:
    """Return the .mtl: `Kd` is linear RGB, and `illum 0` means that it is shown as it is."""
    used = sorted({c for item in kit.items for c in item.colors})
    lines = ["# Kd is linear RGB"]
    for color in used:
        red, green, blue = PALETTE[color].tolist()
        lines += [f"newmtl color{color}", f"Kd {red!r} {green!r} {blue!r}", "illum 0"]
    return "\n".join([*lines, ""])
