"""Faces cut into triangles: each covers its own shape once, and nothing else."""

from __future__ import annotations

from fractions import Fraction

import mapbox_earcut
import numpy as np
import pytest
from reference_tracer.mesh_files.ears import ears, of_convex
from reference_tracer.mesh_files.planar import Planar
from reference_tracer.mesh_files.polygons import cut

from . import shapes


def cut_one(points):
    """Cut one face of all corners, 2D or 3D."""
    points = np.pad(points, ((0, 0), (0, 3 - points.shape[1])))
    return cut(points, np.arange(len(points)), np.array([len(points)]))


def vector_areas(points, triangles):
    """Return twice the vector area of each triangle, in fractions."""
    exact = [[Fraction(x) for x in point] for point in points.tolist()]
    out = []
    for a, b, c in triangles:
        u, v = ([q - p for p, q in zip(exact[a], exact[k], strict=True)] for k in (b, c))
        out.append([u[k - 2] * v[k - 1] - u[k - 1] * v[k - 2] for k in range(3)])
    return out


def covers(points, triangles):
    """Return whether no triangle is turned over, and together they have the polygon's area.

    So they cover each point as often as the polygon winds round it. All of it is exact.
    """
    areas = vector_areas(points, triangles)
    fan = [(0, k, k + 1) for k in range(1, len(points) - 1)]
    normal = [sum(x) for x in zip(*vector_areas(points, fan), strict=True)]
    along = [sum(a * n for a, n in zip(area, normal, strict=True)) for area in areas]
    return min(along) >= 0 and sum(along) == sum(n * n for n in normal) > 0


SIMPLE = [shapes.star, shapes.spiral]


@pytest.mark.parametrize("shape", SIMPLE)
@pytest.mark.parametrize("scale", [1e-300, 1e-30, 1.0, 1e30, 1e150])
@pytest.mark.parametrize("offset", [0.0, 1e8])
def test_a_simple_polygon_is_covered_once(shape, scale, offset, rng):
    for count in (4, 5, 7, 12, 40):
        flat = shape(rng, count)
        points = shapes.in_space(rng, flat, scale, offset)
        found = cut_one(points)
        assert found.missing == () and covers(points, found.triangles)
        assert len(found.triangles) == len(flat) - 2


@pytest.mark.parametrize("shape", SIMPLE)
def test_the_area_is_that_of_earcut(shape, rng):
    for count in (4, 5, 9, 30, 100):
        flat = shape(rng, count)
        rings = np.array([len(flat)], np.uint32)
        other = mapbox_earcut.triangulate_float64(flat, rings).reshape(-1, 3)
        areas = [
            np.abs([shapes.area(flat[t]) for t in ts]).sum()
            for ts in (other, cut_one(flat).triangles)
        ]
        assert areas[1] == pytest.approx(shapes.area(flat), rel=1e-12)
        assert areas[0] == pytest.approx(areas[1], rel=1e-9)


def test_a_polygon_that_touches_itself_everywhere_is_covered_once(rng):
    """The boundary of a maze passes its walls twice, and its corners up to four times."""
    for k in range(60):
        wide, high = rng.integers(1, 6, 2)
        flat = shapes.maze(rng, wide, high)
        assert shapes.area(flat) == wide * high
        flat = shapes.without_straight_corners(rng, flat) if k % 2 else flat
        points = np.pad(np.roll(flat, rng.integers(len(flat)), axis=0), ((0, 0), (0, 1)))
        found = cut_one(points)
        assert found.missing == () and covers(points, found.triangles)


def test_where_blenders_way_turns_a_triangle_over_another_is_found():
    """A room of the maze is entered by a corridor whose walls touch at a corner."""
    rng = np.random.default_rng(0)
    flats = [shapes.maze(rng, 5, 5) for _ in range(60)]
    several = [np.pad(flat, ((0, 0), (0, 1))) for flat in flats]
    assert all(covers(points, ears(Planar(points), 0.0)[0]) for points in several)
    assert not all(covers(points, in_blenders_way(points)) for points in several)


def in_blenders_way(points):
    """Return the triangles of a polygon as if each of them were right."""
    shape = Planar(points)
    shape.is_turned_over = lambda *three: False
    return ears(shape, 0.0)[0]


def test_a_wall_that_rounding_moves_across_another_is_no_crossing(rng):
    for _ in range(20):
        flat = shapes.without_straight_corners(rng, shapes.maze(rng, 4, 4))
        points = shapes.in_space(rng, flat)
        found = cut_one(points)
        triangles = points[found.triangles]
        sides = triangles[:, 1:] - triangles[:, :1]
        area = 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum()
        assert found.missing == () and area == pytest.approx(16, rel=1e-9)


@pytest.mark.parametrize("holes", [1, 2, 3])
def test_holes_that_bridges_lead_to_stay_open(holes, rng):
    """As a face with holes is written where each face has one boundary."""
    for _ in range(5):
        room = np.array([(0, 0), (4 * holes, 0), (4 * holes, 4), (0, 4)], float)
        inner = [0.9 * shapes.star(rng, 6)[::-1] + (4 * k + 2, 2) for k in range(holes)]
        rings = np.cumsum([4, *map(len, inner)]).astype(np.uint32)
        other = mapbox_earcut.triangulate_float64(np.concatenate((room, *inner)), rings)
        flat = room
        for hole in inner:  # from the lower side, below the hole's lowest corner
            lowest = np.argmin(hole[:, 1])
            ring = np.roll(hole, -lowest, axis=0)
            foot = np.array([(ring[0, 0], 0.0)])
            place = 1 + np.flatnonzero((flat[:, 1] == 0) & (flat[:, 0] < foot[0, 0]))[-1]
            flat = np.concatenate((flat[:place], foot, ring, ring[:1], foot, flat[place:]))
        found = cut_one(flat)
        area = 16 * holes + sum(map(shapes.area, inner))
        assert covers(np.pad(flat, ((0, 0), (0, 1))), found.triangles) and found.missing == ()
        assert shapes.area(flat) == pytest.approx(area)
        corners = np.concatenate((room, *inner))[other.reshape(-1, 3)]
        assert sum(abs(shapes.area(t)) for t in corners) == pytest.approx(area)


L = [(2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (0, 0)]
ARROW = [(0, 0), (2, 1), (0, 2), (1, 1)]


@pytest.mark.parametrize("first", range(6))
def test_a_concave_face_keeps_its_shape_wherever_it_begins(first):
    for corners, area in ((L, 3), (ARROW, 1)):
        flat = np.roll(np.array(corners, float), first, axis=0)
        triangles = cut_one(flat).triangles
        assert all(shapes.area(flat[t]) >= 0 for t in triangles)
        assert sum(shapes.area(flat[t]) for t in triangles) == area


@pytest.mark.parametrize(
    "corners",
    [
        [(0, 0), (0, 0), (2, 0), (2, 2), (0, 2)],  # a corner twice
        [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (0, 2)],  # corners on a side
        [(0, 0), (2, 0), (3, 0), (2, 0), (2, 2), (0, 2)],  # a spike
        [(0, 0), (2, 0), (2, 2), (0, 2), (0, 0), (2, 0), (2, 0)],  # a side twice
        [(0, 0), (2, 0), (2, 0), (2, 2)],  # a triangle
        [(0, 0), (1, 0), (2, 0), (2, 2)],
    ],
)
def test_what_adds_no_area_changes_nothing(corners):
    flat = np.array(corners, float)
    found = cut_one(flat)
    assert found.missing == () and all(shapes.area(flat[t]) >= 0 for t in found.triangles)
    assert sum(shapes.area(flat[t]) for t in found.triangles) == shapes.area(flat)


@pytest.mark.parametrize("count", [4, 5, 9])
def test_faces_of_no_area_are_no_trouble(count, rng):
    for points in (np.zeros((count, 3)), np.outer(rng.integers(-3, 4, count), (1.0, 2.0, 3.0))):
        assert cut_one(points)[2:] == ((), ())


BOW, PENTAGRAM = [(0, 0), (1, 1), (1, 0), (0, 1)], [(0, 3), (2, -3), (-3, 1), (3, 1), (-2, -3)]
EIGHT = [(0, 0), (2, 0), (2, 2), (-1, -1), (-1, 0.5)]


def test_faces_that_cross_themselves_are_named_with_the_first():
    points = np.pad(
        np.concatenate([L, BOW, ARROW, PENTAGRAM, EIGHT]).astype(float), ((0, 0), (0, 1))
    )
    sizes = np.array([6, 4, 4, 5, 5])
    found = cut(points, np.arange(len(points)), sizes)
    assert len(found.missing) == 1 and found.notes == ()
    assert found.missing[0].startswith("3 faces whose edges cross, the first is face 2:")
    assert np.array_equal(np.bincount(found.faces), sizes - 2)


def test_faces_of_all_kinds_keep_their_order_and_lose_what_cannot_be_drawn():
    points = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, np.nan)])
    sizes = np.array([4, 2, 3, 4, 0, 3])
    corners = np.array([0, 1, 2, 3, 0, 1, 0, 1, 2, 0, 1, 2, 4, 1, 2, 3])
    found = cut(points, corners, sizes)
    assert found.faces.tolist() == [0, 0, 2, 5]
    assert found.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [0, 1, 2], [1, 2, 3]]
    assert found.notes[0].startswith("2 faces with fewer than three corners, the first is face 2")
    assert found.missing[0].startswith(
        "1 face with a corner that is no finite number, the first is face 4"
    )


def test_a_convex_face_is_cut_the_same_in_numbers_and_one_by_one(rng):
    for count in (5, 6, 11):
        angles = 2 * np.pi * np.arange(count) / count
        points = shapes.in_space(rng, np.column_stack((np.cos(angles), np.sin(angles))))
        assert cut_one(points).triangles.tolist() == [list(t) for t in of_convex(count)]
        assert ears(Planar(points), 0.0) == (of_convex(count), True)


class TestFlatness:
    """A face is named as bent if its corners are off by more than their rounding, and only then."""

    def of(self, points):
        return cut_one(points).notes

    @pytest.mark.parametrize("stored", ["float32", "six decimals", "six digits", "float64"])
    @pytest.mark.parametrize("count", [4, 5, 8])
    def test_rounding_is_no_bend(self, stored, count, rng):
        for offset in (0, 5) if "six" in stored else (0, 5, 300):
            several = [
                shapes.in_space(rng, shapes.star(rng, count), rng.uniform(0.5, 20))
                + offset * rng.normal(size=3)
                for _ in range(60)
            ]
            together = np.concatenate(several)
            if stored == "float32":
                together = together.astype(np.float32)
            elif stored == "six decimals":
                together = np.round(together, 6)
            elif stored == "six digits":
                together = np.array([[float(f"{x:.6g}") for x in row] for row in together])
            found = cut(together, np.arange(len(together)), np.full(60, count))
            assert not [note for note in found.notes if "not flat" in note]

    @pytest.mark.parametrize("bend", [1e-3, 0.2])
    @pytest.mark.parametrize("scale", [1e-30, 1.0, 1e30])
    def test_a_bend_is_measured(self, bend, scale):
        square = np.array([(0, 0, bend), (1, 0, -bend), (1, 1, bend), (0, 1, -bend)])
        (note,) = self.of(square * scale)
        assert note.startswith(
            f"1 face of more than three corners is not flat, by {bend * scale:.2g} m"
        )
        share = 100 * bend / np.sqrt(2 + 4 * bend**2)
        assert f"{share:.2g} %" in note

    def test_a_wave_far_out_on_a_grid_is_no_rounding(self):
        """Its places are integers, which are as exact as the six decimals of its heights."""
        x, y = np.meshgrid(np.arange(600.0, 620), np.arange(600.0, 620))
        z = np.round(0.1 * np.sin(x / 3) * np.cos(y / 4), 6)
        at = (np.arange(19) + 20 * np.arange(19)[:, None]).reshape(-1, 1)
        points = np.stack((x, y, z), axis=2).reshape(-1, 3)
        found = cut(points, (at + np.array((0, 1, 21, 20))).ravel(), np.full(361, 4))
        assert int(found.notes[0].split()[0]) > 320

    def test_a_bend_beside_flat_faces_is_counted(self):
        squares = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)] * 3, float)
        squares[-1, 2] = 0.01
        found = cut(squares, np.arange(12), np.full(3, 4))
        assert found.notes[0].startswith("1 face ") and found.missing == ()


def test_the_work_grows_no_faster_than_the_corners():
    """Of 5,000 corners it takes seconds: what hindered an ear is looked at again first."""
    asked = 0

    class Counting(Planar):
        def turn(self, a, b, c):
            nonlocal asked
            asked += 1
            return super().turn(a, b, c)

    angles = np.linspace(0, 40 * np.pi, 500)
    band = [r * np.stack((np.cos(angles), np.sin(angles))) for r in (1 + angles, 2.5 + angles)]
    flat = np.concatenate((band[0].T, band[1].T[::-1]))
    planar = Counting(np.pad(flat, ((0, 0), (0, 1))))
    triangles, right = ears(planar, 0.0)
    assert right and len(triangles) == 998
    assert asked < 50 * len(flat)
