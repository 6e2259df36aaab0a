"""Right nearest hits as a program: reftrace judge --subject nearest --run 'python nearest.py'."""

import sys

OBJECTS = 5


def sub(a, b):
    return [v - w for v, w in zip(a, b, strict=True)]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def intersect(o, d, p1, p2, p3):
    n = cross(sub(p3, p1), sub(p2, p1))
    if dot(d, n) == 0:
        return float("inf")
    t = -dot(sub(o, p1), n) / dot(d, n)
    x = [v + t * w for v, w in zip(o, d, strict=True)]
    s = [dot(n, cross(sub(a, b), sub(x, b))) for a, b in ((p2, p3), (p3, p1), (p1, p2))]
    return t if t > 0 and min(s) >= 0 else float("inf")


def nearest(o, d, corners, scales, positions):
    best, found = float("inf"), 0
    for k in range(OBJECTS):
        p1, p2, p3 = (corners[9 * k + j : 9 * k + j + 3] for j in (0, 3, 6))
        position = positions[3 * k : 3 * k + 3]
        own = [v / scales[k] for v in sub(o, position)]
        t = intersect(own, [v / scales[k] for v in d], p1, p2, p3)
        if t < best:
            best, found = t, k
    return best, found


for line in sys.stdin:
    v = [float(word) for word in line.split(",")]
    print(*nearest(v[:3], v[3:6], v[6:51], v[51:56], v[56:]), sep=",")
