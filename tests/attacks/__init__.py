"""Attacks on the verdict: pictures damaged so that the damage looks like something excusable.

Each attack takes what a comparison has of a scene and returns the case to be explained with the
pixels that were changed. What is changed must come out unexplained, but for the few pixels where
Blender's own rounding decides. `ATTACKS` says which cause each imitates.
"""
