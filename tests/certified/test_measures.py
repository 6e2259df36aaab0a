"""t and the barycentrics that are asked for later are those that are found at once, to the bit."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.certainty import Certainty
from reference_tracer.certified import arithmetic, plain, surfaces
from reference_tracer.certified.arithmetic import AssumptionError
from reference_tracer.certified.measures import Measured
from reference_tracer.files.images import save_png, to_display
from reference_tracer.methods import Method
from reference_tracer.rendering import render, trace
from reference_tracer.tracer.frame_measures import FrameMeasures
from reference_tracer.tracer.hits import NOTHING, Hits
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Precision, Settings

from ..sampled import sampled
from ..tracer.hostile_scenes import hostile_scene
from ..tracer.pictures import CERTIFIED, mess

pytestmark = pytest.mark.filterwarnings("error")


@pytest.fixture
def nothing_asked(monkeypatch):
    """Fail where t or the barycentrics of a certified ray are found."""

    def never(*given, **named):
        raise AssertionError("nobody asked")

    monkeypatch.setattr(Measured, "__call__", never)


@pytest.mark.slow
@sampled(3)
def test_what_is_asked_for_later_is_what_the_definition_finds_at_once(make, every):
    """In any order of rows and rays; of planes, and of what integers decided, too."""
    planes = exact = projections = 0
    for seed in range(60_000, 60_060, every):
        rng = np.random.default_rng(seed)
        scene = hostile_scene(make, rng)
        region, width = scene.camera.region, scene.camera.region.width
        once = result_of(plain.plain(scene, region, 1 << 30))
        frame, whole = render(scene, CERTIFIED), render(scene, CERTIFIED)
        assert whole.t.tobytes() == once.t.tobytes(), seed
        alike = (whole.certainty.ravel() == once.certainty) & (once.certainty == Certainty.BOUND)
        s = whole.barycentrics.reshape(-1, 3)
        assert s[alike].tobytes() == once.s.T[alike].tobytes(), seed
        some = rng.choice(len(s), min(len(s), 9))
        found = frame.hits().take(some).take(slice(1, None, 2))
        assert found.t.tobytes() == whole.t.ravel()[some[1::2]].tobytes(), seed
        frame = render(scene, CERTIFIED)
        for y in rng.permutation(region.height).tolist():
            hits = frame.hits(slice(y, y + 1))
            assert hits.t.tobytes() == whole.t[y].tobytes(), seed
            assert hits.s.T.tobytes() == s[y * width : (y + 1) * width].tobytes(), seed
        for name, values in whole.passes().items():
            assert getattr(frame, name).tobytes() == values.tobytes(), (seed, name)
        planes += (whole.instance_index >= len(scene.instances)).sum()
        exact += ((whole.certainty != Certainty.BOUND) & (whole.instance_index >= 0)).sum()
        projections |= 1 + scene.camera.projection.shares_direction
    assert planes > 100 / every and exact > 100 / every and projections == 3


@pytest.mark.parametrize("method", [m for m in Method if not m.is_proven])
@pytest.mark.parametrize("precision", Precision)
def test_a_plain_method_keeps_what_it_finds(make, rng, nothing_asked, method, precision):
    for orthographic in (False, True):
        scene = mess(make, rng, orthographic, False)
        settings = Settings(method, precision)
        frame, hits = render(scene, settings), trace(scene, settings)
        assert not callable(hits.measures)
        assert frame.t.tobytes() == hits.t.tobytes() and np.isfinite(frame.t).any()
        assert frame.barycentrics.reshape(-1, 3).tobytes() == hits.s.T.tobytes()


@pytest.mark.parametrize("color", ["object", "normal", "facing"])
@pytest.mark.parametrize("samples", [1, 2])
def test_a_picture_asks_for_no_t(make, rng, tmp_path, nothing_asked, color, samples):
    frame = render(mess(make, rng, False, False), Settings(color=color, samples=samples))
    save_png(tmp_path / "p.png", to_display(frame.color))
    assert (frame.normal != 0).any() and (frame.object_index != NOTHING).any()
    assert "_values" not in vars(frame.measures)  # nor was room made for it: at 8K that is a GiB
    with pytest.raises(AssertionError, match="nobody asked"):
        assert frame.depth is None


@pytest.mark.parametrize("samples", [1, 2])
def test_depths_are_found_once(make, rng, monkeypatch, samples):
    """For the colours of the whole picture; those of samples are asked for beside it."""
    found = []

    def counted(self, ray, *names, function=Measured.__call__):
        if self.scene.camera is scene.camera:
            found.append(len(ray))
        return function(self, ray, *names)

    scene = mess(make, rng, False, False)
    monkeypatch.setattr(Measured, "__call__", counted)
    frame = render(scene, Settings(color="depth", samples=samples))
    assert np.isfinite(frame.t).any() and frame.barycentrics.any()
    assert sum(found) == frame.t.size


def test_rows_that_are_known_are_not_found_again(make, rng):
    """Also between rows that are not: those of a band that was swept in halves come with theirs."""
    frame = render(mess(make, rng, False, False), CERTIFIED)
    found = FrameMeasures(frame.instance_index, frame.triangle_index)
    known = Hits.none(frame.shape[1])
    known.t[:] = 7
    for y in range(frame.shape[0]):
        rows = slice(y, y + 1)
        found.enter(rows, known if y == 3 else frame.hits(rows))
    t = found.of(slice(None))[0]
    assert (t[3] == 7).all() and (frame.t[3] != 7).all()
    for rows in (slice(0, 3), slice(4, None)):
        assert t[rows].tobytes() == frame.t[rows].tobytes()


def test_an_arithmetic_that_was_changed_meanwhile_is_found(make, rng, monkeypatch):
    frame = render(mess(make, rng, False, False), CERTIFIED)
    monkeypatch.setattr(arithmetic, "broken_assumptions", lambda: ["rounding to nearest"])
    with pytest.raises(AssumptionError):
        assert frame.t is None


def test_names_are_told_apart_whatever_place_they_share():
    """Also where a table has room for few: each ray has its own name."""
    for seed in range(50):
        rng = np.random.default_rng(seed)
        count = int(rng.integers(1, 200))
        high = rng.choice([2, 50, 2**31 - 1], 2)
        names = [rng.integers(-1, top, count).astype(np.int32) for top in high]
        which, row = surfaces._different(*names)
        for name in names:
            assert (name[which][row] == name).all()
        assert (np.diff(which) > 0).all()
        if high.max() == 2:
            assert len(which) == len(set(zip(*(n.tolist() for n in names), strict=True)))
