"""A render that fails says so to Blender: an error, no file, an exit code other than 0."""

from __future__ import annotations

import subprocess
import sys

import bpy
import pytest
from reference_tracer import rendering
from reference_tracer.blender import engine
from reference_tracer.scene import SceneError


def no_camera(scene):
    scene.camera = None


def panoramic(scene):
    scene.camera.data.type = "PANO"


def not_a_camera(scene):
    light = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    scene.collection.objects.link(light)
    scene.camera = light


def clip_range(scene):
    scene.camera.data.clip_start, scene.camera.data.clip_end = 5, 3


def flat_camera(scene):
    scene.camera.scale = (0, 1, 1)


def no_pixels(scene):
    scene.render.resolution_x, scene.render.resolution_percentage = 40, 1


def empty_border(scene):
    scene.render.use_border = True
    scene.render.border_min_x = scene.render.border_max_x = 0.5


def thin_border(scene):
    """Not empty, but it holds no pixel."""
    scene.render.use_border = True
    scene.render.border_min_x, scene.render.border_max_x = 0.501, 0.505


REFUSED = {  # what is wrong with the scene: what the message has to name
    no_camera: "Scene 'Scene' has no camera",
    panoramic: "Camera 'Camera' is of type fisheye",
    not_a_camera: "'Sun', the active camera of scene 'Scene', is a light",
    clip_range: "Camera 'Camera'.*clip start",
    flat_camera: "Camera 'Camera'.*scale",
    no_pixels: "The picture has 0 x 0 pixels",
    empty_border: "border",
    thin_border: "border",
}
WITH_NAME = pytest.mark.parametrize("fault", REFUSED, ids=lambda fault: fault.__name__)


@pytest.fixture
def scene(build, tmp_path):
    scene = build.scene()
    build.cube()
    build.camera()
    scene.render.engine = engine.ENGINE
    scene.render.filepath = str(tmp_path / "out" / "picture.png")
    return scene


@pytest.fixture
def no_file(tmp_path):
    yield
    assert list((tmp_path / "out").glob("*")) == []


@WITH_NAME
def test_rendering_it_fails_and_writes_no_file(fault, scene, no_file):
    fault(scene)
    with pytest.raises(RuntimeError, match="Error: "):
        bpy.ops.render.render(write_still=True)


@WITH_NAME
def test_comparing_it_names_what_is_wrong(fault, scene, compare):
    """Also where Blender itself would have refused with less."""
    fault(scene)
    with pytest.raises(SceneError, match=REFUSED[fault]):
        compare()
    with pytest.raises(RuntimeError, match=REFUSED[fault]):
        bpy.ops.reference_tracer.compare()


@pytest.mark.parametrize(
    "kind", [RuntimeError, KeyError, MemoryError, ZeroDivisionError, SceneError]
)
@pytest.mark.parametrize("where", ["blender.reading.export.export", "rendering.steps", "midway"])
def test_an_exception_fails_the_render(where, kind, scene, no_file, monkeypatch):
    real = rendering.steps

    def fail(*args, **options):
        raise kind("on purpose")

    def begin(*args, **options):
        yield next(iter(real(*args, **options)))
        fail()

    if where == "midway":
        monkeypatch.setattr(rendering, "steps", begin)
    else:
        monkeypatch.setattr(f"reference_tracer.{where}", fail)
    with pytest.raises(RuntimeError, match="on purpose"):
        bpy.ops.render.render(write_still=True)


LONG = pytest.mark.torture  # each is a Blender of its own
SCRIPT = """
import bpy, reference_tracer
reference_tracer.register()
scene = bpy.context.scene
scene.render.engine, scene.render.filepath = "REFERENCE_TRACER", {path!r}
scene.render.resolution_x, scene.render.resolution_y = 32, 18
{fault}
bpy.ops.render.render(write_still=True)
scene.render.engine = "CYCLES"  # 4.2 crashes at its end with an engine written in Python
reference_tracer.unregister()
"""


@pytest.mark.parametrize(
    ("fault", "message"),
    [
        ("", None),
        pytest.param("scene.camera.data.type = 'PANO'", "is of type fisheye", marks=LONG),
        pytest.param("scene.camera = None", "no camera", marks=LONG),
        ("from reference_tracer.blender.reading import export; export.export = None", "TypeError"),
    ],
    ids=["none", "panoramic", "no camera", "exporter"],
)
def test_a_script_ends_with_an_exit_code(fault, message, tmp_path):
    path = tmp_path / "picture.png"
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT.format(path=str(path), fault=fault)],
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert path.exists() == (message is None)
    assert (done.returncode == 0) == (message is None)
    assert message is None or message in done.stderr


LARGE = """
import bpy, reference_tracer, resource
reference_tracer.register()
scene = bpy.context.scene
scene.render.engine, scene.render.resolution_percentage = "REFERENCE_TRACER", 100
used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + (300 << 20),) * 2)
for size in (4096, 32767):
    scene.render.resolution_x = scene.render.resolution_y = size
    try:
        bpy.ops.render.render()
    except RuntimeError as error:
        print("refused:", error)
scene.render.engine = "CYCLES"
reference_tracer.unregister()
"""


@pytest.mark.skipif(sys.platform != "linux", reason="asks Linux for a limit")
def test_a_picture_that_does_not_fit_is_refused_in_words():
    """Whether that is known before the work, or found out: 4096² take 0.9 GiB, 300 MiB are left."""
    done = subprocess.run([sys.executable, "-c", LARGE], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    refused = [line for line in done.stdout.splitlines() if line.startswith("refused: Error: ")]
    assert len(refused) == 2
    for line in refused:
        assert line.count("choose a smaller size") == 1 and "failed" not in line
    assert "32767 x 32767 pixels" in refused[1]
    assert "Traceback" not in done.stdout + done.stderr
