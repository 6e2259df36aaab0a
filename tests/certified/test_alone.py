"""Small pictures and single rays see what the definition says: arrays of one ray look shared."""

from __future__ import annotations

import numpy as np
from reference_tracer.certified.any_rays import nearest_hits
from reference_tracer.certified.definition import definition, seen_by
from reference_tracer.certified.plain import plain
from reference_tracer.rendering import trace
from reference_tracer.tracer.hits import Hits, Statistics
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from ..alone import EACH, SIZES, by_pixel, is_same, rays_of, small

MEMORY = 1 << 26


def agrees(hits: Hits, definition) -> bool:
    """Return whether hits are what the definition says: surface, t and ties."""
    names = list(zip(hits.instance.tolist(), hits.triangle.tolist(), strict=True))
    found = [(*each, hits.ties.get(k)) for k, each in enumerate(zip(names, hits.t, strict=True))]
    return found == [(s.name, s.t, s.ties or None) for s in definition]


@EACH
def test_pictures_and_their_rays(seed, projection, make):
    ties = 0
    for size in SIZES:
        scene = small(make, seed, projection, size)
        region, clip = scene.camera.region, (scene.camera.clip_start, scene.camera.clip_end)
        hits = trace(scene, Settings("certified"))
        unswept = result_of(plain(scene, region, MEMORY))
        assert agrees(hits, definition(scene)) and agrees(unswept, definition(scene))
        ties += len(hits.ties)
        for k, one in enumerate(by_pixel(scene)):
            if size == (1, 1):
                assert is_same(unswept, hits, k)
            assert agrees(result_of(plain(one, one.camera.region, MEMORY)), definition(one))
        for rays in rays_of(scene):
            for culled in (True, False):
                many = result_of(nearest_hits(scene, rays, clip, Statistics(), culled))
                assert agrees(many, seen_by(scene, rays, clip))
                for k in range(rays.count):
                    one = rays.take(np.array([k]))
                    alone = result_of(nearest_hits(scene, one, clip, Statistics(), culled))
                    assert agrees(alone, seen_by(scene, one, clip))
                    shared = rays.one_origin or rays.one_direction
                    assert is_same(alone, many, k, exactly=not shared), (size, k, culled)
    assert ties or seed != 3
