"""The textbook's formulas exactly as printed: both errata in one file."""

import numpy as np


def dot(a, b):
    return (a * b).sum(axis=1)


def intersect(origins, directions, triangles):
    p1, p2, p3 = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    n = np.cross(p3 - p1, p2 - p1)
    t = -dot(origins - p1, n) / dot(directions, n)
    x = origins + t[:, None] * directions
    n_s1 = np.cross(p2 - p3, x - p3)
    n_s2 = np.cross(p1 - p2, x - p2)
    n_s3 = np.cross(p3 - p1, x - p1)
    s1, s2, s3 = (dot(n, n_s) / dot(n, n) for n_s in (n_s1, n_s2, n_s3))
    inside = (0 <= s1) & (s1 <= 1) & (0 <= s2) & (s2 <= 1) & (0 <= s3) & (s3 <= 1)
    hit = inside & (s1 + s2 + s3 == 1) & (t > 0)
    return np.where(hit, t, np.inf), np.stack((s1, s2, s3), axis=1)
