"""The page as a file: whole in itself, escaped, packed without loss, and true to its schema."""

from __future__ import annotations

import base64
import hashlib
import json
import re
import zlib
from dataclasses import replace
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from reference_tracer.comparison.extras import extras
from reference_tracer.projections import PROJECTIONS
from reference_tracer.rendering import render
from reference_tracer.report import page
from reference_tracer.report.comparison import failure_written
from reference_tracer.report.comparison import write as write_folder
from reference_tracer.report.page import arrays
from reference_tracer.report.page.content import content
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

FOLDER = Path(page.__file__).parent
PROJECT = Path(__file__).resolve().parents[2]
DATA = re.compile(r'<script type="application/json" id="data">(.*?)</script>', re.DOTALL)
SCRIPT = re.compile(r"<script>(.*?)</script>", re.DOTALL)


def unpacked(held):
    """Undo arrays.packed, as the page's script does."""
    planes = zlib.decompress(base64.b64decode(held["data"]))
    kind = np.dtype(held["type"]).newbyteorder("<")
    sorted_ = np.frombuffer(planes, np.uint8).reshape(kind.itemsize, -1).T
    return np.ascontiguousarray(sorted_).reshape(-1).view(kind).reshape(held["shape"])


def schema(name):
    return json.loads((FOLDER / name).read_text(encoding="utf-8"))


def validator():
    """Return a validator of the page's JSON, which knows the comparison's, too."""
    from referencing import Registry, Resource

    registry = Registry().with_resources(
        (name, Resource.from_contents(schema(name))) for name in ("comparison.schema.json",)
    )
    own = schema("page.schema.json")
    return jsonschema.Draft202012Validator(own, registry=registry)


def whole(comparison):
    """Return all that a page can show."""
    return content(comparison, result_of(extras(comparison)))


@pytest.mark.parametrize("kind", ["uint8", "int32", "uint32", "uint64", "float32", "float64"])
@pytest.mark.parametrize("shape", [(0,), (1,), (7, 3), (2, 3, 4)])
def test_packing_loses_nothing(rng, kind, shape):
    values = rng.integers(0, 255, (*shape, np.dtype(kind).itemsize), np.uint8).view(kind)[..., 0]
    held = json.loads(json.dumps(arrays.packed(values)))
    assert held["type"] == kind
    assert np.array_equal(
        unpacked(held).view(np.uint8), np.ascontiguousarray(values).view(np.uint8)
    )


@pytest.mark.parametrize("projection", PROJECTIONS)
@pytest.mark.parametrize("float32", [False, True])
def test_surfaces_and_t_are_those_of_the_frame(room, projection, float32):
    scene = room(projection=projection, float32=float32)
    frame = render(scene)
    seen = arrays.seen(frame)
    hit = seen.number > 0
    assert np.array_equal(hit, frame.instance_index >= 0) and hit.any() and len(seen.instance) > 20
    assert np.array_equal(seen.instance[seen.number[hit] - 1], frame.instance_index[hit])
    assert np.array_equal(seen.triangle[seen.number[hit] - 1], frame.triangle_index[hit])
    held = {
        k: unpacked(v) for k, v in arrays.surface_table(scene, seen).items() if k != "instances"
    }
    assert held["vertices"].dtype == (np.float32 if float32 else np.float64)
    offsets = arrays.t_offsets(scene, frame, seen)
    assert (offsets < 1 << 13).all()  # twice the ulp: so near is the formula to the proven t
    assert (offsets != 0).any()


def test_a_page_is_one_file(differing, tmp_path):
    page.write(tmp_path / "page.html", differing)
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    outside = DATA.sub("", text)
    assert not re.search(
        r"https?://(?!www\.w3\.org/2000/svg\")|<link|<script src|@import|url\(", outside
    )
    assert "fetch(" not in outside and "XMLHttpRequest" not in outside
    assert "default-src 'none'" in outside


def test_only_the_pages_own_scripts_may_run(differing):
    text = page.html(content(differing))
    allowed = set(re.findall(r"'sha256-([^']+)'", text))
    found = {
        base64.b64encode(hashlib.sha256(s.encode()).digest()).decode() for s in SCRIPT.findall(text)
    }
    assert found == allowed and len(found) > 10


def test_no_name_ends_the_script(differing, hostile):
    held = content(differing)
    text = page.html(held)
    [data] = DATA.findall(text)
    assert not set("<>&") & set(data)
    assert json.loads(data) == json.loads(json.dumps(held))
    assert set(hostile) <= set(json.loads(data)["objects"])


def test_a_name_that_is_no_unicode(differing):
    held = content(differing) | {"objects": ["\ud800 lone"]}
    assert page.json_text(held).encode("utf-8")


def test_content_is_as_the_schema_says(differing, compared, room):
    only_a_plane = replace(room(), instances=(), meshes=())
    for comparison in (
        differing,
        compared(room(projection="orthographic", planes=False)),
        compared(room(projection="equirectangular")),
        compared(only_a_plane),
    ):
        held = json.loads(page.json_text(whole(comparison)))
        validator().validate(held)


def test_comparison_json_is_as_the_schema_says(differing, tmp_path):

    result_of(write_folder(tmp_path, differing))
    held = json.loads((tmp_path / "comparison.json").read_text(encoding="utf-8"))
    own = jsonschema.Draft202012Validator(schema("comparison.schema.json"))
    own.validate(held)
    for broken in (
        held | {"verdict": "fine"},
        held | {"verdict": "failed"},
        {k: v for k, v in held.items() if k != "pixels"},
    ):
        with pytest.raises(jsonschema.ValidationError):
            own.validate(broken)


def test_every_result_of_the_self_check_is_in_the_schema(differing):
    from reference_tracer.diagnosis.fault_rows import FaultRow

    rows = [
        FaultRow("a", "text", 5, 5, 5, 1),
        FaultRow("b", "text", 5, 5, 5, 0),
        FaultRow("c", "text", 5, 5, 5, 0, within_rounding=True),
        FaultRow("d", "text", note="there is nothing to get wrong"),
        FaultRow("e", "text", 5, 5, 5, 0, blind=True),
    ]
    results = [
        "caught",
        "missed",
        "within rounding",
        "cannot be seen here",
        "cannot be judged here",
    ]
    assert [row.result for row in rows] == results
    held = replace(differing, self_check=tuple(rows)).to_dict()
    own = jsonschema.Draft202012Validator(schema("comparison.schema.json"))
    own.validate(json.loads(page.json_text(held)))
    of_row = own.schema["$defs"]["compared"]["properties"]["self_check"]["items"]
    assert of_row["properties"]["result"]["enum"] == results
    held["self_check"][0]["result"] = "fine"
    with pytest.raises(jsonschema.ValidationError):
        own.validate(held)


def test_a_failure_is_as_the_schema_says(tmp_path):
    with pytest.raises(ValueError), failure_written(tmp_path):
        raise ValueError("no camera")
    held = json.loads((tmp_path / "comparison.json").read_text(encoding="utf-8"))
    own = jsonschema.Draft202012Validator(schema("comparison.schema.json"))
    own.validate(held)
    for broken in (
        held | {"verdict": "agree"},
        held | {"error": {"type": "ValueError"}},
        held | {"pixels": {}},
        {k: v for k, v in held.items() if k != "error"},
    ):
        with pytest.raises(jsonschema.ValidationError):
            own.validate(broken)


def test_what_does_not_fit_is_left_out_and_said(differing):
    whole_ = arrays.size(content(differing)["pixels"])
    held = content(differing, limit=whole_ - 1)
    assert held["pixels"]["colors"] is None and held["pixels"]["surfaces"]
    assert "linear colours" in " ".join(held["left_out"])
    held = content(differing, limit=0)
    assert held["pixels"]["surfaces"] is held["pixels"]["t_offset"] is None
    assert len(held["left_out"]) == 3
    validator().validate(json.loads(page.json_text(held)))


def test_extras_are_the_literal_picture_and_derivations(differing):
    found = result_of(extras(differing))
    literal = render(differing.scene, Settings("textbook_literal"))
    assert np.array_equal(found.literal, literal.color)
    examples = differing.counts.examples
    assert set(found.derivations) == {tuple(p) for some in examples.values() for p in some[:3]}
    assert found.trade is found.extremes is None and not found.left_out


def test_the_page_of_a_frame_says_that_it_has_no_literal_picture(differing):
    found = result_of(extras(differing, literal=False))
    assert found.literal is None and len(found.left_out) == 1
    assert found.derivations.keys() == result_of(extras(differing)).derivations.keys()
    held: Any = content(differing, found)
    pictures = {p["id"] for p in held["pictures"]}
    assert pictures == {"traced", "blender"}


def test_a_slow_textbook_is_not_traced_again(differing):
    from reference_tracer.comparison.methods import MethodRow

    slow = replace(differing, methods=(MethodRow("textbook", "float64", 1, 99.0, 0, 0),))
    found = result_of(extras(slow))
    assert found.literal is None and "99 s" in " ".join(found.left_out)


def test_a_cancelled_picture_has_a_page(room, compared):
    comparison = compared(room())
    comparison.frame.cancelled = True
    empty = Frame.empty(comparison.scene)
    comparison.frame.rows_done[:] = empty.rows_done
    held = content(comparison)
    assert held["comparison"]["verdict"] == "cancelled"
    validator().validate(json.loads(page.json_text(held)))


def test_the_pages_files_are_short():
    files = [p for p in FOLDER.iterdir() if p.suffix in (".py", ".js", ".css", ".html")]
    assert len(files) > 15
    for file in files:
        lines = file.read_text(encoding="utf-8").splitlines()
        assert len(lines) <= 250, file.name
        assert not any("</script" in line for line in lines if file.suffix == ".js"), file.name


def test_the_python_in_the_docs_reads_a_page(differing, tmp_path):
    docs = (PROJECT / "docs" / "page.md").read_text(encoding="utf-8")
    [code] = re.findall(r"```python\n(.*?)```", docs, re.DOTALL)
    page.write(tmp_path / "page.html", differing)
    names: dict = {}
    exec(code.replace("out/demo/page.html", str(tmp_path / "page.html")), names)
    where = differing.causes.cause != 0
    assert np.array_equal(names["cause"], differing.causes.cause[where])
