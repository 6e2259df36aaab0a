"""Files changed at random: each is read, or refused in a line that names it."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from reference_tracer.camera_files.convention import View
from reference_tracer.camera_files.files import CONVENTIONS, read, texts
from reference_tracer.scene import SceneError

from ..fuzz.mutations import mutated
from .cameras import camera, written
from .test_conventions import on_disk

CASES = 40
AS_TEXT = {"colmap", "mitsuba", "mvsnet"}


def changed_at_random(name, folder, count):
    """Read a file with one change, as often as asked; returns how many could be read."""
    rng = np.random.default_rng(21)
    views = [View(camera(rng), f"{n:04d}.png", n) for n in (1, 2)]
    files = written(name, views)
    done = 0
    for _ in range(count):
        which = sorted(files)[rng.integers(len(files))]
        content = files[which].encode()
        bad = mutated(".obj" if name in AS_TEXT else ".json", content, rng, content)
        path = on_disk(files, folder)
        (folder / (which or "camera")).write_bytes(bad)
        for convention in (None, name):
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("error")
                    read(path, convention, (64, 36))
                done += 1
            except SceneError as error:
                assert str(path) in str(error)
    return done


@pytest.mark.parametrize("name", CONVENTIONS)
def test_each_is_read_or_refused(name, tmp_path):
    assert 0 < changed_at_random(name, tmp_path / "files", CASES) < 2 * CASES


def test_a_convention_that_is_named_is_held_to(tmp_path):
    view = View(camera(np.random.default_rng(1)), "0001.png", 1)
    path = on_disk(texts([view], CONVENTIONS["nerf"]), tmp_path / "files")
    assert len(read(path, "nerf")) == 1
    with pytest.raises(SceneError, match="its content is not that of OpenCV"):
        read(path, "opencv")


def test_xml_with_entities_is_refused(tmp_path):
    view = View(camera(np.random.default_rng(1)), "0001.png", 1)
    text = texts([view], CONVENTIONS["mitsuba"])[""]
    path = tmp_path / "bomb.xml"
    path.write_text(f'<!DOCTYPE a [<!ENTITY b "c">]>\n{text}', encoding="utf-8")
    with pytest.raises(SceneError, match="DOCTYPE"):
        read(path)
