"""Counts how often Blender evaluates the modifiers of an object, as it reports it itself."""

from __future__ import annotations

import ctypes
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager

import bpy

DONE = "BKE_object_handle_data_update on OBHeavy"  # once for each evaluation of its modifiers


@contextmanager
def counted() -> Iterator[list[int]]:
    """Give a list that has, in the end, how often the modifiers of 'Heavy' were evaluated."""
    found: list[int] = []
    flush = ctypes.CDLL(None).fflush
    flush(None)
    stdout = os.dup(1)
    with tempfile.TemporaryFile() as file:
        os.dup2(file.fileno(), 1)
        bpy.app.debug_depsgraph_eval = True
        try:
            yield found
        finally:
            bpy.app.debug_depsgraph_eval = False
            flush(None)
            os.dup2(stdout, 1)
            os.close(stdout)
        file.seek(0)
        found.append(file.read().decode(errors="replace").count(DONE))
