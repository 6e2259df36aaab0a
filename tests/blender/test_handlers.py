"""Handlers of a script's add and remove data while a comparison has Blender draw: none crashes it.

Nor may what they do to the scene pass for a difference that nobody can explain.
"""

from __future__ import annotations

import subprocess
import sys
from itertools import product
from pathlib import Path

import pytest

CHILD = Path(__file__).with_name("handlers_child.py")
HANDLERS = (
    "render_init",
    "render_pre",
    "render_post",
    "render_write",
    "render_complete",
    "frame_change_pre",
    "frame_change_post",
    "depsgraph_update_pre",
    "depsgraph_update_post",
)
KINDS = "objects", "collections", "meshes", "materials", "images", "scenes"


def survived(combinations) -> dict[str, tuple[str, int]]:
    """Return the verdict and the number of calls of each that Blender survived."""
    names = [":".join(c) for c in combinations]
    done = subprocess.run([sys.executable, CHILD, *names], capture_output=True, text=True)
    lines = (x.split("\t")[1:] for x in done.stdout.splitlines() if x.startswith("survived\t"))
    found = {name: (verdict, int(calls)) for name, verdict, calls in lines}
    assert list(found) == names, f"ended with {done.returncode}: {done.stderr[-2000:]}"
    assert done.returncode == 0, done.stderr
    return found


def test_data_may_come_and_go():
    crashed = (  # each of these once crashed 5.2
        ("WORKBENCH", "render_init", "remove", "images"),
        ("WORKBENCH", "render_pre", "add", "objects"),
        ("WORKBENCH", "depsgraph_update_post", "add", "collections"),
        ("CYCLES", "render_pre", "remove", "objects"),
    )
    found = survived(crashed)
    assert all(calls > 1 for _, calls in found.values())
    assert {name: verdict for name, (verdict, _) in found.items()} == {
        ":".join(c): "not comparable" if c[2:] == ("remove", "objects") else "agree"
        for c in crashed
    }


@pytest.mark.torture
@pytest.mark.parametrize("handler", HANDLERS)
@pytest.mark.parametrize("judge", ["WORKBENCH", "CYCLES"])
def test_all_data_may_come_and_go(judge, handler):
    found = survived(product([judge], [handler], ["add", "remove"], KINDS))
    assert {verdict for verdict, _ in found.values()} <= {"agree", "not comparable"}
    assert all(calls > 1 for _, calls in found.values())


def test_the_users_strips_stay_and_are_not_drawn(build, compare):
    """They are taken out of the temporary scene, which shares their animation with the user's."""
    scene = build.room()
    plain = compare().picture
    build.sequencer()
    editor = scene.sequence_editor
    [strip] = editor.strips if hasattr(editor, "strips") else editor.sequences
    for frame, alpha in ((1, 0.2), (9, 1.0)):
        strip.blend_alpha = alpha
        strip.keyframe_insert("blend_alpha", frame=frame)
    strip.blend_alpha = 0.7  # not keyed
    found = compare()
    assert found.verdict == "agree"
    assert (found.picture == plain).all()
    assert scene.sequence_editor == editor and scene.render.use_sequencer
    assert strip.blend_alpha == pytest.approx(0.7)
    scene.frame_set(9)
    assert strip.blend_alpha == 1.0
