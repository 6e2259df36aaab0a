"""What an interruption leaves in a folder: the older result, the new one, or none."""

from __future__ import annotations

import errno
import os

import pytest
from reference_tracer.cli.main import main
from reference_tracer.report import folders

NAMES = "a.txt", "b.png", "c.json"


def fill(directory, text, names=NAMES):
    for name in names:
        (directory / name).write_text(text)


def held(directory):
    return {p.name: p.read_text() for p in directory.iterdir()}


@pytest.fixture
def folder(tmp_path):
    """A folder with an older result, and a file that is none of its."""
    (tmp_path / "out").mkdir()
    fill(tmp_path / "out", "old", (*NAMES, "mine"))
    return tmp_path / "out"


def test_all_is_replaced_but_what_is_not_ours(folder):
    with folders.replacing(folder, NAMES) as new:
        fill(new, "new", NAMES[1:])
    assert held(folder) == {"b.png": "new", "c.json": "new", "mine": "old"}


@pytest.mark.parametrize("error", [KeyboardInterrupt, MemoryError, OSError])
def test_interrupted_while_writing(error, folder):
    """Nothing has changed."""
    before = held(folder)
    with pytest.raises(error), folders.replacing(folder, NAMES) as new:
        fill(new, "new", NAMES[:2])
        raise error
    assert held(folder) == before


@pytest.mark.parametrize("step", range(3))
def test_interrupted_while_renaming(step, folder, monkeypatch):
    """The last name is there only with all the others, and nothing is mixed."""
    real, count = os.replace, iter(range(9))

    def replace(*paths):
        if next(count) == step:
            raise KeyboardInterrupt
        real(*paths)

    monkeypatch.setattr(os, "replace", replace)
    with pytest.raises(KeyboardInterrupt), folders.replacing(folder, NAMES) as new:
        fill(new, "new")
    found = held(folder)
    assert found.pop("mine") == "old"
    assert set(found.values()) <= {"new"} and "c.json" not in found


def test_the_last_name_goes_first(folder, monkeypatch):
    gone = []
    monkeypatch.setattr(os, "replace", lambda *paths: None)
    real = type(folder).unlink
    monkeypatch.setattr(
        type(folder), "unlink", lambda path, **o: (gone.append(path.name), real(path, **o))
    )
    with folders.replacing(folder, NAMES):
        pass
    assert gone == ["c.json", "b.png", "a.txt"]


def test_a_file_is_whole_or_as_it_was(tmp_path):
    (tmp_path / "x.png").write_text("old")
    with pytest.raises(KeyboardInterrupt), folders.replacing_file(tmp_path / "x.png") as new:
        new.write_text("half")
        raise KeyboardInterrupt
    assert held(tmp_path) == {"x.png": "old"}
    with folders.replacing_file(tmp_path / "x.png") as new:
        new.write_text("new")
    assert held(tmp_path) == {"x.png": "new"}


def test_a_folder_that_was_made_in_vain_goes(tmp_path):
    with pytest.raises(KeyboardInterrupt), folders.made(tmp_path / "new" / "out"):
        assert (tmp_path / "new" / "out").is_dir()
        raise KeyboardInterrupt
    assert not (tmp_path / "new").exists()


def test_a_folder_that_was_there_or_holds_something_stays(tmp_path):
    with pytest.raises(KeyboardInterrupt), folders.made(tmp_path):
        raise KeyboardInterrupt
    with pytest.raises(KeyboardInterrupt), folders.made(tmp_path / "new" / "out"):
        (tmp_path / "new" / "out" / "why.json").touch()
        raise KeyboardInterrupt
    assert (tmp_path / "new" / "out" / "why.json").exists()


@pytest.mark.parametrize("name", ["file", "file/out", "file/out/deeper"])
def test_a_folder_that_cannot_be_written(name, tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(OSError, match=rf"cannot write to the folder '.*{name}': .*is a file"):
        folders.make(tmp_path / name)
    assert [p.name for p in tmp_path.iterdir()] == ["file"]


def test_a_folder_that_does_not_take_files(tmp_path, monkeypatch):
    def refuse(**options):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(folders.tempfile, "TemporaryFile", refuse)
    with pytest.raises(OSError, match=r"cannot write to the folder '.*out': Permission denied"):
        folders.make(tmp_path / "out")
    assert not (tmp_path / "out").exists()
    with pytest.raises(OSError, match="it is a folder"), folders.made_for_file(tmp_path):
        pass


@pytest.mark.parametrize("locked", ["replace", "unlink"])
def test_a_file_that_is_open_elsewhere_is_named(locked, folder, monkeypatch):
    """Windows locks it; nothing that was there is then of two runs."""
    fill(folder, "old")
    name = NAMES[0]

    def refused(*paths, **_):
        if any(str(path) == str(folder / name) for path in paths):
            path = [paths[0], None, paths[1]] if locked == "replace" else paths
            raise PermissionError(errno.EACCES, "Access is denied", *path)
        return real(*paths, **_)

    real = getattr(os, locked)
    monkeypatch.setattr(os, locked, refused)
    with pytest.raises(OSError, match=f"cannot replace '.*{name}': another program may have it"):
        with folders.replacing(folder, NAMES) as new:
            fill(new, "new")
    assert NAMES[-1] not in held(folder)
    if locked == "replace":
        with pytest.raises(OSError, match=f"cannot replace '.*{name}': another program may"):
            folders.write_text(folder / name, "new")


@pytest.fixture
def full():
    """No file may have more than 300 bytes: as on a full disk, writing ends with an error."""
    resource = pytest.importorskip("resource")  # Windows has no such limits
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (300, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)


def test_a_full_disk_is_said_with_the_file(folder, full):
    before = held(folder)
    with pytest.raises(OSError, match=r"mine'.*: free some, or write elsewhere"):
        folders.write_text(folder / "mine", "x" * 9999)
    with pytest.raises(OSError, match=r"out'.*: free some, or write elsewhere"):
        with folders.replacing(folder, NAMES) as new:
            fill(new, "x" * 9999)
    assert held(folder) == before


@pytest.mark.parametrize("suffix", ["png", "exr"])
def test_a_full_disk_ends_trace_in_one_line(suffix, tmp_path, full, capfd):
    path = tmp_path / "a.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    out = tmp_path / f"picture.{suffix}"
    size = ["--set", "width=300", "height=300", "--samples", "2"]
    assert main(["trace", str(path), "--out", str(out), *size]) == 4
    printed = capfd.readouterr()
    assert f"picture.{suffix}'" in printed.err and len(printed.err.splitlines()) == 1
    assert "write" in printed.err and not out.exists() and len(list(tmp_path.iterdir())) == 1
