"""Reads meshes from files: OBJ, PLY, OFF, STL, GLB; a format a file."""
