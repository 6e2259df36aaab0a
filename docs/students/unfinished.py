"""A file that fails: its error is shown as its own, with the line."""

import numpy as np


def on_plane(origins, directions, p1, n):
    return -dot(origins - p1, n) / dot(directions, n)  # dot was never written


def intersect(origins, directions, triangles):
    p1, p2, p3 = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    n = np.cross(p3 - p1, p2 - p1)
    t = on_plane(origins, directions, p1, n)
    return t, np.zeros((len(origins), 3))
