"""An errand takes as few files as CONTRIBUTING.md says: a record is added to a copy, and is seen.

Only the files that the errand names are changed in the copy; a Python of its own then looks at it.
"""

import re
import shutil
from pathlib import Path

import pytest

from .copied import ADDON, copied, run

CONTRIBUTING = (Path(__file__).parent.parent / "CONTRIBUTING.md").read_text(encoding="utf-8")

METHOD = {
    "tracer/triangle.py": (
        "def watertight(",
        "def never(rays, p1, p2, p3):\n"
        '    """Miss."""\n'
        "    hit, t, s = textbook(rays, p1, p2, p3)\n"
        "    return hit & False, t, s\n\n\n",
        "    Method.WATERTIGHT: watertight,",
        "    Method.NEVER: never,\n",
    ),
    "methods.py": (
        "    CERTIFIED = auto()",
        "    NEVER = auto()\n",
        "    Method.CERTIFIED: MethodRecord(",
        '    Method.NEVER: MethodRecord("Never", "never at all", "never", 77, "#123456", '
        '"Misses", "nothing"),\n',
    ),
}
SEES_METHOD = """
from reference_tracer.cli.arguments import add_settings
from reference_tracer.cli.parser import Parser
from reference_tracer.methods import MEASURED, Method
from reference_tracer.report import extreme_plots
from reference_tracer.study import tradeoff
parser = Parser()
add_settings(parser)
assert "never" in parser.format_help()
frame = render(scene, Settings("never", "float32"))
assert (frame.instance_index == -1).all()
assert (render(scene, Settings("textbook")).instance_index == 0).any()
assert {c.settings.method for c in tradeoff.choose(scene, 8, 1)} == set(MEASURED)
assert Method.NEVER in MEASURED and Method.NEVER in extreme_plots.SWEPT
try:
    Settings("none")
except ValueError as error:
    assert "never" in str(error)
else:
    raise AssertionError("'none' was taken")
from reference_tracer.derivation.derivation import derive
assert "never" in {str(a.method) for a in derive(scene, 4, 4).answers}
"""
SEES_METHOD_IN_BLENDER = """
from reference_tracer.blender.ui.choices import METHODS
assert ("never", "Never", "Misses", 77) in METHODS
"""
PASS = {
    "tracer/frame.py": (
        "    @property\n    def position(",
        "    @property\n    def twice(self):\n        return 2 * self.t\n\n",
        '    Pass("rows_done"),\n',
        '    Pass("twice", "Twice"),\n',
    ),
    "blender/ui/choices.py": (
        ")\n\n# Which export of the scene",
        '    ("Twice", "Twice", "Two times t", 0x400),\n',
    ),
}
SEES_PASS = """
frame = render(scene, Settings("textbook"))
assert np.array_equal(frame.passes()["twice"], 2 * frame.t)
"""
SEES_PASS_IN_BLENDER = """
from reference_tracer.blender.ui.choices import PASSES
assert PASSES[-1][:2] == ("Twice", "Twice")
"""
# The panorama's own: its file, and the lines that list it; without them nobody knows of it.
CAMERA_FILE = "projections/equirectangular.py"
CAMERA_LENS = "blender/reading/lenses.py"
CAMERA_RECORD = {
    "projections/__init__.py": {
        "from .equirectangular import Equirectangular\n": "",
        "EQUIRECTANGULAR = Equirectangular()\n": "",
        "(PERSPECTIVE, ORTHOGRAPHIC, EQUIRECTANGULAR)": "(PERSPECTIVE, ORTHOGRAPHIC)",
    },
    CAMERA_LENS: {
        "import EQUIRECTANGULAR, ": "import ",
        '    kind = {"type": "PANO", "panorama_type": "EQUIRECTANGULAR"}\n': "    kind = {}\n",
        '    Lens(EQUIRECTANGULAR, "EQUIRECTANGULAR", _ranges, _panorama),\n': "",
    },
}
SEES_NO_PANORAMA = """
from reference_tracer.projections import PROJECTIONS
assert list(PROJECTIONS) == ["perspective", "orthographic"]
assert np.isfinite(render(scene, Settings("certified")).t).any()
"""
SEES_PANORAMA = """
from dataclasses import replace
from reference_tracer.derivation.derivation import derive
from reference_tracer.derivation.writers import to_dict
from reference_tracer.projections import PROJECTIONS
from reference_tracer.files.scenes import load_scene, save_scene
new = replace(scene, camera=replace(scene.camera, projection=PROJECTIONS["equirectangular"]))
for method in ("textbook", "certified"):
    away = np.sqrt((render(new, Settings(method)).position ** 2).sum(axis=-1))
    t = render(new, Settings(method)).t
    assert np.isfinite(t).sum() > 20 and np.allclose(away[t < np.inf], t[t < np.inf])
save_scene("scene.npz", new)
assert load_scene("scene.npz").camera.projection == PROJECTIONS["equirectangular"]
derivation = derive(new, 4, 4)
assert "cos v" in str(derivation.camera)
assert to_dict(derivation)["camera"]["projection"] == "equirectangular"
"""
COLUMN = {
    "study/trade.py": (
        "    best_pixels: bool = False",
        "    hits: int = 0\n",
        ")\n\n\n@dataclass(frozen=True)\nclass Trade:",
        '    Column("hits", "hits", lambda r: f"{r.hits} hit", unit="pixels"),\n',
    ),
    "study/tradeoff.py": (
        '            "peak_bytes": peak,',
        '            "hits": int((frame.triangle_index >= 0).sum()),\n',
    ),
}
SEES_COLUMN = """
from reference_tracer.report import trade
from reference_tracer.study.tradeoff import measure
from reference_tracer.tracer.progress import result_of
found = result_of(measure(scene, 8, 1))
assert found.whole[-1].hits > 9
said = f"{found.whole[-1].hits} hit"
held = trade.to_dict(found)
assert held["units"]["hits"] == "pixels" and held["rows"][0]["hits"] == found.rows[0].hits
page = trade.text_cells(found)
assert "hits" in page["head"] and any(said in row for row in page["rows"])
assert " hits\\n" in trade.table(found) + "\\n" and said in trade.table(found)
assert f"hits {said}" in trade.page(found)
"""
CAUSE = {
    "causes/checks/comet.py": (
        "",
        "from ..cause import Cause\n\n"
        "COMET = Cause(\n"
        "    42, 'comet', 'comet', 'it passed {figure:.0f} km away (seen to {allowed:.0f} km)',\n"
        "    'km', (0.9, 0.8, 0.1), explains=True, warns=True,\n"
        ")\n\n\n"
        "def check(pixels):\n"
        "    white = (pixels.picture.color == 1).all(axis=-1)\n"
        "    pixels.give(pixels.open & white, COMET, 7.0, 9.0)\n"
        "    yield 1.0\n",
    ),
    "causes/explain.py": (
        "from .checks.edges import",
        "from .checks import comet\n",
        "    NOT_DECIDABLE,\n",
        "    comet.COMET,\n",
        "    (color.check, ",
        "    (comet.check, 1.0),\n",
    ),
}
FAULT = {
    "diagnosis/faults/picture.py": (
        '    Fault(\n        "row_off"',
        "    Fault('dark', 'there is no light', 'Lamps are off.', 'light it', "
        "recolored(lambda c: 0 * c), "
        "examples=(Example('dark', 'no light'),)),\n",
    ),
}
COMPARED = """
import json
from reference_tracer.causes.case import Case
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.pictures.picture import Picture
from reference_tracer.report.lines import describe
from reference_tracer.manifest import Manifest
from reference_tracer.tracer.progress import result_of
manifest = Manifest("a.blend", "Scene", "ViewLayer", 1, "FILE", "Camera")
color = render(scene, Settings()).color
case = Case(scene, manifest, Settings(), Picture(color))
"""
SEES_CAUSE = (
    COMPARED
    + """
from dataclasses import replace
from reference_tracer.report.comparison import cause_picture
from reference_tracer.report.page.content import content
color[3:5, 4:9] = 1
found = result_of(trace_and_compare(case))
pixels = found.counts
assert pixels.by_cause["comet"] == pixels.explained == pixels.differ == 8
assert pixels.unexplained == 0 and found.verdict == "warnings"
assert "  comet: 8, as at (4, 3)" in "\\n".join(describe(found))
held = json.loads(json.dumps(found.to_dict()))["causes"]["comet"]
assert held["number"] == 42 and held["unit"] == "km", held
assert (cause_picture(found)[3:5, 4:8, :3] == np.float32((0.9, 0.8, 0.1))).all()
[entry] = [c for c in content(found)["causes"] if c["name"] == "comet"]
assert entry["label"] == "Comet" and entry["pixels"] == 8 and entry["value"] == 42
assert found.why(4, 3) == "it passed 7 km away (seen to 9 km)"
"""
)
SEES_FAULT = (
    COMPARED
    + """
from dataclasses import replace
found = result_of(trace_and_compare(replace(case, self_check=True)))
[row] = [row for row in found.self_check if row.name == "dark"]
assert row.result == "caught"
assert "no light" in "\\n".join(describe(found))
assert "no light" in [row["text"] for row in found.to_dict()["self_check"]]
"""
)
COMMAND = {
    "cli/commands/count.py": (
        "",
        "from dataclasses import dataclass\n"
        "from pathlib import Path\n"
        "from ..camera_options import add_camera, choice_from\n"
        "from ..opening import SOURCES, load\n"
        "from ..parser import AGREE\n\n\n"
        "@dataclass(frozen=True)\n"
        "class CountOptions:\n"
        "    scene: Path\n"
        "    choice: object\n\n\n"
        "def add(parser):\n"
        "    def run(given):\n"
        "        return count(CountOptions(given.scene, choice_from(given, given.scene)))\n\n"
        "    parser.runs(run, 'reftrace count scene.npz')\n"
        "    parser.add_scene(SOURCES)\n"
        "    add_camera(parser)\n\n\n"
        "def count(options):\n"
        "    print('triangles:', load(options.scene, options.choice)[0].triangle_count)\n"
        "    return AGREE\n",
    ),
    "cli/commands/__init__.py": (
        "COMMANDS = {",
        "def _count():\n    from . import count\n\n    return count\n\n\n",
        '    "judge": Command(',
        '    "count": Command("count the triangles of a scene", _count),\n',
    ),
}
SEES_COMMAND = """
from contextlib import redirect_stdout
from io import StringIO
from reference_tracer.cli.main import main
from reference_tracer.files.scenes import save_scene
save_scene("scene.npz", scene)
with redirect_stdout(StringIO()) as said:
    assert main(["count", "scene.npz"]) == 0
    try:
        main(["--help"])
    except SystemExit:
        pass
assert "triangles: 1" in said.getvalue() and "count the triangles" in said.getvalue()
assert main(["count", "scene.npz", "--set", "frame=3"]) == 4
"""
SEES_COMMAND_IN_BLENDER = """
from contextlib import redirect_stdout
from io import StringIO
from reference_tracer.cli import in_blender
with redirect_stdout(StringIO()) as said:
    assert in_blender.run(["--help"]) == 0
assert "count the triangles" in said.getvalue()
"""
SCENE = """
import numpy as np
from reference_tracer.scene import Camera, Instance, Mesh, Scene, ViewWindow
from reference_tracer.rendering import render
from reference_tracer.tracer.settings import Settings
camera = Camera(np.eye(4), ViewWindow(-1, 1, -1, 1), 8, 8)
mesh = Mesh(np.array([[-9.0, -9, -5], [9, -9, -5], [0, 9, -5]]), [[0, 1, 2]])
scene = Scene(camera, (mesh,), (Instance(0, 0, np.eye(4)),), objects=("A",))
"""


def seen(tmp_path: Path, changes: dict, script: str) -> None:
    """Run a script beside a copy of the add-on to which the changes were made."""
    copy = copied(tmp_path)
    for name, parts in changes.items():
        file = copy / name
        whole = file.read_text(encoding="utf-8") if file.exists() else ""
        for before, text in zip(parts[::2], parts[1::2], strict=True):
            assert whole.count(before) == 1, name
            whole = whole.replace(before, text + before)
        file.write_text(whole, encoding="utf-8")
    done = run(tmp_path, SCENE + script)
    assert done.returncode == 0, done.stderr


def named(errand: str) -> set[str]:
    """The files of the add-on that CONTRIBUTING.md names for an errand."""
    [row] = re.findall(rf"^\| {errand} \|.*$", CONTRIBUTING, re.M)
    return set(re.findall(r"`addon/([^`]+)`", row))


def test_a_method_is_its_function_and_its_record(tmp_path):
    assert METHOD.keys() == named("an intersection method")
    seen(tmp_path, METHOD, SEES_METHOD)


def test_a_camera_type_is_a_file_and_a_record(tmp_path):
    """The panorama is taken out of the add-on, and put back: what Blender sets is its own errand.

    A type that Blender's cameras do not have needs no lens.
    """
    assert named("a camera's type") | {CAMERA_LENS} == {"projections/", *CAMERA_RECORD}
    assert named("Blender's cameras of such a type") == {CAMERA_LENS}
    copy = copied(tmp_path)
    (copy / CAMERA_FILE).unlink()
    for listed, lines in CAMERA_RECORD.items():
        without = (ADDON / listed).read_text(encoding="utf-8")
        for line, less in lines.items():
            assert without.count(line) == 1, line
            without = without.replace(line, less)
        (copy / listed).write_text(without, encoding="utf-8")
    naming = [
        str(file.relative_to(copy))
        for file in copy.rglob("*.*")
        if file.suffix in (".py", ".toml") and "equirectangular" in file.read_text("utf-8").lower()
    ]
    assert not naming
    done = run(tmp_path, SCENE + SEES_NO_PANORAMA)
    assert done.returncode == 0, done.stderr
    for file in {CAMERA_FILE, *CAMERA_RECORD} - {CAMERA_LENS}:
        shutil.copy(ADDON / file, copy / file)
    done = run(tmp_path, SCENE + SEES_PANORAMA)
    assert done.returncode == 0, done.stderr


def test_a_trades_column_is_its_field_and_its_record(tmp_path):
    """The tables, the JSON, the page, the plot and the check of a cluster's rows have it, too."""
    assert COLUMN.keys() == named("a trade's column")
    seen(tmp_path, COLUMN, SEES_COLUMN)


def test_a_pass_is_its_property_and_its_record(tmp_path):
    assert PASS.keys() == named("a pass")
    seen(tmp_path, PASS, SEES_PASS)


def test_a_cause_is_a_file_with_its_check_and_a_line_in_the_lists(tmp_path):
    files = {f.replace("comet.py", "") for f in CAUSE}
    assert files == named("a cause") and len(CAUSE) == 2
    seen(tmp_path, CAUSE, SEES_CAUSE)


def test_a_fault_is_its_record(tmp_path):
    assert FAULT.keys() == named("a fault")
    seen(tmp_path, FAULT, SEES_FAULT)


def test_a_command_is_its_file_and_its_record(tmp_path):
    files = {f.replace("count.py", "") for f in COMMAND}
    assert files == named("a command") and len(COMMAND) == 2
    seen(tmp_path, COMMAND, SEES_COMMAND)


@pytest.mark.blender
@pytest.mark.parametrize(
    ("changes", "script"),
    [
        (METHOD, SEES_METHOD_IN_BLENDER),
        (PASS, SEES_PASS_IN_BLENDER),
        (COMMAND, SEES_COMMAND_IN_BLENDER),
    ],
    ids=["method", "pass", "command"],
)
def test_blender_shows_a_new_record(tmp_path, changes, script):
    seen(tmp_path, changes, script)
