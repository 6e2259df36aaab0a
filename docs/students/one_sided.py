"""Möller and Trumbore's test as much code has it: one side only, and an epsilon in metres."""

import numpy as np

EPSILON = 1e-6


def dot(a, b):
    return (a * b).sum(axis=1)


def intersect(origins, directions, triangles):
    p1, p2, p3 = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    e1, e2 = p2 - p1, p3 - p1
    across = np.cross(directions, e2)
    det = dot(e1, across)
    from_p1 = origins - p1
    u = dot(from_p1, across) / det
    q = np.cross(from_p1, e1)
    v = dot(directions, q) / det
    t = dot(e2, q) / det
    hit = (det > EPSILON) & (u >= 0) & (v >= 0) & (u + v <= 1) & (t > EPSILON)
    return np.where(hit, t, np.inf), np.stack((1 - u - v, u, v), axis=1)
