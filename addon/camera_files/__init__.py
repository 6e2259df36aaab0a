"""Cameras in other programs' conventions: a record each, which writes and reads its files."""
