"""The script that draws docs/speed.md's pictures and counts what its table says, at a tiny size."""

import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
from reference_tracer.scene_files import save_scene

PROJECT = Path(__file__).parent.parent


@pytest.mark.slow
def test_draw_culling(make, tmp_path: Path):
    # Two squares whose edges run through the centres of pixels, one behind the other.
    camera = make.camera(16, 16, half=8, orthographic=True)
    quads = make.quad(-4.5, 4.5, -4.5, 4.5, -5), make.quad(-4.5, 4.5, -4.5, 4.5, -6)
    save_scene(tmp_path / "squares.npz", make.scene(camera, *quads))

    script = PROJECT / "tools" / "draw_culling.py"
    options = ["--width", "16", "--detail", "4", "--out", tmp_path]
    done = subprocess.run(
        [sys.executable, script, tmp_path / "squares.npz", *options], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    head, _, *rows = [
        [v.strip() for v in line.strip("|").split("|")] for line in done.stdout.splitlines()
    ]
    assert [r[0] for r in rows] == ["`squares`", "a sphere", "64 spheres, one inside the other"]
    squares, sphere, spheres = (
        {k: float(v.replace(",", "")) for k, v in zip(head[1:], r[1:], strict=True)} for r in rows
    )
    # 10 x 10 pixels: those of the squares' four sides and of the diagonal, which all are left.
    assert (squares["triangles"], squares["pixels left"]) == (4, 36 + 8)
    assert squares["pixels decided"] == 256 - squares["pixels left"]
    assert squares["by integers"] == squares["pixels left"]
    assert sphere["triangles"] == 20 * 4**4 and spheres["triangles"] == 64 * 20 * 4
    assert 0 < squares["bound (median)"] < 1e-9
    for found in sphere, spheres:
        assert found["pixels decided"] + found["pixels left"] == 16 * 9
        assert found["pairs tested"] <= found["pixels computed"]
        assert (
            found["not dropped whole"] <= found["with a pixel in their box"] <= found["triangles"]
        )
    words = {"culling": "64: hidden by a sphere", "depth_bins": "depth of the nearest corner, m"}
    for name, some in words.items():
        drawn = (tmp_path / f"{name}.svg").read_text(encoding="utf-8")
        root = ElementTree.fromstring(drawn)
        assert len(drawn) <= 300_000 and root.get("viewBox").startswith("0 0 1920 ")
        assert some in {e.text for e in root.iter()}
        pictures = [e.get("href") for e in root.iter() if e.tag.endswith("image")]
        assert pictures and all(p.startswith("data:image/png;base64,") for p in pictures)
