"""Has Blender draw for the comparison: a file for each judge, and what all of them need."""
