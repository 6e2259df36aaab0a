"""Files in the making."""

from __future__ import annotations

import pytest


@pytest.fixture(params=["a.glb", "a.gltf"])
def path(request, tmp_path):
    """Return where a glTF file is written, in one file or as text."""
    return tmp_path / request.param
