"""Reads .glb and .gltf as the Khronos specification of glTF 2.0 says; `read.py` has the order."""

from .read import read_gltf

__all__ = ["read_gltf"]
