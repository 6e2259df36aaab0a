"""Sixty wrong submissions in six languages: the examples of `docs/students`, each with one fault.

A fault is what is written instead of what, in a file of a subject and a language.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

LANGUAGES = Path(__file__).parents[2] / "docs" / "students" / "languages"

PLANE = """
import numpy as np

def intersect_plane(o, d, p, n):
    dot = lambda a, b: (a * b).sum(axis=1)
    t = -dot(o - p, n) / dot(d, n)
    return np.where(t > 0, t, np.inf), o + t[:, None] * d
"""
PICTURE = """
import numpy as np

def one(size, orthographic, lens, sensor, scale, shift, matrix, triangles):
    right, up, back, position = matrix.T
    columns, rows = size
    pixel = (scale if orthographic else sensor / lens) / max(size)
    row, column = np.divmod(np.arange(384), columns)
    x = (column + 0.5 - columns / 2 + shift[0] * max(size)) * pixel
    y = (row + 0.5 - rows / 2 + shift[1] * max(size)) * pixel
    across = x[:, None] * right + y[:, None] * up
    o = position + across * orthographic
    d = across * (1 - orthographic) - back
    best, shown = np.full(384, np.inf), np.full(384, -1)
    for k, (a, b, c) in enumerate(triangles):
        n = np.cross(b - a, c - a)
        t = (a - o) @ n / (d @ n)
        p = o + t[:, None] * d
        sides = [np.cross(w - v, p - v) @ n for v, w in ((a, b), (b, c), (c, a))]
        hit = (np.min(sides, axis=0) >= 0) & (t > 0) & (t < best)
        best[hit], shown[hit] = t[hit], k
    return shown

def picture(*given):
    return np.array([one(*each) for each in zip(*given)])
"""


class Wrong(NamedTuple):
    """A submission: its subject, its file, the name of its fault, and what makes it wrong."""

    subject: str
    file: str  # of LANGUAGES; "plane" or "picture": of the texts above
    fault: str
    changes: tuple[tuple[str, str], ...]

    @property
    def text(self) -> str:
        """The submission."""
        own = {"plane": PLANE, "picture": PICTURE}.get(self.file)
        text = own or (LANGUAGES / self.file).read_text(encoding="utf-8")
        for old, new in self.changes:
            assert old in text, (self.file, self.fault, old)
            text = text.replace(old, new)
        return text


_INSIDE = "s1 >= 0 && s2 >= 0 && s3 >= 0"
_BOUNDS = _INSIDE.replace(">= 0", "<= 1")
_AREA = (" / dot(n, n)", "")
_ORDER = "(p2, p3), (p3, p1), (p1, p2)", "(p2, p3), (p1, p2), (p3, p1)"
_OF_FILE: dict[tuple[str, str], dict[str, tuple[tuple[str, str], ...]]] = {
    ("triangle", "textbook.c"): {
        "hits_behind": (("(t > 0 && ", "("),),
        "edge_not_tested": (("s1 >= 0 && ", ""),),
        "back_faces_culled": (("(t > 0", "(dot(d, n) > 0 && t > 0"),),
        "s2_s3_swapped": (("t, s1, s2, s3)", "t, s1, s3, s2)"),),
    },
    ("triangle", "textbook.cpp"): {
        "hits_behind": (("!(t > 0 && ", "!("),),
        "inside_not_tested": ((f" && {_INSIDE}", ""),),
        "barycentrics_scale": (_AREA,),
        "front_faces_culled": (("!(t > 0", "!(dot(r.d, n) < 0 && t > 0"),),
    },
    ("triangle", "Textbook.java"): {
        "hits_behind": (("(t > 0 && ", "("),),
        "edge_not_tested": ((" && s3 >= 0", ""),),
        "only_upper_bounds": ((_INSIDE, _BOUNDS),),
        "s2_s3_swapped": (('s2 + "," + s3', 's3 + "," + s2'),),
    },
    ("triangle", "textbook.js"): {
        "inside_not_tested": ((" && s.every((v) => v >= 0)", ""),),
        "back_faces_culled": (("return t > 0", "return dot(d, n) > 0 && t > 0"),),
        "barycentrics_scale": (_AREA,),
        "s2_s3_swapped": (("weight(p3, p1), weight(p1, p2)", "weight(p1, p2), weight(p3, p1)"),),
    },
    ("triangle", "textbook.rs"): {
        "hits_behind": (("if t > 0.0 && ", "if "),),
        "only_upper_bounds": ((">= 0.0", "<= 1.0"),),
        "front_faces_culled": (("if t > 0.0", "if dot(d, n) < 0.0 && t > 0.0"),),
        "area_doubled": ((" / dot(n, n)", " / (2.0 * dot(n, n))"),),
    },
    ("triangle", "textbook.py"): {
        "hits_behind": (("if t > 0 and ", "if "),),
        "edge_not_tested": (("min(s)", "min(s[1:])"),),
        "t_is_distance": (("return [t, *s]", "return [t * dot(d, d) ** 0.5, *s]"),),
        "s2_s3_swapped": (_ORDER,),
    },
    ("camera", "camera.py"): {
        "half_pixel_missing": (("column + 0.5", "column"), ("row + 0.5", "row")),
        "mirrored": (("x = column + 0.5 - columns / 2", "x = columns / 2 - column - 0.5"),),
        "shift_reversed": (("+ shift_x", "- shift_x"), ("+ shift_y", "- shift_y")),
        "fit_height": ((") / longer", ") / rows"),),
        "matrix_transposed": (
            (
                "right, up, back, position = (matrix[k::4] for k in range(4))",
                "right, up, back = (matrix[k : k + 3] for k in (0, 4, 8))\n"
                "    position = matrix[3::4]",
            ),
        ),
        "scale_is_half": (("(scale if", "(2 * scale if"),),
        "degrees": (
            ("import sys", "import math\nimport sys"),
            ("sensor / lens", "2 * math.tan(math.degrees(math.atan(sensor / lens / 2)))"),
        ),
        "position_ignored": (
            ("[e + a for e, a in zip(position, across, strict=True)]", "across"),
            ("strict=True)], position", "strict=True)], [0, 0, 0]"),
        ),
        "always_orthographic": (
            ("if orthographic:", "if True:"),
            ("(scale if orthographic else sensor / lens)", "scale"),
        ),
    },
    ("camera", "camera.c"): {
        "rows_from_the_top": (("(row + 0.5 - rows / 2", "(rows / 2 - row - 0.5"),),
        "columns_and_rows_exchanged": (("column = v[0], row = v[1]", "row = v[0], column = v[1]"),),
        "looks_backward": (("- m[2]", "+ m[2]"),),
        "position_added_to_direction": (("- m[2]", "- m[2] + m[3]"),),
        "shift_ignored": ((" + v[8] * longer", ""), (" + v[9] * longer", "")),
        "fit_width": ((") / longer;", ") / columns;"),),
        "half_width": (("sensor / lens)", "sensor / 2 / lens)"),),
        "always_perspective": (("= v[4] != 0", "= 0"),),
        "fan_of_an_orthographic_camera": (("(is_orthographic ? 0 : across)", "across"),),
    },
    ("nearest", "nearest.py"): {
        "farthest_hit": (
            ("if t < best:", 'if t < float("inf") and (best == float("inf") or t > best):'),
        ),
        "first_hit": (("if t < best:", 'if t < best and best == float("inf"):'),),
        "scale_ignored": (("v / scales[k]", "v"),),
        "back_faces_culled": (("if t > 0", "if dot(d, n) > 0 and t > 0"),),
    },
    ("nearest", "nearest.c"): {
        "last_hit": (("(t < best)", "(t < INFINITY)"),),
        "t_of_the_objects_scale": (("d[j] = v[3 + j] / scales[k]", "d[j] = v[3 + j]"),),
        "hits_behind": (("return t > 0 && inside", "return inside"),),
        "inside_not_tested": (("t > 0 && inside", "t > 0 && (inside || 1)"),),
    },
    ("plane", "plane"): {
        "t_sign": (("t = -dot", "t = dot"),),
        "hits_behind": (("np.where(t > 0, t, np.inf)", "t"),),
        "back_missed": (("t > 0,", "(t > 0) & (dot(d, n) < 0),"),),
        "t_is_distance": (("t = -", "d = d / dot(d, d)[:, None] ** 0.5\n    t = -"),),
        "point_not_moved": (("o + t[:, None] * d", "o + d"),),
        "x_sign": (("o + t[:", "o - t[:"),),
    },
    ("picture", "picture"): {
        "rows_from_the_top": (("y = (row + 0.5 - rows / 2", "y = (rows / 2 - row - 0.5"),),
        "half_pixel_missing": (("column + 0.5", "column"), ("row + 0.5", "row")),
        "farthest_hit": ((" & (t < best)", " & ((t > best) | (best == np.inf))"),),
        "upside_down_and_mirrored": (
            ("x = (column + 0.5 - columns / 2", "x = (columns / 2 - column - 0.5"),
            ("y = (row + 0.5 - rows / 2", "y = (rows / 2 - row - 0.5"),
        ),
    },
}
SUBMISSIONS = [
    Wrong(subject, file, fault, changes)
    for (subject, file), faults in _OF_FILE.items()
    for fault, changes in faults.items()
]
