"""What Blender is asked to do: a comparison, with one engine or all, of frames, of a picture."""
