"""Judges what students wrote against exact arithmetic: begin at `judging.py`."""
