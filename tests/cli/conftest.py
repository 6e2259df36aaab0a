"""Files that need no Blender."""

from __future__ import annotations

import pytest
import trimesh


@pytest.fixture
def ball(tmp_path):
    path = tmp_path / "ball.ply"
    trimesh.creation.icosphere(2, radius=1.0).export(path)
    return path


@pytest.fixture
def small_ball(tmp_path):
    trimesh.creation.icosphere(1).export(tmp_path / "small.ply")
    return str(tmp_path / "small.ply")
