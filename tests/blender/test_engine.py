"""F12 with the engine: what Blender writes is what the tracer gave, bit for bit."""

from __future__ import annotations

from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from reference_tracer import rendering
from reference_tracer.blender import engine as engine_module
from reference_tracer.blender.engine import ENGINE, ReferenceTracerEngine
from reference_tracer.certified.arithmetic import AssumptionError
from reference_tracer.rendering import render
from reference_tracer.tracer import render as loop
from reference_tracer.tracer.frame import NO_HIT_DEPTH, PASSES, Frame
from reference_tracer.tracer.settings import Settings

from ..certified.modes import MODES, ON_X86, switch, switched_back

LABELS = {p.label for p in PASSES if p.label}

SHARE_ROUNDING = 1e-12  # of the progress, put together from shares of shares
AFTER_5 = bpy.app.version >= (5, 0, 0)


@pytest.fixture
def solids(build):
    scene = build.scene()
    scene.render.engine, scene.render.film_transparent = ENGINE, True
    scene.view_layers[0].reference_tracer.passes = LABELS - {"Combined"}
    build.solids()
    build.corner_camera()
    return scene


def expected(frame) -> dict[str, np.ndarray]:
    """Return what each pass is to hold, from the frame, in words of this test."""
    return {
        "Combined": frame.color,
        "Depth": np.where(np.isinf(frame.t), 1e10, frame.t),
        "T": np.where(np.isinf(frame.t), 1e10, frame.t),
        "Position": frame.position,
        "Normal": frame.normal,
        "Barycentrics": frame.barycentrics,
        "Object Index": frame.object_index + 1,
        "Triangle Index": frame.triangle_index + 1,
        "Certainty": frame.certainty,
    }


def assert_same(passes, frame) -> None:
    assert set(passes) == set(expected(frame)) == LABELS
    for name, values in expected(frame).items():
        values = values.astype(np.float32)
        np.testing.assert_array_equal(
            passes[name].squeeze(-1) if values.ndim == 2 else passes[name], values, err_msg=name
        )


def test_every_pass_is_the_frames(solids, rendered, export):
    frame = render(export.render()[0])
    assert {*np.unique(frame.object_index)} == {-1, 0, 1, 2, 3}
    layers = rendered()
    assert set(layers) == {"ViewLayer"}
    assert_same(layers["ViewLayer"], frame)
    assert NO_HIT_DEPTH == 1e10


@pytest.mark.parametrize(
    "settings",
    [
        {"method": "moller_trumbore"},
        {"method": "textbook_literal"},
        {"method": "textbook", "precision": "float32"},
        {"samples": 3},
        {"color": "normal"},
        {"color": "facing", "samples": 2},
        {"color": "depth", "method": "watertight"},
    ],
    ids=str,
)
def test_the_scenes_settings_are_used(settings, solids, rendered, export):
    for name, value in settings.items():
        setattr(solids.reference_tracer, name, value)
    scene = export.render()[0]
    frame = render(scene, Settings(**settings))
    assert_same(rendered()["ViewLayer"], frame)
    plain = render(scene)
    assert any(
        (getattr(plain, n) != getattr(frame, n)).any() for n in ("color", "t", "barycentrics")
    )


def test_border_without_crop(solids, rendered, export):
    whole = render(export.render()[0])
    solids.render.use_border = True
    solids.render.border_min_x, solids.render.border_max_x = 0.21, 0.83
    solids.render.border_min_y, solids.render.border_max_y = 0.13, 0.67
    scene = export.render()[0]
    r = scene.camera.region
    passes = rendered()["ViewLayer"]
    assert passes["Combined"].shape == (54, 96, 4)
    inside = {name: values[r.y0 : r.y1, r.x0 : r.x1] for name, values in passes.items()}
    assert_same(inside, render(scene))
    np.testing.assert_array_equal(inside["Combined"], whole.color[r.y0 : r.y1, r.x0 : r.x1])
    passes["Combined"][r.y0 : r.y1, r.x0 : r.x1] = 0
    assert not passes["Combined"].any()


def test_what_a_layer_has_not_chosen_is_neither_computed_nor_declared(
    solids, build, rendered, export, monkeypatch, capfd
):
    """Each layer chooses for itself, and shows its own; by default it has the picture alone."""
    build.collection("Extra", build.cube("Extra", 1, link=False, location=(0, 0, 1.5)), link=True)
    frame = rendered()["ViewLayer"]
    chosen, other = solids.view_layers[0], solids.view_layers.new("Other")
    other.layer_collection.children["Extra"].exclude = True
    _, node = build.compositor()
    chosen.reference_tracer.passes = {"Depth", "Certainty"}
    shown = {output.name for output in node.outputs if output.enabled}
    assert shown - {"Image", "Alpha"} == {"Depth", "Certainty"}
    assert "Error" not in capfd.readouterr().err  # Blender prints what an update raises
    layers = rendered()
    assert set(layers["Other"]) == {"Combined"} and set(layers) == {"ViewLayer", "Other"}
    assert set(layers["ViewLayer"]) == {"Combined", "Depth", "Certainty"}
    for name, values in layers["ViewLayer"].items():
        np.testing.assert_array_equal(values, frame[name])
    bpy.context.window.view_layer = other
    np.testing.assert_array_equal(layers["Other"]["Combined"], render(export.viewport()[0]).color)
    bpy.context.window.view_layer = chosen
    assert (layers["Other"]["Combined"] != frame["Combined"]).any()
    solids.view_layers.remove(other)
    chosen.reference_tracer.passes = set()
    for name in ("position", "normal", "object_index"):
        monkeypatch.setattr(Frame, name, property(lambda _: pytest.fail("nobody asks for it")))
    (combined,) = (alone := rendered()["ViewLayer"]).values()
    assert set(alone) == {"Combined"}
    np.testing.assert_array_equal(combined, frame["Combined"])


@pytest.mark.parametrize("name", ["Triangle Index", "Object Index", "Depth", "Normal"])
def test_a_pass_goes_through_the_compositor(name, solids, build, export, tmp_path):
    solids.view_layers[0].update_render_passes()
    tree, node = build.compositor()
    if AFTER_5:
        tree.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
        output = tree.nodes.new("NodeGroupOutput")
    else:
        output = tree.nodes.new("CompositorNodeComposite")
    tree.links.new(node.outputs[name], output.inputs[0])
    image = solids.render.image_settings
    image.file_format, image.color_mode, image.color_depth = "OPEN_EXR", "RGB", "32"
    solids.render.filepath = str(tmp_path / "composed.exr")
    values = expected(render(export.viewport()[0]))[name].astype(np.float32)
    bpy.ops.render.render(write_still=True)
    loaded = bpy.data.images.load(solids.render.filepath)
    pixels = np.array(loaded.pixels[:], np.float32).reshape(54, 96, 4)
    if values.ndim == 2:
        np.testing.assert_array_equal(pixels[..., 0], values)
    else:
        np.testing.assert_array_equal(pixels[..., :3], values)


@pytest.fixture
def handed_over(monkeypatch):
    """Render in many bands, by a clock of which a step takes a second and a picture thirty.

    Gives the first row and the number of rows of each tile, and when it was handed over.
    """
    clock, tiles, module = SimpleNamespace(now=0.0), [], "reference_tracer.blender.engine"
    show, steps = ReferenceTracerEngine._show, rendering.steps

    class Recorder:
        def __init__(self, engine):
            self._engine = engine

        def __getattr__(self, name):
            return getattr(self._engine, name)

        def begin_result(self, x, y, width, height, layer):
            tiles.append((y, height, clock.now))
            clock.now += 30 * height / 54
            return self._engine.begin_result(x, y, width, height, layer=layer)

    def a_second_later(*args):
        for share in steps(*args):
            clock.now += 1
            yield share

    monkeypatch.setattr(loop, "BYTES_PER_PIXEL", Settings().memory // (96 * 2))
    monkeypatch.setattr(ReferenceTracerEngine, "_show", lambda self, *a: show(Recorder(self), *a))
    monkeypatch.setattr(rendering, "steps", a_second_later)
    monkeypatch.setattr(f"{module}.time", SimpleNamespace(monotonic=lambda: clock.now))
    return tiles


@pytest.mark.parametrize("chosen", [LABELS - {"Combined"}, set()], ids=["all", "none"])
def test_no_row_is_shown_twice_before_the_end(chosen, solids, rendered, export, handed_over):
    """However long Blender takes to show them, it is a tenth of the time; and all comes through."""
    solids.view_layers[0].reference_tracer.passes = chosen
    passes = rendered()["ViewLayer"]
    *partial, (first, rows, ended) = handed_over
    assert len(partial) > 3
    known = 0
    for start, count, _ in partial:
        assert start == known and count > 0
        known = start + count
    # With other passes the picture comes once more, as Blender takes all of a row at once.
    assert (first, rows) == ((0, 54) if chosen else (known, 54 - known))
    assert known < 54
    assert 30 * known / 54 <= ended / 10
    frame = render(export.render()[0])
    if chosen:
        assert_same(passes, frame)
    np.testing.assert_array_equal(passes["Combined"], frame.color)


class CancelledEngine:
    """What Blender gives an engine, with Esc pressed once so many questions were asked."""

    def __init__(self, stop_at: float) -> None:
        self.asked, self.stop_at, self.shown, self.shares = 0, stop_at, {}, []

    def test_break(self) -> bool:
        self.asked += 1
        return self.asked > self.stop_at

    def begin_result(self, x, y, width, height, layer):
        self.size = width, height
        passes = {name: SimpleNamespace(rect=self._rect(name)) for name in LABELS}
        return SimpleNamespace(layers=[SimpleNamespace(passes=passes)])

    def _rect(self, name):
        return SimpleNamespace(foreach_set=lambda values: self.shown.update({name: values.copy()}))

    def update_progress(self, share: float) -> None:
        self.shares.append(share)

    def update_stats(self, *texts: str) -> None:
        pass

    end_result = report = update_stats
    _fill = ReferenceTracerEngine._fill
    _show = ReferenceTracerEngine._show
    _tell = ReferenceTracerEngine._tell


def test_a_cancelled_render_keeps_the_rows_that_are_done(solids, capsys, monkeypatch):
    """Blender has no key to press in background: the engine is run as if one was."""
    monkeypatch.setattr(loop, "BYTES_PER_PIXEL", Settings().memory // (480 * 60))
    solids.render.resolution_x = solids.render.resolution_y = 480
    depsgraph = bpy.context.evaluated_depsgraph_get()
    engine = CancelledEngine(np.inf)
    ReferenceTracerEngine._trace(engine, depsgraph)
    whole = engine.shown["Combined"].reshape(480, 480, 4)
    assert np.diff(engine.shares).min() > -SHARE_ROUNDING
    assert engine.shares[-1] == 1
    assert engine.asked > 3
    cancelled = CancelledEngine(engine.asked // 2)
    ReferenceTracerEngine._trace(cancelled, depsgraph)
    combined = cancelled.shown["Combined"].reshape(480, 480, 4)
    done = (combined == whole).all(axis=(1, 2)) & whole.any(axis=(1, 2))
    empty = ~combined.any(axis=(1, 2))
    assert 0 < done.sum() < 480
    assert (done | empty).all()
    assert cancelled.shares[-1] < 1
    assert "Cancelled: " in capsys.readouterr().out


class DisturbedEngine(CancelledEngine):
    """As if a library switched off subnormals, while so much of the picture is done and shown."""

    def __init__(self, stop_at: float) -> None:
        super().__init__(stop_at)
        self.picture = np.full((480, 480, 4), np.nan, np.float32)

    def begin_result(self, x, y, width, height, layer):
        self.rows = slice(y, y + height)
        return super().begin_result(x, y, width, height, layer)

    def end_result(self, result) -> None:
        self.picture[self.rows] = self.shown["Combined"].reshape(-1, 480, 4)

    def update_progress(self, share: float) -> None:
        super().update_progress(share)
        if share > self.stop_at and self.asked == 0:
            self.asked = 1
            switch(MODES["both"])
            self.picture[:] = np.nan  # all is to be shown anew

    def test_break(self) -> bool:
        return False


@ON_X86
@pytest.mark.parametrize("method", ["certified", "auto"])
def test_a_render_whose_arithmetic_is_switched_off_is_withdrawn(method, solids, monkeypatch):
    """Rows that are shown by then go, too; *Automatic* begins again, without a proof."""
    monkeypatch.setattr(loop, "BYTES_PER_PIXEL", Settings().memory // (480 * 60))
    monkeypatch.setattr(engine_module, "SHOW_EVERY", 0)
    solids.render.resolution_x = solids.render.resolution_y = 480
    solids.reference_tracer.method = method
    solids.view_layers[0].reference_tracer.passes = set()
    engine = DisturbedEngine(0.5)
    with switched_back():
        if method == "certified":
            with pytest.raises(AssumptionError, match="subnormal results and subnormal operands"):
                ReferenceTracerEngine._trace(engine, bpy.context.evaluated_depsgraph_get())
            assert not engine.picture.any() and 0.5 < engine.shares[-1] < 0.9
            return
        ReferenceTracerEngine._trace(engine, bpy.context.evaluated_depsgraph_get())
    solids.reference_tracer.method = "watertight"
    plain = DisturbedEngine(2)
    ReferenceTracerEngine._trace(plain, bpy.context.evaluated_depsgraph_get())
    assert plain.picture.any() and np.array_equal(engine.picture, plain.picture)
