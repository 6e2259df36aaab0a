"""A right ray/triangle test as a program: reftrace judge --run 'python textbook.py'."""

import sys


def sub(a, b):
    return [v - w for v, w in zip(a, b, strict=True)]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def intersect(o, d, p1, p2, p3):
    n = cross(sub(p3, p1), sub(p2, p1))
    if dot(d, n) == 0:
        return ["inf"]
    t = -dot(sub(o, p1), n) / dot(d, n)
    x = [v + t * w for v, w in zip(o, d, strict=True)]
    s = [dot(n, cross(sub(a, b), sub(x, b))) / dot(n, n) for a, b in ((p2, p3), (p3, p1), (p1, p2))]
    return [t, *s] if t > 0 and min(s) >= 0 else ["inf"]


for line in sys.stdin:
    v = [float(word) for word in line.split(",")]
    print(*intersect(v[:3], v[3:6], v[6:9], v[9:12], v[12:]), sep=",")
