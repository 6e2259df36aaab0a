"""Blender's jobs: a comparison with one engine or all, of frames, of a picture."""
