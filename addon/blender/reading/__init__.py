"""Reads Blender's scene: camera, objects, colours, and what is not modelled."""
