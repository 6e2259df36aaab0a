"""A ray and a triangle: the textbook's formulas, and Möller and Trumbore's."""

from __future__ import annotations

from collections.abc import Iterator

from reference_tracer.arrays import Floats
from reference_tracer.derivation.formulas import TRIANGLE as LISTED

from ..form import Field, Form
from ..programs import Letters, Part, Program, Slip
from .subject import Subject
from .triangle_cases import groups
from .triangle_faults import TESTS

CORNERS = "p₁", "p₂", "p₃"
WEIGHTS = "s₁", "s₂", "s₃"
PARTS = Part("t", ("t",), 1), Part("barycentrics", WEIGHTS, 3, 1.0)
FORMULAS = {
    f.label: f.right for f in (LISTED[k] for k in "n t x ns1 ns2 ns3 area s1 s2 s3".split())
}
RAYS = Field("origins", "ox,oy,oz", (3,)), Field("directions", "dx,dy,dz", (3,))


def _one_side(towards: str) -> Iterator[Slip]:
    """Yield that triangles are seen from one side only, by the sign of a formula."""
    for name, winding, sign in (
        ("back_faces_culled", "clockwise", ">"),
        ("front_faces_culled", "counter-clockwise", "<"),
    ):
        text = (
            f"triangles whose corners the ray sees {winding} are missed: {towards} may have "
            "either sign, a triangle has two sides"
        )
        yield Slip(name, text, conditions={"t > 0": ("t > 0", f"{towards} {sign} 0")})


CONDITIONS = "s₁ ≥ 0", "s₂ ≥ 0", "s₃ ≥ 0", "t > 0"
TEXTBOOK = Program.of(
    FORMULAS,
    CONDITIONS,
    ("p₁ p₂ p₃ x o", "n nₛ₁ nₛ₂ nₛ₃ d"),
    PARTS,
    (
        *_one_side("d · n"),
        Slip(
            "s2_s3_swapped",
            "s₂ and s₃ are exchanged: the textbook's erratum. nₛ₂ is 0 on the edge p₁p₂, so what "
            "it gives weighs p₃, and what nₛ₃ gives weighs p₂",
            {"s₂": "(n · nₛ₂) / ‖n‖²", "s₃": "(n · nₛ₃) / ‖n‖²"},
        ),
        Slip(
            "inside_not_tested",
            "the whole plane of the triangle is hit: the barycentrics are not tested",
            conditions={"s₁ ≥ 0": (), "s₂ ≥ 0": (), "s₃ ≥ 0": ()},
        ),
        Slip(
            "only_upper_bounds",
            "sᵢ ≤ 1 is tested, where sᵢ ≥ 0 says what is inside",
            conditions={f"{w} ≥ 0": (f"{w} ≤ 1",) for w in WEIGHTS},
        ),
        Slip(
            "barycentrics_scale",
            "n · nₛᵢ is not divided by ‖n‖²: the barycentrics do not sum to 1",
            {"‖n‖²": "1"},
        ),
        Slip("area_doubled", "‖n‖² is taken twice as large as n · n", {"‖n‖²": "2 (n · n)"}),
        Slip("area_halved", "‖n‖² is taken half as large as n · n", {"‖n‖²": "½ (n · n)"}),
    ),
)

MOLLER_TRUMBORE = Program.of(
    {
        "e₁": "p₂ − p₁",
        "e₂": "p₃ − p₁",
        "h": "d × e₂",
        "a": "e₁ · h",
        "q": "o − p₁",
        "u": "(q · h) / a",
        "r": "q × e₁",
        "v": "(d · r) / a",
        "t": "(e₂ · r) / a",
        "s₁": "1 − u − v",
        "s₂": "u",
        "s₃": "v",
    },
    ("u ≥ 0", "v ≥ 0", "u + v ≤ 1", "t > 0"),
    ("p₁ p₂ p₃ o", "e₁ e₂ h q r d", "u v"),
    PARTS,
    (
        *_one_side("a"),
        Slip(
            "parallelogram",
            "u ≤ 1 and v ≤ 1 are tested, where u + v ≤ 1 says what is before the edge p₂p₃: a "
            "parallelogram is hit",
            conditions={"u + v ≤ 1": ("u ≤ 1", "v ≤ 1")},
        ),
        Slip(
            "barycentrics_order",
            "the barycentrics are given as u, v, 1 − u − v: u weighs p₂, v weighs p₃, the rest p₁",
            {"s₁": "u", "s₂": "v", "s₃": "1 − u − v"},
        ),
        Slip(
            "inside_not_tested",
            "the whole plane of the triangle is hit: u and v are not tested",
            conditions={"u ≥ 0": (), "v ≥ 0": (), "u + v ≤ 1": ()},
        ),
    ),
)

# A third way, whose rounding is the largest far from the origin: see `known.py`.
SIGNED_VOLUMES = Program.of(
    {
        "a": "p₁ − o",
        "b": "p₂ − o",
        "c": "p₃ − o",
        "v₁": "d · (c × b)",
        "v₂": "d · (a × c)",
        "v₃": "d · (b × a)",
        "v": "v₁ + v₂ + v₃",
        "s₁": "v₁ / v",
        "s₂": "v₂ / v",
        "s₃": "v₃ / v",
        # As the weights' sum is 1, their errors move the point by edges, not by arms.
        "t": "(d · (a + s₂ (p₂ − p₁) + s₃ (p₃ − p₁))) / (d · d)",
    },
    CONDITIONS,
    (),
    PARTS,
)


FORM = Form(
    "intersect",
    (*RAYS, Field("triangles", "p1x,p1y,p1z,p2x,p2y,p2z,p3x,p3y,p3z", (3, 3))),
    (Field("t", "t"), Field("barycentrics", "s1,s2,s3", (3,))),
)


def letters(origins: Floats, directions: Floats, triangles: Floats) -> Letters:
    """Return the letters of n pairs: (n, 3), (n, 3), (n, 3, 3) float64."""
    corners = zip(CORNERS, triangles.transpose(1, 2, 0), strict=True)
    return Letters({"o": origins.T, "d": directions.T, **dict(corners)}, (len(origins),))


TRIANGLE = Subject(
    name="triangle",
    title="ray/triangle tests",
    form=FORM,
    programs=(TEXTBOOK, MOLLER_TRUMBORE),
    # What a right surface, t and barycentrics count for in the score of a scene.
    weights={"surface": 0.6, "t": 0.2, "barycentrics": 0.2},
    groups={
        "front": "ordinary hits, the corners counter-clockwise as the ray sees them",
        "back": "the same from the other side",
        "whole": "hits in integers: nothing is rounded",
        "scaled": "the first ones, 2^-30, 2^-20 and 2^20 times as large",
        "outside": "rays that clearly pass beyond an edge",
        "beside": "rays that pass 1e-9 to 1e-4 of the triangle's height inside or outside an edge",
        "behind": "triangles behind the ray's origin",
        "parallel": "rays parallel to the triangle's plane",
        "empty": "triangles without an area: what is said of them does not count",
        "elsewhere": "rays all around a triangle: they do not count, but tell mistakes apart",
    },
    letters=letters,
    asked=groups,
    tests=TESTS,
    # d . n is exactly 0 of rays parallel to their plane: there is nothing to round.
    whole=("whole", "parallel"),
    aside=("elsewhere",),
    silent=("parallel",),
    close=("beside",),
)
