"""What `make bench` runs, on a picture of a few pixels."""

import json
import subprocess
import sys
from pathlib import Path

PROJECT = Path(__file__).parent.parent


def test_certified(tmp_path: Path):
    script = PROJECT / "benchmarks" / "certified.py"
    options = ["suzanne", "--width", "24", "--repeats", "2", "--out", tmp_path]
    done = subprocess.run([sys.executable, script, *options], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    [scene] = json.loads((tmp_path / "certified.json").read_text(encoding="utf-8"))["scenes"]
    assert (scene["scene"], scene["width"], scene["triangles"]) == ("suzanne", 24, 20530)
    assert scene["methods"]["moller_trumbore"]["ratio"] == 1
    found = scene["methods"]["certified"]
    assert 0 < found["ratio_least"] <= found["ratio"] <= found["ratio_most"]
    assert "certified" in done.stdout and "error bound" in done.stdout
