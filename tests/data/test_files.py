"""Files of data: which array is read, what is refused and how, and what the document says."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer import compare
from reference_tracer.comparison.verdict import Verdict
from reference_tracer.files import exr
from reference_tracer.files.scenes import save_scene
from reference_tracer.pictures.source import SizeError
from reference_tracer.scene import SceneError
from reference_tracer_data.depth import DEPTH
from reference_tracer_data.files import read


def test_our_own_exr_is_right_in_all_that_it_holds(judged, traced):
    def save(path, values):
        exr.save(path, values)

    for kind in ("depth", "normals", "positions", "ids"):
        found = judged(kind, traced.passes(), name="all.exr", save=save)
        assert found.verdict == Verdict.AGREE, kind


def test_an_array_is_chosen_by_its_name(judged, traced, tmp_path):
    held = {"depth": traced.t, "other": traced.t + 1, "normal": traced.normal, "k": np.eye(3)}

    def save(path, values):
        np.savez(path, **values)

    assert judged("depth", held, name="all.npz", save=save).verdict == Verdict.AGREE
    found = judged("depth", held, name="all.npz", save=save, layer="other")
    assert found.counts.unexplained > 50
    with pytest.raises(OSError, match=r"no layer 'z': it has depth \(24, 32\), other"):
        judged("depth", held, name="all.npz", save=save, layer="z")
    del held["depth"]
    with pytest.raises(OSError, match=r"several arrays that may be depth.*layer= names"):
        judged("depth", held, name="all.npz", save=save)


def test_the_first_row_may_be_the_topmost(judged, traced):
    assert judged("depth", traced.t[::-1], top_down=True).verdict == Verdict.AGREE


@pytest.mark.parametrize(
    "values, words",
    [
        (np.zeros((24, 32, 2)), "no depth: it has one array"),
        (np.zeros(7), "no depth"),
        (np.random.default_rng(1).random((24, 32, 3)), "its channels differ"),
        (np.full((24, 32), "a"), "holds <U1 and not numbers"),
        (np.full((24, 32), None), "its array holds objects of Python"),
    ],
)
def test_what_holds_no_depths_is_refused(judged, values, words):
    with pytest.raises((OSError, SceneError), match=words):
        judged("depth", values)


def test_a_file_that_is_cut_off_or_none_is_refused(judged, traced, tmp_path):
    def save(path, values):
        np.save(path, values)
        path.write_bytes(path.read_bytes()[:-100])

    with pytest.raises(SceneError, match=r"data\.npy': its array is not as long as it says"):
        judged("depth", traced.t, save=save)
    with pytest.raises(OSError, match="there is no file"):
        read(tmp_path / "none.npy", DEPTH)
    with pytest.raises(OSError, match=r"holds no depth: it must be \.exr"):
        judged("depth", traced.t, name="depth.tiff", save=lambda path, v: path.write_bytes(b"II*"))
    with pytest.raises(SizeError, match="has 31 x 24 pixels, the traced one 32 x 24"):
        judged("depth", traced.t[:, 1:])


def test_grey_depths_may_have_nan_where_nothing_is(judged, traced):
    grey = np.repeat(np.where(np.isfinite(traced.t), traced.t, np.nan)[..., None], 3, axis=2)
    assert judged("depth", grey).verdict == Verdict.AGREE


@pytest.mark.parametrize(
    "options, words",
    [
        (["depth", "space=camera"], "--holds space is for normals, positions"),
        (
            ["depth", "first-row=bottom", "--against", "d.exr"],
            "--holds first-row is for .npy, .npz",
        ),
        (["depth", "layel=a"], "not 'layel=a'; layer is the nearest; the names are layer, scale"),
        (["depth", "--excuse", "dither=1"], "--excuse dither is for colours, and depth has none"),
        (["depth", "--self-check"], "--self-check is for a picture of colours"),
        (["depth", "--excuse", "filter=0.6"], "cannot be compared: it is sampled up to 0.6 px"),
    ],
)
def test_options_without_effect_are_refused(
    solids, traced, tmp_path, monkeypatch, capsys, exit_code, options, words
):
    monkeypatch.chdir(tmp_path)
    save_scene("scene.npz", solids)
    np.save("d.npy", traced.t)
    compare = ["compare", "scene.npz", "--out", "out", "--against", "d.npy"]
    assert exit_code([*compare, "--holds", *options]) == 4
    assert words in capsys.readouterr().err


def test_what_is_held_is_held_by_a_file(solids, tmp_path, capsys, exit_code):
    save_scene(tmp_path / "scene.npz", solids)
    compare = ["compare", str(tmp_path / "scene.npz"), "--out", str(tmp_path), "--holds", "depth"]
    assert exit_code(compare) == 4
    assert "--holds is for a file of --against" in capsys.readouterr().err


def test_the_command_says_what_it_compared(solids, traced, tmp_path, capsys, exit_code):
    save_scene(tmp_path / "scene.npz", solids)
    np.save(tmp_path / "d.npy", traced.t.astype(np.float32))
    paths = [str(tmp_path / name) for name in ("scene.npz", "d.npy")]
    out = "--holds", "depth", "--out", str(tmp_path / "out")
    assert exit_code(["compare", paths[0], "--against", paths[1], *out]) == 0
    said = capsys.readouterr().out
    assert "768 of 768 pixels agree with depths along the view axis 'd.npy', 0 differ" in said
    assert "note: of 'd.npy': it holds float32" in said
    assert "depths along the view axis: RMSE " in said and "PSNR" not in said
    assert (tmp_path / "out" / "page.html").exists()


def test_a_script_compares_arrays(solids, traced):
    assert compare(solids, traced.t, kind="depth").verdict == Verdict.AGREE
    found = compare(solids, 1000 * traced.t.astype(np.float32), kind="depth")
    assert [told.fault.name for told in found.diagnosis.told] == ["data_unit"]
    millimetres = np.rint(1000 * np.nan_to_num(traced.t, posinf=0)).astype(np.uint16)
    assert compare(solids, millimetres, kind="depth", scale=0.001).verdict == Verdict.AGREE
    assert compare(solids, traced.object_index, kind="ids").verdict == Verdict.AGREE
    with pytest.raises(ValueError, match="kind is 'height'; it must be one of depth, distance"):
        compare(solids, traced.t, kind="height")
    for scale in (0, -1, np.nan, np.inf):
        with pytest.raises(ValueError, match="it must be above 0"):
            compare(solids, traced.t, kind="depth", scale=scale)
    with pytest.raises(ValueError, match="normals are no lengths"):
        compare(solids, traced.normal, kind="normals", scale=2.0)
