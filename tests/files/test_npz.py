"""Arrays in files: what a file declares is borne out, before anything is allocated."""

from __future__ import annotations

import io
import tracemalloc
import zipfile

import numpy as np
import pytest
from reference_tracer.files import npz
from reference_tracer.files.scenes import load_scene
from reference_tracer.scene import SceneError
from reference_tracer_rays.files import load_rays


def test_a_file_that_unpacks_to_far_more_than_itself_is_refused(tmp_path, monkeypatch):
    """An array that is asked for, or one that is not."""
    monkeypatch.setattr(npz, "SMALL", 1 << 20)
    path = tmp_path / "zeros.npz"
    header = io.BytesIO()
    claim = {"descr": "<f8", "fortran_order": False, "shape": (1 << 23, 3)}
    np.lib.format.write_array_header_1_0(header, claim)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as stored:
        with stored.open("origins.npy", "w", force_zip64=True) as file:
            file.write(header.getvalue())
            file.write(bytes(3 << 26))
    assert path.stat().st_size < 1 << 18
    for load in (load_rays, load_scene):
        tracemalloc.start()
        with pytest.raises(SceneError, match=r"zeros\.npz': its arrays would take 0\.2 GiB"):
            load(path)
        assert tracemalloc.get_traced_memory()[1] < 1 << 22
        tracemalloc.stop()


def test_what_is_written_is_read_however_well_it_is_packed(tmp_path, monkeypatch):
    monkeypatch.setattr(npz, "SMALL", 1 << 20)
    for size in (1 << 10, 1 << 20):
        npz.save(tmp_path / "a.npz", {"zeros": np.zeros(size)})
        with npz.opened(tmp_path / "a.npz") as stored:
            assert stored["zeros"].shape == (size,)


def member(array, version=(1, 0)) -> bytes:
    out = io.BytesIO()
    np.lib.format.write_array(out, array, version)
    return out.getvalue()


NUMBERS = member(np.ones((5, 3)))


@pytest.mark.parametrize(
    ("members", "says"),
    [
        ([NUMBERS, NUMBERS], "an array is in it twice"),
        ([NUMBERS[:-1]], "origins is not as long as it says"),
        ([NUMBERS + b"\0"], "origins is not as long as it says"),
        ([NUMBERS.replace(b"(5, 3)", b"(-5,3)")], "origins is not as long as it says"),
        ([NUMBERS.replace(b"'shape'", b"'shape ")], "is cut off or damaged"),
        ([member(np.ones((5, 3)), (3, 0))], r"origins is of numpy's format \(3, 0\)"),
    ],
)
@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_an_array_that_is_none_is_named(members, says, tmp_path):
    with zipfile.ZipFile(tmp_path / "a.npz", "w") as stored:
        for content in members:
            stored.writestr("origins.npy", content)
    with pytest.raises(SceneError, match=rf"a\.npz.*{says}"):
        load_rays(tmp_path / "a.npz")


def test_a_header_of_another_version_is_read(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.npz", "w") as stored:
        for name in ("origins", "directions"):
            stored.writestr(f"{name}.npy", member(np.ones((5, 3)), (2, 0)))
    assert load_rays(tmp_path / "a.npz").directions.shape == (3, 5)
