"""Blender's scene is read: camera, objects, colours, and what is not modelled."""
