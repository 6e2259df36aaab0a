"""A worker that lies is found, and named; the command ends with an error, and writes nothing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import INPUT_ERROR
from reference_tracer.files.scenes import save_scene
from reference_tracer.rendering import render, steps
from reference_tracer.scene import Mesh
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.settings import Settings
from reference_tracer_cluster import pictures
from reference_tracer_cluster.cluster import ClusterError
from reference_tracer_cluster.connection import connected

from .conftest import dask

pytestmark = pytest.mark.slow

# A worker that lies: about which of its regions, and how, is told by a file.
FORGER = """
import os
from dataclasses import replace
from itertools import count
from pathlib import Path
from reference_tracer_cluster import claims, tasks
from reference_tracer_cluster.claims import Claim

honest, calls = Claim.__dict__.get("honest", Claim.of), count()  # a preload may be run twice
Claim.honest = honest

def forged(hits, statistics):
    claim = honest(hits, statistics)
    kind, each = Path(os.environ["FORGED"]).read_text().split(":")
    if next(calls) % int(each):
        return claim
    instance, triangle = claim.names
    if kind == "another owner":
        triangle ^= 1
    elif kind == "nothing":
        claim.names[:] = -1
    elif kind == "what is behind":
        instance[:] = 1
    elif kind == "certainty":
        hits.certainty[hits.certainty == 1] = 2
        claim = honest(hits, statistics)
    elif kind == "t":
        claim.known.values[0] *= 1 + 2.0**-52
    elif kind == "a barycentric":
        claim.known.values[2] *= 1 + 2.0**-52
    elif kind == "a tie":
        claim.ties.triangle[:] = (claim.ties.triangle + 2) % 128
    elif kind == "no such triangle":
        triangle[0] = 10**6
    elif kind == "another rounding":
        known = claim.known
        floats = replace(hits.measures, known=known.none())(known.ray, *claim.names[:, known.ray])
        assert (floats != known.values).any()
        known.values[:] = floats
    elif kind == "a tie far away":
        claim.ties.start[:] = 2**63 - 1
    elif kind == "a broken header":
        claim.packed = lambda: b"\\x93NUMPY\\x01\\x00\\x02\\x00(\\n"
    elif kind == "negative counts":
        claim.statistics.culling["left"] = -1
    elif kind == "endless counts":
        claim.statistics.stages["contest"] = float("inf")
    elif kind == "deep counts":
        told, claims.json.dumps = claims.json.dumps, lambda counts: "[" * 10**5
        data, claims.json.dumps = claim.packed(), told
        claim.packed = lambda: data
    elif kind == "no bytes":
        claim.packed = lambda: {"any": "thing"}
    return claim

Claim.of = staticmethod(forged)
"""
# Found whatever is asked for; or in places that are traced again.
AT_ONCE = "no such triangle", "a broken header", "no bytes", "a tie far away"
AT_ONCE += "negative counts", "endless counts", "deep counts"
AGAIN = "another owner", "nothing", "what is behind", "certainty"
# Of a hundredth of the pixels, which all places may miss.
ALL = "another rounding", "t", "a barycentric", "a tie"


def wall(distance: float, name: str) -> Mesh:
    """A wall that fills the view, in two triangles for each of 8 x 8 squares."""
    at = np.linspace(-1, 1, 9) * distance
    corners = np.array([(x, y, -distance) for y in at for x in at])
    first = np.array([9 * y + x for y in range(8) for x in range(8)])
    low, high = (first, first + 1, first + 10), (first, first + 10, first + 9)
    return Mesh(
        corners, np.stack((np.stack(low, 1), np.stack(high, 1)), 1).reshape(-1, 3), name=name
    )


@pytest.fixture(scope="module")
def walls(make):
    """A wall before another one, which every ray meets in the same triangle; many at its edge."""
    return make.scene(make.camera(120, 120), wall(2.0, "Near"), wall(4.0, "Far"))


@pytest.fixture(scope="module")
def forger(tmp_path_factory):
    """A scheduler with a worker that lies, that one's address, and how to tell it to."""
    folder = tmp_path_factory.mktemp("forger")
    (folder / "forger.py").write_text(FORGER)
    told = folder / "told"
    with dask(folder) as running:
        preload = "--preload", str(folder / "forger.py")
        yield running, running.work("forger", *preload, FORGED=str(told)), told.write_text


@pytest.fixture
def small_parts(monkeypatch):
    monkeypatch.setattr(pictures, "EACH", 40)


@pytest.mark.parametrize("kind", [*AT_ONCE, *AGAIN, *ALL])
def test_a_tenth_of_the_parts_is_forged(kind, forger, walls, small_parts):
    """The only worker: a hundredth of the picture, or all of it, is traced again here."""
    running, address, tell = forger
    tell(f"{kind}:10")
    said = "has answered what is no picture" if kind in AT_ONCE else "gave a wrong answer"
    share = None if kind in AT_ONCE else 1.0 if kind in ALL else 0.01
    with connected(running.address) as cluster:
        with pytest.raises(ClusterError, match=f"worker {address} {said}"):
            render(walls, tracer=pictures.tracer(cluster, share))


@pytest.mark.parametrize("kind", ["another owner", "nothing"])
def test_of_a_plain_method_it_is_found_too(kind, forger, walls):
    """An owner that is not met needs no share: t is found here."""
    running, address, tell = forger
    tell(f"{kind}:2")
    settings, share = Settings("watertight"), 0.01 if kind == "nothing" else None
    said = f"worker {address} gave a wrong answer"
    with connected(running.address) as cluster, pytest.raises(ClusterError, match=said):
        render(walls, settings, tracer=pictures.tracer(cluster, share))


@pytest.fixture(scope="module")
def honest(forger):
    """A second worker's address."""
    return forger[0].work("honest")


def test_of_two_workers_the_one_that_lies_is_named(forger, honest, walls, tmp_path, capsys):
    """As the command says it, which leaves nothing."""
    running, address, tell = forger
    tell("what is behind:1")
    save_scene(tmp_path / "walls.npz", walls)
    argv = ["trace", str(tmp_path / "walls.npz"), "--out", str(tmp_path / "new" / "picture.png")]
    assert main([*argv, "--scheduler", running.address, "--verify", "0.01"]) == INPUT_ERROR
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and f"worker {address} gave a wrong answer" in said
    assert honest not in said and not (tmp_path / "new").exists()


def test_who_says_the_truth_is_believed(forger, honest, walls):
    """Also where the only one that may say it again dies: then it is found here."""
    running, _, tell = forger
    tell("nothing at all:1")
    seen = walls.seen_by(replace(walls.camera, width=40, height=40, region=None))
    truth, frame = render(seen), Frame.empty(seen)
    with connected(running.address) as cluster:
        assert (render(seen, tracer=pictures.tracer(cluster, 0.1)).t == truth.t).all()
        for share in steps(seen, Settings(), frame, pictures.tracer(cluster, 1.0)):
            if share > 0.1 and "honest" in running.processes:
                running.end("honest")
    assert "honest" not in running.processes and (frame.t == truth.t).all()
