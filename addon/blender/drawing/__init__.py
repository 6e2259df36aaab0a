"""Blender draws for the comparison: on temporary scenes, by each of its engines."""
