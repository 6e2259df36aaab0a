"""What a file says reaches the terminal as harmless words, by every command that reads one."""

from __future__ import annotations

import json

import numpy as np
import pytest
from reference_tracer.files import images
from reference_tracer.files.certificates import save_certificate
from reference_tracer.files.scenes import save_scene
from reference_tracer.manifest import Effect, Manifest, ObjectEntry, Unmodelled
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Plane, Scene
from reference_tracer.tracer.settings import Settings
from reference_tracer.wording import LONGEST
from reference_tracer_verify import verify

LIE = "all pixels see what it says"
STEERING = f"\r\x1b[2K{LIE}\n{LIE}\x85{LIE}\u2028{LIE}\x08\x9b8m\u202e\ud800\x1b]0;owned\x07"
WORDS = f"a{STEERING}{'A' * 100_000}"


@pytest.fixture
def folder(make, tmp_path, monkeypatch):
    """Files in which every text is hostile: a scene, its picture, and what commands read beside."""
    monkeypatch.chdir(tmp_path)
    scene = Scene(
        make.camera(16, 9, name=WORDS),
        [make.quad(-1, 1, -1, 1, -3, name=WORDS)],
        [Instance(0, 0, np.eye(4)), Instance(0, 1, np.eye(4))],
        [Plane(2, (0, 0, -9), (0, 0, 1))],
        objects=(WORDS, f"{WORDS}2", f"{WORDS}3"),
    )
    lacks = tuple(Unmodelled(WORDS, WORDS, WORDS, effect=e, by=(WORDS,)) for e in Effect)
    entry = ObjectEntry(WORDS, WORDS, exported=True, left_out=2)
    save_scene("scene.npz", scene, Manifest("", "", "", 0, "FILE", "", (entry,), lacks, (WORDS,)))
    frame = render(scene, Settings("certified"))
    images.save_png("scene.png", images.to_display(1 - frame.color))
    save_certificate("certificate.npz", frame)
    arrays = dict(np.load("certificate.npz"))
    for name, change in {
        "schema": {"certificate": np.array(WORDS)},
        "camera": {"camera": np.array(WORDS)},
        "more": {f"x{STEERING}".replace("\ud800", ""): np.zeros(3)},
    }.items():
        np.savez(f"{name}.npz", **arrays | change)
    no_text = np.full(9, 2**31 - 1, "<u4").view("<U9")[0:1].reshape(())  # no letters at all
    np.savez("letters.npz", **arrays | {"certificate": no_text})
    np.savez("depth.npz", **{f"{k}{STEERING}".replace("\ud800", ""): frame.t for k in range(99)})
    for name in ("colors", "pixel", "camera"):
        content = {"schema": WORDS, "K": WORDS, "objects": {WORDS: WORDS}, WORDS: WORDS}
        (tmp_path / f"{name}.json").write_text(json.dumps(content))
    return tmp_path


COMMANDS = [
    "trace scene.npz --out a.png",
    "compare scene.npz --against scene.png --out out",
    "compare scene.npz --against scene.png --out out --colors colors.json",
    "compare scene.npz --against depth.npz --holds depth --out out",
    "compare scene.npz --out out --colors-out c.json",
    "explain scene.npz 8 4",
    "explain pixel.json",
    "rays scene.npz --rays schema.npz --out hits.npz",
    "rays scene.npz --rays depth.npz --out hits.npz",
    "diff scene.npz certificate.npz",
    "diff scene.npz scene.npz",
    "camera scene.npz --out c.json",
    "camera scene.npz --check camera.json",
    "trade scene.npz --set width=8 --samples 1",
    "verify schema.npz",
    "verify camera.npz",
    "verify more.npz",
    "verify letters.npz",
]


@pytest.mark.parametrize("command", COMMANDS)
def test_words_of_a_file_are_harmless(command, folder, exit_code, capsys):
    code = exit_code(command.split())
    check(capsys.readouterr())
    assert code in range(5)


@pytest.mark.parametrize("name", ["schema", "camera", "more", "letters"])
def test_the_checker_alone_is_as_careful(name, folder, monkeypatch, capsys):
    monkeypatch.setattr("sys.argv", ["verify.py", f"{name}.npz"])
    with pytest.raises(SystemExit):
        verify.main()
    check(capsys.readouterr())


def check(printed) -> None:
    lines = (printed.out + printed.err).split("\n")
    assert any(lines) and not any("Traceback" in line for line in lines)
    for line in lines:
        assert line.isprintable() and len(line) < 11 * LONGEST, line[:99]
        assert not line.startswith(LIE)
