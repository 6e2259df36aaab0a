"""Finds the files that a .blend names, that shape its picture, and that are not there.

Data-blocks name some (fonts, images, caches, volumes), modifiers and nodes others.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from glob import escape, glob
from pathlib import Path
from typing import Any, NamedTuple

import bpy
from bpy.types import ID, Library

from ..versions import bake_folder

_TILE = re.compile(r"<(UDIM|UVTILE)>")
# A sequence's: the last of a name, but for one of its suffix, as of .jp2.
_NUMBER = re.compile(r"\d+(?=\D*(?:\.\w+)?$)")


class Lost(NamedTuple):
    """Something that a data-block needs, and that is not there."""

    block: ID
    kind: str
    name: str  # a path, as the .blend has it
    of: str  # what of the block needs it


def lost_files(mode: str, frame: int) -> Iterator[Lost]:
    """Yield the files that are not there, of all data-blocks, used or not.

    Parameters
    ----------
    mode : str
        The evaluation, 'VIEWPORT' or 'RENDER': it decides which modifiers are on.
    frame : int
        The scene's.
    """
    yield from _of_blocks(frame)
    flag = "show_viewport" if mode == "VIEWPORT" else "show_render"
    for obj in bpy.data.objects:
        for modifier in (m for m in obj.modifiers if getattr(m, flag)):
            kind = "file" if modifier.type == "MESH_CACHE" else "folder"
            for path in _paths(modifier):
                if path and not exists(obj, path):
                    yield Lost(obj, kind, path, f"modifier '{modifier.name}' of '{obj.name}'")
    for tree in bpy.data.node_groups:
        for node in tree.nodes if tree.type == "GEOMETRY" else ():
            path = _imported(node)
            if path and not exists(tree, path):
                yield Lost(tree, "file", path, f"node '{node.name}' of '{tree.name}'")


def _of_blocks(frame: int) -> Iterator[Lost]:
    for font in bpy.data.fonts:
        if font.filepath != "<builtin>":
            yield from _lost(font, "font")
    for image in bpy.data.images:
        if image.source in ("FILE", "SEQUENCE", "MOVIE", "TILED"):
            yield from _lost(image, "image", image.source == "SEQUENCE")
    for cache in bpy.data.cache_files:
        shown = cache.frame if cache.override_frame else frame
        path = _of_frame(cache.filepath, int(shown)) if cache.is_sequence else cache.filepath
        if path and not exists(cache, path):
            yield Lost(cache, "file", path, f"cache '{cache.name}'")
    for volume in bpy.data.volumes:
        yield from _lost(volume, "volume", volume.is_sequence)


def _lost(block: Any, kind: str, is_sequence: bool = False) -> Iterator[Lost]:
    """Yield a data-block's file if it is neither packed nor there, of a sequence in any frame."""
    path = _NUMBER.sub("*", block.filepath, count=1) if is_sequence else block.filepath
    packed = block.packed_file or getattr(block, "packed_files", ())
    if path and not packed and not exists(block, path):
        yield Lost(block, "file", block.filepath, f"{kind} '{block.name}'")


def _of_frame(path: str, frame: int) -> str:
    return _NUMBER.sub(lambda number: f"{frame:0{len(number[0])}}", path, count=1)


def exists(block: ID, path: str) -> bool:
    """Return whether a path of a data-block leads anywhere; it may have a * in its name."""
    full = _absolute(path, block.library)
    if os.path.exists(full):
        return True
    folder, name = os.path.split(full)
    pattern = escape(_TILE.sub("*", name)).replace("[*]", "*")
    return "*" in pattern and bool(glob(os.path.join(escape(folder), pattern)))


def _absolute(path: str, library: Library) -> str:
    """Return a path of a library, or of the .blend itself; one of Windows' as Blender reads it."""
    start = os.path.dirname(_absolute(library.filepath, library.parent)) if library else None
    return bpy.path.abspath(path.replace("\\", "/"), start=start)


def _paths(modifier: Any) -> Iterator[str]:
    """Yield the file that a modifier reads, or the folders of its caches."""
    kind = modifier.type
    if kind == "MESH_CACHE" or (kind == "OCEAN" and modifier.is_cached):
        yield modifier.filepath
    elif kind == "FLUID" and modifier.fluid_type == "DOMAIN":
        domain = modifier.domain_settings
        if domain.has_cache_baked_any:
            yield domain.cache_directory
    elif kind in ("CLOTH", "SOFT_BODY"):
        yield _baked(modifier.point_cache)
    elif kind == "PARTICLE_SYSTEM":
        yield _baked(modifier.particle_system.point_cache)
    elif kind == "DYNAMIC_PAINT" and modifier.canvas_settings:
        for surface in modifier.canvas_settings.canvas_surfaces:
            yield _baked(surface.point_cache)
    elif kind == "NODES":
        for bake in modifier.bakes:
            yield bake_folder(modifier, bake)


def _baked(cache: Any) -> str:
    """Return the folder in which a `bpy.types.PointCache` has its files, if it has any."""
    if cache.use_external:
        return cache.filepath
    if cache.is_baked and cache.use_disk_cache:
        return f"//blendcache_{Path(bpy.data.filepath).stem}"
    return ""


def _imported(node: Any) -> str:
    """Return the path that a node of geometry nodes imports, if it is written in the node."""
    if not node.bl_idname.startswith("GeometryNodeImport"):
        return ""
    path = node.inputs.get("Path")
    return "" if path is None or path.is_linked else path.default_value
