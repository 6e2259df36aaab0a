"""Students' files: two that are right, many that are wrong in one known way each, hostile ones."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.triangle import TESTS
from reference_tracer_grading.subjects.triangle import TRIANGLE

TEXTBOOK = """
import numpy as np

def dot(a, b):
    return (a * b).sum(axis=1)

def intersect(origins, directions, triangles):
    o, d = origins, directions
    p1, p2, p3 = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    n = np.cross(p3 - p1, p2 - p1)
    slope = dot(d, n)
    t = -dot(o - p1, n) / slope
    x = o + t[:, None] * d
    s1 = dot(n, np.cross(p2 - p3, x - p3)) / dot(n, n)
    s2 = dot(n, np.cross(p3 - p1, x - p1)) / dot(n, n)
    s3 = dot(n, np.cross(p1 - p2, x - p2)) / dot(n, n)
    hit = (s1 >= 0) & (s2 >= 0) & (s3 >= 0) & (t > 0)
    return np.where(hit, t, np.inf), np.stack((s1, s2, s3), axis=1)
"""

MOLLER_TRUMBORE = """
import numpy as np

def dot(a, b):
    return np.einsum("ij,ij->i", a, b)

def intersect(origins, directions, triangles):
    p1, p2, p3 = np.moveaxis(triangles, 1, 0)
    e1, e2 = p2 - p1, p3 - p1
    h = np.cross(directions, e2)
    f = 1 / dot(e1, h)
    q = origins - p1
    u = f * dot(q, h)
    r = np.cross(q, e1)
    v = f * dot(directions, r)
    t = f * dot(e2, r)
    hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0)
    return np.where(hit, t, np.nan), np.column_stack((1 - u - v, u, v))
"""

LOOP = """
import math

def cross(a, b):
    return (a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0])

def dot(a, b):
    return a[0]*b[0] + a[1]*b[1] + a[2]*b[2]

def one(o, d, triangle):
    p1, p2, p3 = triangle
    n = cross([a - b for a, b in zip(p3, p1)], [a - b for a, b in zip(p2, p1)])
    if dot(d, n) == 0:
        return math.inf, (0, 0, 0)
    t = -dot([a - b for a, b in zip(o, p1)], n) / dot(d, n)
    x = [a + t * b for a, b in zip(o, d)]
    s = []
    for a, b in ((p2, p3), (p3, p1), (p1, p2)):
        edge = [v - w for v, w in zip(a, b)]
        s.append(dot(n, cross(edge, [v - w for v, w in zip(x, b)])) / dot(n, n))
    return (t if min(s) >= 0 and t > 0 else math.inf), s

def intersect(origins, directions, triangles):
    rays = zip(origins.tolist(), directions.tolist(), triangles.tolist())
    found = [one(*ray) for ray in rays]
    return [t for t, _ in found], [s for _, s in found]
"""

SIGNED_VOLUMES = """
import numpy as np

def volume(x, y, z):
    return np.einsum("ij,ij->i", x, np.cross(y, z))

def intersect(origins, directions, triangles):
    a, b, c = (triangles[:, k] - origins for k in range(3))
    v = [volume(directions, *pair) for pair in ((c, b), (a, c), (b, a))]
    total = sum(v)
    s = np.stack(v, 1) / total[:, None]
    rows, k = np.arange(len(total)), np.abs(directions).argmax(1)
    depths = np.stack([corner[rows, k] for corner in (a, b, c)], 1)
    t = (s * depths).sum(1) / directions[rows, k]
    inside = (s >= 0).all(1) & (total != 0) & (t > 0)
    return np.where(inside, t, np.inf), np.where(inside[:, None], s, 0)
"""

NO_GUARD = LOOP.replace("    if dot(d, n) == 0:\n        return math.inf, (0, 0, 0)\n", "")

RIGHT = {
    "textbook": TEXTBOOK,
    "moller_trumbore": MOLLER_TRUMBORE,
    "loop": LOOP,
    "signed_volumes": SIGNED_VOLUMES,
}

HIT = "hit = (s1 >= 0) & (s2 >= 0) & (s3 >= 0) & (t > 0)"
RETURN = "return np.where(hit, t, np.inf), np.stack((s1, s2, s3), axis=1)"
# The fault's name -> what is written instead of what.
WRONG = {
    "s2_s3_swapped": ("stack((s1, s2, s3)", "stack((s1, s3, s2)"),
    "barycentrics_order": ("stack((s1, s2, s3)", "stack((s3, s1, s2)"),
    "barycentrics_scale": ("np.stack((s1, s2, s3), axis=1)",
                           "np.stack((s1, s2, s3), axis=1) * dot(n, n)[:, None]"),
    "barycentrics_scale_and_order": ("np.stack((s1, s2, s3), axis=1)",
                                     "-0.5 * np.stack((s1, s3, s2), axis=1)"),
    "barycentrics_not_finite": ("np.stack((s1, s2, s3), axis=1)",
                                "np.stack((s1, s2, np.nan * s3), axis=1)"),
    "barycentrics_zero": ("np.stack((s1, s2, s3), axis=1)", "np.zeros((len(t), 3))"),
    "sum_equals_one": (HIT, HIT + " & (s1 + s2 + s3 == 1)"),
    "back_faces_culled": (HIT, HIT + " & (slope > 0)"),
    "front_faces_culled": (HIT, HIT + " & (slope < 0)"),
    "hits_behind": (" & (t > 0)", ""),
    "edge_not_tested": ("(s2 >= 0) & ", ""),
    "inside_not_tested": ("(s1 >= 0) & (s2 >= 0) & (s3 >= 0) & ", ""),
    "tolerance_too_wide": ("(s1 >= 0)", "(s1 >= -1e-5)"),
    "tolerance_too_narrow": ("(s3 >= 0)", "(s3 > 1e-6)"),
    "absolute_epsilon": (HIT, HIT + " & (abs(slope) > 1e-8)"),
    "t_is_distance": ("o, d = origins, directions",
        "o, d = origins, directions / np.linalg.norm(directions, axis=1)[:, None]"),
    "t_times_length": ("np.where(hit, t, ",
                       "np.where(hit, t / np.linalg.norm(d, axis=1), "),
    "t_sign": ("t = -dot(o - p1, n) / slope\n    x = o + t[:, None] * d",
                  "t = dot(o - p1, n) / slope\n    x = o - t[:, None] * d"),
    "float32": ("triangles[:, 0], triangles[:, 1], triangles[:, 2]",
                "np.moveaxis(triangles.astype(np.float32), 1, 0)\n"
                "    o, d = np.float32(o), np.float32(d)"),
    "parallel": (RETURN, "hit |= slope == 0\n    t = np.where(slope == 0, 1.0, t)\n    " + RETURN),
    "no_hits": (HIT, HIT + " & False"),
    "all_hits": ("np.where(hit, t, np.inf)", "np.where(hit, t, 1.0)"),
    "depends_on_the_call": (RETURN, "t = t * (1 + 1e-3 * (len(t) < 9))\n    " + RETURN),
    "unrecognised_t": ("np.where(hit, t, np.inf)", "np.where(hit, t + 0.01, np.inf)"),
    "unrecognised_hits": (HIT, HIT + " & (o[:, 0] > 0)"),
    "unrecognised_barycentrics": ("np.stack((s1, s2, s3), axis=1)",
                                  "np.stack((s1, s2, s3), axis=1) ** 2"),
}  # fmt: skip


def wrong(name: str) -> str:
    """The textbook's solution with one fault."""
    old, new = WRONG[name]
    assert TEXTBOOK.count(old) == 1, name
    return TEXTBOOK.replace(old, new)


@pytest.fixture(scope="session")
def right() -> dict[str, str]:
    """Texts of right files, by name."""
    return RIGHT


def plain(method: Method):
    """One of the tracer's own unproven methods, as a student would have written it."""

    def intersect(origins, directions, triangles):
        hit, t, s = TESTS[method](Rays(origins.T, directions.T), *triangles.transpose(1, 2, 0))
        with np.errstate(invalid="ignore"):
            return np.where(hit & (t > 0), t, np.inf), s.T

    return intersect


def running(word: str) -> bool:
    """Whether a process has a word in its command."""
    commands = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with suppress(OSError):
            commands.append(path.read_text(errors="replace").split("\0"))
    return any(word in command for command in commands)


@pytest.fixture(autouse=True)
def own_key(tmp_path, monkeypatch):
    """Tests sign with a key of their own, not with the user's."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))


@pytest.fixture(scope="session")
def no_guard() -> str:
    """The text of a file that divides by zero on rays in the triangle's plane."""
    return NO_GUARD


@pytest.fixture(params=sorted(WRONG))
def fault(request) -> tuple[str, str]:
    """A fault's name, and the text of a file that has it."""
    return request.param, wrong(request.param)


@pytest.fixture(scope="session")
def wrong_text():
    """What gives the text of a file with a fault."""
    return wrong


@pytest.fixture(scope="session")
def checks():
    return TRIANGLE.cases()


@pytest.fixture
def written(tmp_path):
    """What writes a student's file."""

    def write(text: str, name: str = "student.py"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write
