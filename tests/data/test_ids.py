"""Ids: what is named of wrong ones, whose is whose, and what looks like it and is not named."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.comparison.verdict import Verdict
from reference_tracer.pictures import colors_file
from reference_tracer.pictures.colors_file import in_colors
from reference_tracer.pictures.palette import By, eight_bits
from reference_tracer.rendering import render
from reference_tracer.report.lines import describe
from reference_tracer.scene import Region, SceneError

from .conftest import SOME

NUMBERS = {"Ball": 200, "Box": 10, "Floor": 60}
EXCHANGED = {"Ball": 10, "Box": 200, "Floor": 60}


def ids_of(frame, numbers=NUMBERS):
    table = np.array([*(numbers[name] for name in frame.scene.objects), 0], np.uint8)
    return table[frame.object_index]


def table(folder, content):
    path = folder / "names.json"
    path.write_text(json.dumps(content), encoding="utf-8")
    return path


def test_exchanged_ids_agree_unless_a_table_names_them(judged, told, traced, tmp_path):
    names = table(tmp_path, NUMBERS)
    for numbers in (NUMBERS, EXCHANGED):
        found = judged("ids", ids_of(traced, numbers))
        assert found.verdict == Verdict.AGREE
        assert describe(found)[-1].endswith("objects that exchanged theirs agree)")
    found = judged("ids", ids_of(traced), names=names)
    assert found.verdict == Verdict.AGREE and "exchanged" not in describe(found)[-1]
    wrong = ids_of(traced, EXCHANGED)
    found = judged("ids", wrong, names=names)
    assert found.counts.unexplained > 90
    assert found.to_dict()["metrics"] is None  # ids are names: none is nearer than another
    assert "RMSE" not in "\n".join(describe(found))
    assert told("ids", wrong, faults=SOME, names=names) == ["id_exchanged"]
    same = ids_of(traced, NUMBERS | {"Box": 200})
    assert told("ids", same, faults=SOME, names=names) == ["id_shared"]
    once = np.where(wrong == 200, 77, wrong)  # an id that is nobody's
    assert told("ids", once, faults=SOME, names=names) == ["id_shared"]


def test_colors_name_objects_too(judged, told, solids, tmp_path):
    scene, _ = in_colors(solids, By.OBJECT)
    path = tmp_path / "colors.json"
    path.write_text(colors_file.text(scene, ()), encoding="utf-8")
    frame = render(scene)
    for shown in (eight_bits(frame.color[..., :3]), frame.color[..., :3]):
        assert judged("ids", shown, scene, names=path).verdict == Verdict.AGREE
        first, second = (scene.instances[k].colors[0, :3] for k in (0, 1))
        if shown.dtype == np.uint8:
            first, second = eight_bits(first), eight_bits(second)
        wrong = shown.copy()
        wrong[(shown == first).all(axis=-1)] = second
        wrong[(shown == second).all(axis=-1)] = first
        assert told("ids", wrong, scene, faults=SOME, names=path) == ["id_exchanged"]


@pytest.mark.parametrize(
    "content, words",
    [
        ({"Ball": 1, "Box": 2}, "has no id for 'Floor'"),
        ([1, 2, 3], "is no table of ids for 1 channels"),
        ({"Ball": [1, 2], "Box": 2, "Floor": 3}, "is no table of ids for 1 channels"),
        ({"Ball": "one", "Box": 2, "Floor": 3}, "is no table of ids for 1 channels"),
    ],
)
def test_a_table_that_is_none_is_refused(judged, traced, tmp_path, content, words):
    with pytest.raises(SceneError, match=words):
        judged("ids", ids_of(traced), names=table(tmp_path, content))


def mixed(solids, shape=None):
    """What anti-aliasing makes of ids, or of colours: the mean of four by four samples."""
    camera = replace(solids.camera, width=128, height=96, region=Region(0, 0, 128, 96))
    many = ids_of(render(solids.seen_by(camera))).astype(np.float64)
    if shape:
        many = np.stack((many, 255 - many, many / 2), axis=-1)
    parts = many.reshape(24, 4, 32, 4, *many.shape[2:])
    return np.rint(parts.mean(axis=(1, 3))).astype(np.uint8)


@pytest.mark.parametrize("shape", [None, 3], ids=["numbers", "colours"])
def test_ids_that_are_mixed_at_edges(told, judged, solids, traced, shape, rng):
    """But nothing that is no mean of what is around, or lies inside, or is another object's id."""
    ids = mixed(solids, shape)
    assert judged("ids", ids).verdict == Verdict.DIFFERENCES
    assert told("ids", ids, faults=SOME) == ["id_mixed"]
    pure = ids_of(traced)
    pure = np.stack((pure, 255 - pure, pure // 2), axis=-1) if shape else pure
    edges = (ids != pure).reshape(24, 32, -1).any(axis=-1)
    beyond = pure.copy()
    beyond[edges] = rng.integers(230, 255, beyond[edges].shape)
    assert told("ids", beyond, faults=SOME) == []
    inside = traced.object_index == 2  # the floor, away from what is before and behind it
    for shift in (1, 2, -1, -2):
        inside &= np.roll(inside, shift, 0) & np.roll(inside, shift, 1)
    stained = pure.copy()
    stained[inside] = stained[inside] // 2 + 3
    assert inside.sum() > 8 and "id_mixed" not in told("ids", stained, faults=SOME)
    assert "id_mixed" not in told("ids", np.roll(pure, 1, axis=1), faults=SOME)


@pytest.mark.parametrize("from_top", [True, False])
@pytest.mark.parametrize("kind", ["ids", "depth"])
def test_columns_that_are_read_as_rows(told, traced, kind, from_top):
    """But not a picture that lies on its side."""
    right = ids_of(traced) if kind == "ids" else np.nan_to_num(traced.t, posinf=0)
    right = right[::-1] if from_top else right
    read = right.ravel(order="F").reshape(right.shape)
    assert told(kind, read[::-1] if from_top else read, faults=SOME) == ["column_order"]


def test_a_picture_on_its_side_is_not_stored_by_columns(told, solids):
    camera = replace(solids.camera, width=24, region=Region(0, 0, 24, 24))
    square = solids.seen_by(camera)
    ids = ids_of(render(square))
    for wrong in (np.rot90(ids), np.rot90(ids, 2), ids[:, ::-1]):
        assert "column_order" not in told("ids", wrong, square, faults=SOME)
