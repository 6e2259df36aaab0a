"""The page's numbers in a real browser: the tracer's own, bit for bit."""

from __future__ import annotations

import base64
import struct
from itertools import product

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.projections import PROJECTIONS
from reference_tracer.report.page import arrays
from reference_tracer.tracer import plane
from reference_tracer.tracer.camera import Rays, camera_rays, film_positions
from reference_tracer.tracer.triangle import TESTS
from reference_tracer.tracer.world import world_corners

pytestmark = pytest.mark.browser

FLOATS = "float64", "float32"

# All pixels with the surface that each sees: t, s1, s2, s3, whether literal and repaired accept it.
DERIVE_ALL = """precision => {
  const [width, height] = referenceTracer.page.size, out = [];
  for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) {
    const r = referenceTracer.derive(x, y, precision);
    const accepted = [r.literal, r.textbook].map(Number);
    out.push(r.t ?? NaN, ...(r.s ?? [NaN, NaN, NaN]), ...accepted.map(a => a || 0));
  }
  const bytes = new Uint8Array(new Float64Array(out).buffer);
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
}"""


def expected_bits(comparison, dtype):
    """The same numbers by the tracer's own formulas, (h * w, 6) float64."""
    scene, frame = comparison.scene, comparison.frame
    camera, count = scene.camera, len(scene.instances)
    pixel = np.arange(frame.t.size)
    rays = camera_rays(camera, *film_positions(camera.region, pixel=pixel), dtype)
    rays = Rays(*(np.broadcast_to(v, (3, len(pixel))) for v in (rays.origins, rays.directions)))
    out = np.zeros((len(pixel), 6))
    out[:, :4] = np.nan
    instance, triangle = frame.instance_index.ravel(), frame.triangle_index.ravel()
    mesh = np.flatnonzero((instance >= 0) & (instance < count))
    corners = world_corners(scene, instance[mesh], triangle[mesh]).astype(dtype)
    for column, method in ((4, Method.TEXTBOOK_LITERAL), (5, Method.TEXTBOOK)):
        hit, t, s = TESTS[method](rays.take(mesh), *corners)
        out[mesh, 0], out[mesh, 1:4], out[mesh, column] = t, s.T, hit
    for k, infinite in enumerate(scene.planes):
        flat = np.flatnonzero(instance == count + k)
        point, normal = (v[:, None].astype(dtype) for v in (infinite.point, infinite.normal))
        out[flat, 0] = plane.intersect(rays.take(flat), point, normal)
    return out


@pytest.mark.parametrize(
    ("precision", "projection", "stored"),
    [
        # Every day each value of each once.
        pytest.param(*way, marks=() if n in (0, 5, 9) else pytest.mark.torture)
        for n, way in enumerate(product(FLOATS, PROJECTIONS, FLOATS))
    ],
)
def test_derivations_have_the_tracers_bits(show, room, compared, precision, projection, stored):
    comparison = compared(room(projection=projection, float32=stored == "float32"))
    tab = show(comparison)
    found = np.frombuffer(base64.b64decode(tab.evaluate(DERIVE_ALL, precision)))
    expected = expected_bits(comparison, np.dtype(precision))
    assert np.isfinite(expected[:, 1]).sum() > 400 and np.isfinite(expected[:, 0]).sum() > 700
    literal, textbook = expected[:, 4].sum(), expected[:, 5].sum()
    assert 0 < literal < 0.8 * textbook  # the erratum is seen
    assert np.array_equal(found.reshape(-1, 6).view(np.int64), expected.view(np.int64)) or (
        np.array_equal(found.reshape(-1, 6), expected, equal_nan=True)
    )


@pytest.mark.parametrize("projection", PROJECTIONS)
def test_the_traced_t_is_there_to_the_last_bit(show, room, compared, projection):
    comparison = compared(room(projection=projection))
    tab = show(comparison)
    height, width = comparison.frame.t.shape
    found = tab.evaluate(
        """([w, h]) => Array.from({ length: w * h }, (_, i) => {
          const b = new DataView(new ArrayBuffer(8));
          b.setFloat64(0, referenceTracer.tracedT(i % w, Math.floor(i / w)));
          return b.getBigUint64(0).toString(16).padStart(16, "0");
        })""",
        [width, height],
    )
    expected = [struct.pack(">d", t).hex() for t in comparison.frame.t.ravel()]
    assert found == expected
    assert (
        arrays.t_offsets(comparison.scene, comparison.frame, arrays.seen(comparison.frame))
    ).any()


def test_the_derivation_shows_its_numbers(show, differing):
    tab = show(differing, "#x=40&y=30")  # an example: derived exactly, too
    assert tab.locator("#fragment > details").count() == 1
    assert "exact" in tab.locator("#fragment").inner_html()
    y, x = np.argwhere(differing.frame.triangle_index > 9)[0].tolist()
    tab.evaluate("([x, y]) => select(x, y)", [x, y])
    assert tab.locator("#fragment details").count() == 0
    text = tab.locator("#derivation").inner_text()
    result = tab.evaluate("([x, y]) => referenceTracer.derive(x, y)", [x, y])
    for value in (*result["ray"]["direction"], *result["n"], result["t"]):
        assert repr(value).replace("-", "−") in text
    assert "float32" in text and "hit" in text and "errata" in text
    proven = tab.locator("#facts").inner_text()
    assert "proven: the exact value, rounded once" in proven
    assert "textbook’s formula in float64" in text and "same bits as the tracer's" not in text
    rows = tab.locator("#derivation table").first.locator("tbody tr")
    assert rows.count() > 1 and "it is what is seen" in rows.first.inner_text()
    rows.nth(1).locator("button").click()
    assert tab.locator("#derivation .pick").nth(1).get_attribute("aria-pressed") == "true"


def test_a_ray_that_meets_nothing(show, room, compared):
    comparison = compared(room(planes=False))
    y, x = np.argwhere(comparison.frame.instance_index < 0)[0].tolist()
    tab = show(comparison, f"#x={x}&y={y}")
    assert "nothing" in tab.locator("#sides").inner_text()
    assert tab.evaluate("([x, y]) => referenceTracer.tracedT(x, y)", [x, y]) == float("inf")
    assert tab.locator("#derivation").inner_text()


def test_numbers_are_written_as_python_does(show, differing, rng):
    tab = show(differing)
    values = [0.0, 1.0, 9.9999, 0.1, 1e22, 123456.7, 0.00012345, *(10 ** rng.uniform(-30, 30, 200))]
    for digits in (1, 3, 6):
        found = tab.evaluate("([v, d]) => v.map(x => general(x, d))", [values, digits])
        expected = [f"{v:.{digits}g}".replace("-", "−") for v in values]
        assert found == expected
    filled = tab.evaluate(
        "s => filled(s, { figure: 0.00192, allowed: 64 })",
        "{figure:.3g} of {allowed:.0f}, {allowed}",
    )
    assert filled == f"{0.00192:.3g} of {64:.0f}, {64}"
    small = rng.integers(0x00800000, 0x7F000000, 500).astype(np.uint32).view(np.float32)
    written = tab.evaluate("v => v.map(x => shortest(x, 'float32'))", small.astype(float).tolist())
    read = [np.float32(text.replace("−", "-")) for text in written]
    assert read == list(small)
    assert all(len(w.split("e")[0].replace(".", "").strip("0")) <= 9 for w in written)
