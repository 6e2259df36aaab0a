"""A right solution: the textbook's formulas, with its two errata put right."""

import numpy as np


def dot(a, b):
    return (a * b).sum(axis=1)


def intersect(origins, directions, triangles):
    p1, p2, p3 = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    n = np.cross(p3 - p1, p2 - p1)
    t = -dot(origins - p1, n) / dot(directions, n)
    x = origins + t[:, None] * directions
    n_s1 = np.cross(p2 - p3, x - p3)
    n_s2 = np.cross(p3 - p1, x - p1)  # printed as n_s3
    n_s3 = np.cross(p1 - p2, x - p2)  # printed as n_s2
    s = np.stack([dot(n, n_s) / dot(n, n) for n_s in (n_s1, n_s2, n_s3)], axis=1)
    hit = (s >= 0).all(axis=1) & (t > 0)
    return np.where(hit, t, np.inf), s
