"""What `reftrace trace` writes for other programs: Cryptomatte, masks, arrays."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import OpenEXR
import pytest
from PIL import Image
from reference_tracer.cli.main import main
from reference_tracer.files.scenes import save_scene
from reference_tracer.rendering import render
from reference_tracer.report import cryptomatte, masks


@pytest.fixture
def named(make):
    """A room of which the box hides a part of the ball, and an object that is not seen."""
    return replace(make.room(), objects=("Ball", "Bücher/Box", "Wand"))


@pytest.fixture
def written(named, tmp_path):
    save_scene(tmp_path / "scene.npz", named)

    def run(name, *options):
        path = tmp_path / name
        command = ["trace", str(tmp_path / "scene.npz"), "--out", str(path), *options]
        assert main(command) == 0
        return path

    return run


@pytest.mark.parametrize(
    "name, bits",
    [("", 0), ("hello", 0x248BFA47), ("test", 0xBA6BD213), ("Hello, world!", 0xC0363E43)],
)
def test_murmur_hash_3(name, bits):
    assert cryptomatte.hashed(name) == bits


def test_ids_are_floats_that_any_program_keeps(rng):
    ids = [cryptomatte.id_of(f"object {k}") for k in range(3000)]
    exponents = {bits >> 23 & 0xFF for bits in ids}
    assert len(set(ids)) == 3000 and not exponents & {0, 0xFF} and len(exponents) > 200


def test_an_exr_has_the_objects_as_cryptomatte(written, named):
    with OpenEXR.File(str(written("all.exr")), separate_channels=True) as file:
        channels = {name: c.pixels[::-1] for name, c in file.channels().items()}
        head = {k: v for k, v in file.header().items() if k.startswith("cryptomatte/")}
    key = f"cryptomatte/{cryptomatte.hashed('CryptoObject'):08x}"[:-1]
    assert head[f"{key}/name"] == "CryptoObject"
    manifest = json.loads(head[f"{key}/manifest"])
    assert set(manifest) == set(named.objects)
    index = render(named).object_index
    bits = np.ascontiguousarray(channels["CryptoObject00.R"]).view(np.uint32)
    for number, name in enumerate(named.objects):
        assert np.array_equal(bits == int(manifest[name], 16), index == number)
    assert np.array_equal(channels["CryptoObject00.G"], index >= 0)


def test_an_npz_has_all_arrays_and_the_names(written, named):
    for name, options, step in (("a.npz", (), 1), ("b.NPZ", ("--top-down",), -1)):
        with np.load(written(name, *options)) as held:
            for key, values in render(named).passes().items():
                assert np.array_equal(held[key], values[::step], equal_nan=True), key
            assert tuple(held["objects"]) == named.objects


def _decoded(run):
    """Undo COCO's run lengths: column by column, zeros first."""
    values = np.repeat(np.arange(len(run["counts"])) % 2, run["counts"])
    return values.reshape(run["size"][::-1]).T.astype(bool)


def test_masks_are_what_is_seen_and_the_whole(written, named, tmp_path):
    written("picture.png", "--masks", str(tmp_path / "masks"))
    held = json.loads((tmp_path / "masks" / masks.NAME).read_text(encoding="utf-8"))
    assert [c["name"] for c in held["categories"]] == list(named.objects)
    assert held["images"] == [{"id": 1, "file_name": "picture.png", "width": 60, "height": 45}]
    index = render(named).object_index[::-1]
    hidden = 0
    for one in held["annotations"]:
        number = one["category_id"] - 1
        own = index == number
        assert np.array_equal(_decoded(one["segmentation"]), own)
        stored = np.asarray(Image.open(tmp_path / "masks" / one["file_name"]))
        assert stored.shape == own.shape and np.array_equal(stored, np.where(own, 255, 0))
        x, y, width, height = one["bbox"]
        assert own[y : y + height, x : x + width].sum() == own.sum() == one["area"]
        assert own[y].any() and own[:, x].any() and own[y + height - 1].any()
        alone = replace(named, instances=tuple(i for i in named.instances if i.object == number))
        whole = render(alone).object_index[::-1] >= 0
        assert np.array_equal(_decoded(one["amodal_segmentation"]), whole)
        assert one["bbox_obj"] == masks.box(whole) and (whole | ~own).all()
        assert one["visib_fract"] == own.sum() / whole.sum()
        hidden += one["visib_fract"] < 1
    assert hidden and len(held["annotations"]) == 3


def test_runs_begin_with_zeros_and_go_down_the_columns():
    mask = np.array([[0, 1], [1, 1], [1, 0]], bool)
    assert masks.runs(mask) == {"size": [3, 2], "counts": [1, 4, 1]}
    assert masks.runs(np.zeros((2, 2), bool))["counts"] == [4]
    assert masks.box(np.zeros((2, 2), bool)) == [0, 0, 0, 0]
