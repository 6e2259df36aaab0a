"""What Blender reports when it opens a file is a note; what it cannot open is never traced."""

from __future__ import annotations

import json
import re
import struct
from pathlib import Path

import bpy
import pytest
from reference_tracer.blender.reading import opened

KNOWN, UNKNOWN = 113, 300  # channels of a sequencer, which has 128


def patched(path: Path, build) -> None:
    """Write a file with a strip in a channel that Blender does not have: it reports that."""
    build.room(32, 18)
    editor = bpy.context.scene.sequence_editor_create()
    strips = editor.strips if hasattr(editor, "strips") else editor.sequences
    length = {"length" if bpy.app.version >= (5, 0, 0) else "frame_end": 10}
    strips.new_effect("Strip", "COLOR", channel=KNOWN, frame_start=1, **length)
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=False)
    content, known = path.read_bytes(), struct.pack("<i", KNOWN)
    at = content.find(known)
    while at >= 0:
        path.write_bytes(content[:at] + struct.pack("<i", UNKNOWN) + content[at + 4 :])
        try:
            bpy.ops.wm.open_mainfile(filepath=str(path))
        except RuntimeError as error:
            if "channel" in str(error):
                return
        at = content.find(known, at + 1)
    raise AssertionError("no byte of the file is the strip's channel")


@pytest.fixture
def reported(build, tmp_path) -> Path:
    path = tmp_path / "reported.blend"
    patched(path, build)
    return path


def test_a_file_that_opens_with_a_report_is_compared(reported, tmp_path, reftrace):
    done = reftrace("compare", reported, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    (line,) = (line for line in done.stdout.splitlines() if "note: Blender opened" in line)
    assert "strip" in line and "channel" in line
    found = json.loads((tmp_path / "out" / "comparison.json").read_text(encoding="utf-8"))
    assert any("channel" in note for note in found["scene"]["notes"])
    assert "channel larger" in (tmp_path / "out" / "page.html").read_text(encoding="utf-8")


def test_a_report_is_kept_where_the_next_file_cannot_be_opened(reported, tmp_path):
    opened.open_file(reported)
    before = opened.notes()
    assert "channel" in before[0]
    (tmp_path / "no.blend").write_bytes(b"no .blend at all" * 100)
    with pytest.raises(RuntimeError):
        opened.open_file(tmp_path / "no.blend")
    assert Path(bpy.data.filepath) == reported and opened.notes() == before


def damaged(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:5000])


def no_blend(path: Path) -> None:
    path.write_bytes(b"no .blend at all" * 100)


def empty(path: Path) -> None:
    path.write_bytes(b"")


@pytest.mark.parametrize("spoil", [damaged, no_blend, empty], ids=lambda f: f.__name__)
def test_the_file_that_was_open_before_is_not_taken_for_it(spoil, reported, reftrace, tmp_path):
    """Not even where it had the same path, and was opened with a report itself."""
    export = "export", reported, "--out", tmp_path / "a.npz"
    assert reftrace(*export).returncode == 0
    (tmp_path / "a.npz").unlink()
    spoil(reported)
    done = reftrace(*export)
    assert done.returncode == 4 and not (tmp_path / "a.npz").exists()
    why = "(cannot be opened by Blender|is no .blend|is empty)"
    assert re.search(f"'{reported}' {why}", done.stderr.splitlines()[-1])
