"""A picture that cannot be held is refused before any work, in words that say what to do."""

from __future__ import annotations

import re

import pytest
from reference_tracer.tracer import memory
from reference_tracer.tracer.frame import FRAME_BYTES_PER_PIXEL, Frame
from reference_tracer.tracer.memory import PictureTooLargeError, check_memory, free_memory
from reference_tracer.tracer.render import render


def test_the_share_of_a_pixel_is_that_of_the_arrays(make):
    arrays = Frame.empty(make.scene(make.camera(7, 5))).arrays()
    del arrays["rows_done"]
    assert sum(a.nbytes for a in arrays.values()) == 7 * 5 * FRAME_BYTES_PER_PIXEL


def test_free_memory_is_known_here():
    """Within what a process may see: more than this test has, less than a PiB."""
    assert 1 << 24 < free_memory() < 1 << 50


def test_too_large_a_picture_is_refused(make):
    scene = make.scene(make.camera(60_000_000, 50_000_000))
    with pytest.raises(PictureTooLargeError) as refused:
        render(scene)
    text = str(refused.value)
    assert re.fullmatch(
        r"The picture has 60000000 x 50000000 pixels, which take [\d.]+ GiB with all outputs, and "
        r"[\d.]+ GiB of memory are free: choose a smaller size, or a border.",
        text,
    )


@pytest.mark.parametrize("free, fits", [(None, True), (799, False), (800, True)])
def test_what_is_free_decides(free, fits, monkeypatch):
    monkeypatch.setattr(memory, "free_memory", lambda: free)
    if fits:
        check_memory(10, 8, 10)
    else:
        with pytest.raises(PictureTooLargeError):
            check_memory(10, 8, 10)


def test_the_least_of_machine_and_container_counts(monkeypatch):
    for machine, container, expected in ((5, None, 5), (None, 3, 3), (5, 3, 3), (None, None, None)):
        monkeypatch.setattr(memory, "_free_of_machine", lambda m=machine: m)
        monkeypatch.setattr(memory, "_free_of_container", lambda c=container: c)
        assert free_memory() == expected
