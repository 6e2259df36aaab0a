"""Reads meshes from files: OBJ, PLY, OFF, STL, glTF; a format a file."""
