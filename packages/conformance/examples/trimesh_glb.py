"""Reads and exports a scene of the kit with trimesh: python trimesh_glb.py scene.glb out.glb."""

import sys
from typing import Any

import trimesh

read: Any = trimesh.load_scene(sys.argv[1], process=False)
read.export(sys.argv[2])
