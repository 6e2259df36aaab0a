"""What `make release` writes: the same bytes in two clones, whole, and of use as it is."""

from __future__ import annotations

import hashlib
import json
import os
import re
import runpy
import shutil
import subprocess
import sys
import tarfile
import threading
import zipfile
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest
import trimesh
from reference_tracer.cli.opening import PYTHONS
from reference_tracer.cli.parser import INPUT_ERROR

from . import others

pytestmark = [pytest.mark.blender, pytest.mark.slow]

PROJECT = Path(__file__).parent.parent
# By the folder that each stands in.
PACKAGES = dict(
    re.findall(r'"([\w/]+)": "(reference_tracer\w*)"', (PROJECT / "setup.py").read_text())
)
# Runs in a Blender of its own what `blender --online-mode --command extension` does (README.md).
INSTALL = """
import sys
import bpy

bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
from bl_pkg.bl_extension_cli import cli_extension_handler

bpy.context.preferences.system.use_online_access = True
name = "reference_tracer"
assert cli_extension_handler(["repo-remove", "blender_org"]) == 0
assert cli_extension_handler(["repo-add", "--url", sys.argv[1], name]) == 0
assert cli_extension_handler(["install", "--sync", "--enable", name]) == 0
bpy.context.scene.render.engine = "REFERENCE_TRACER"
print("installed by address", flush=True)
"""

# Of every day: the oldest and the newest.
DAILY = others.NAMES[0], others.NAMES[-1]
ALONE = [
    name if name in DAILY else pytest.param(name, marks=pytest.mark.torture)
    for name in dict.fromkeys((*others.NAMES, others.OWN))
]


def run(*command: object, **options) -> subprocess.CompletedProcess[str]:
    options = {"capture_output": True, "text": True} | options
    return subprocess.run([str(word) for word in command], check=False, **options)


def git(folder: Path, *arguments: object) -> str:
    done = run("git", "-C", folder, "-c", "user.name=n", "-c", "user.email=e", *arguments)
    assert done.returncode == 0, done.stderr
    return done.stdout


def released(clone: Path, umask: int, *options: str, **environment: str) -> Path:
    """Make the release in a clone; returns its folder."""
    if (PROJECT / "wheels").exists():  # else it is fetched
        shutil.copytree(PROJECT / "wheels", clone / "wheels")
    command = sys.executable, clone / "tools/release.py", *options
    done = run(*command, env=os.environ | environment, umask=umask)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "release: the address is still https://example.org/" in done.stderr
    return clone / "dist/release"


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A clone that has committed what this folder holds now."""
    clone = tmp_path_factory.mktemp("clone")
    for name in git(PROJECT, "ls-files", "-z", "-co", "--exclude-standard").split("\0"):
        if (PROJECT / name).is_file():
            (clone / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(PROJECT / name, clone / name)
    git(clone, "init", "--quiet")
    git(clone, "add", "--all")
    git(clone, "commit", "--quiet", "--message", "all")
    return clone


@pytest.fixture(scope="module")
def release(clone: Path) -> Path:
    return released(clone, 0o022, TZ="UTC")


@pytest.mark.torture
def test_two_clones_release_the_same_bytes(clone: Path, release: Path, tmp_path: Path):
    git(tmp_path, "clone", "--quiet", clone, "another place")
    place, environment = tmp_path / "another place", {"TZ": "Asia/Tokyo", "PYTHONHASHSEED": "1"}
    again = released(place, 0o077, "--no-try", **environment)
    first, second = ({p.name: p.read_bytes() for p in f.iterdir()} for f in (release, again))
    assert first.pop("try.html")  # it says how long it took
    assert [name for name in first | second if first.get(name) != second.get(name)] == []


def test_the_release_is_whole_and_its_sums_are_right(release: Path):
    first = {p.name: p.read_bytes() for p in release.iterdir()}
    assert b"the focal length is +5.7" in first.pop("try.html")
    assert len(first) == 7
    sums = dict(reversed(line.split()) for line in first.pop("SHA256SUMS").decode().splitlines())
    assert sums == {name: hashlib.sha256(data).hexdigest() for name, data in first.items()}


def test_what_is_not_committed_is_refused(clone: Path, tmp_path: Path):
    git(tmp_path, "clone", "--quiet", clone, "changed")
    (tmp_path / "changed/new").touch()
    refused = run(sys.executable, tmp_path / "changed/tools/release.py")
    assert refused.returncode == 1 and "not committed" in refused.stderr
    assert "?? new" in refused.stderr


def test_its_page_needs_only_what_is_beside_it(release: Path):
    page = (release / "index.html").read_text(encoding="utf-8")
    links = set(re.findall(r'(?:href|src)="([^"]+)"', page))
    beside = {n.partition("?")[0] for n in links if not n.startswith(("https://", "data:"))}
    beside = {name.removeprefix("./") for name in beside}
    assert {"try.html", "NOTES.md", "index.json", "SHA256SUMS"} < beside
    assert beside <= {path.name for path in release.iterdir()}
    for sum_, name in re.findall(r"([0-9a-f]{64})  ([\w.-]+)", page):
        assert hashlib.sha256((release / name).read_bytes()).hexdigest() == sum_
        beside.discard(name)
    assert not {name for name in beside if name.endswith((".zip", ".whl"))}
    assert "{{" not in page and "${" not in page
    assert "](docs/" not in (release / "NOTES.md").read_text(encoding="utf-8")


def test_it_takes_the_lesson_pack_of_its_commit(script, monkeypatch, tmp_path: Path):
    """With what is released in the place of what was there; and of no other commit."""
    work, out, pack = (tmp_path / name for name in ("work", "out", "dist/lessons"))
    for folder in (work, out, pack):
        folder.mkdir(parents=True)
    (pack / "index.html").write_text("lessons")
    for name in ("tracer-1.0.zip", "tracer-1.0-py3-none-any.whl"):
        (pack / name).write_text("built before")
        (out / name).write_text("released")
    wheel = pack / "lite/pypi/tracer-1.0-py3-none-any.whl"
    wheel.parent.mkdir(parents=True)
    wheel.write_text("built before")

    def digest(content, kind="sha256"):
        return hashlib.new(kind, content).hexdigest()

    kinds = "md5", "sha256"
    listed = {"digests": {kind: digest(b"built before", kind) for kind in kinds}, "size": 12}
    index, settings = wheel.with_name("all.json"), pack / "lite/jupyter-lite.json"
    index.write_text(json.dumps(listed))
    settings.write_text(f"./pypi/all.json?sha256={digest(index.read_bytes())}")
    names = script["lesson_pack"].__globals__
    monkeypatch.setitem(names, "PROJECT", tmp_path)
    monkeypatch.setitem(names, "git", lambda *_: b"this\n")
    for commit in ("", "another\n"):
        (pack / "commit.txt").write_text(commit)
        assert script["lesson_pack"](work, out) == []
    (pack / "commit.txt").write_bytes(b"this\n")
    [path] = script["lesson_pack"](work, out)
    assert path.name == "tracer-1.0-lessons.zip" and path.parent == work
    with zipfile.ZipFile(path) as packed:
        assert packed.read("index.html") == b"lessons"
        assert packed.read("tracer-1.0.zip") == b"released"
        assert packed.read(str(wheel.relative_to(pack))) == b"released"
        listing, pointing = (packed.read(str(p.relative_to(pack))) for p in (index, settings))
    released = {"digests": {kind: digest(b"released", kind) for kind in kinds}, "size": 8}
    assert json.loads(listing) == released
    assert pointing.decode().endswith(digest(listing))


def test_an_address_takes_the_place_of_the_placeholder(script, clone: Path, tmp_path: Path):
    holder, names = script["PLACEHOLDER"], script["ADDRESSED"]
    assert set(git(clone, "grep", "-l", holder, "--", ".", ":!t*").split()) == set(names)
    for name in names:
        shutil.copy(clone / name, tmp_path)
    script["addressed"](tmp_path, "https://forge.example:8443/us/tracer.py")
    for name in names:
        text = (tmp_path / name).read_text(encoding="utf-8")
        assert "https://forge.example:8443/us/tracer.py" in text and holder not in text
    for wrong in ("forge.example/us", "https://forge.example/us/", 'https://a/"', "https://"):
        with pytest.raises(script["BuildError"], match="ADDRESS"):
            script["addressed"](tmp_path, wrong)


def test_documents_name_its_files(release: Path):
    texts = [
        (PROJECT / name).read_text(encoding="utf-8") for name in ("README.md", "CONTRIBUTING.md")
    ]
    named = set(re.findall(r"reference_tracer-\d[\w.-]+\.\w+", "".join(texts)))
    assert named and named <= {path.name for path in release.iterdir()}


def test_workflow_runs_what_the_makefile_has():
    workflow = (PROJECT / ".github/workflows/release.yml").read_text(encoding="utf-8")
    makefile = (PROJECT / "Makefile").read_text(encoding="utf-8")
    made = re.findall(r"\bmake (?:\w+=\w+ )?([a-z -]+?)(?: [A-Z]+=.*)?$", workflow, re.M)
    run = " ".join(made).split()
    assert {"test", "check", "release"} <= set(run)
    assert set(run) <= set(re.findall(r"^([a-z-]+):", makefile, re.M))


def test_package_is_all_of_the_code_and_nothing_else(clone: Path, release: Path):
    code = git(clone, "ls-files", *PACKAGES).split()
    [wheel], [sdist] = release.glob("*.whl"), release.glob("*.tar.gz")
    names = {n for n in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in n}
    tops = {name: next(top for top in PACKAGES if name.startswith(f"{top}/")) for name in code}
    assert names == {name.replace(top, PACKAGES[top], 1) for name, top in tops.items()}

    with tarfile.open(sdist) as file:
        names = {m.name.partition("/")[2] for m in file if m.isfile()}
    made = {name for name in names if name.startswith("reference_tracer.egg-info/")}
    top = {"CHANGELOG.md", "LICENSE", "MANIFEST.in", "README.md", "pyproject.toml", "setup.py"}
    assert names - made == {*code, *top, "PKG-INFO", "setup.cfg"}


@pytest.mark.parametrize("name", ALONE)
def test_wheel_is_of_use_alone(name: str, release: Path, tmp_path: Path):
    """It has numpy and trimesh of an environment, and nothing of this project but the wheel."""
    base = others.python(name)
    assert run(base, "-m", "venv", "--without-pip", tmp_path / "venv").returncode == 0
    [wheel] = release.glob("*.whl")
    [python] = (tmp_path / "venv").glob("*/python")
    library = run(base, "-c", "import trimesh; print(trimesh.__path__[0])").stdout.strip()
    site = run(
        python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"
    ).stdout.strip()
    for part in (p for name in ("numpy", "trimesh") for p in Path(library, "..").glob(f"{name}*")):
        Path(site, part.name).symlink_to(part.resolve())
    pip = run(sys.executable, "-m", "pip", "--python", python, "install", "--no-index", wheel)
    assert pip.returncode == 0, pip.stderr

    def reftrace(*words: object, code: int = 0) -> str:
        env = {"PATH": os.environ["PATH"], "PYTHONWARNINGS": "error,ignore::ResourceWarning"}
        done = run(python.with_name("reftrace"), *words, cwd=tmp_path, env=env)
        assert done.returncode == code, done.stderr
        return done.stdout + done.stderr

    assert reftrace("--version").split()[-1] in wheel.name
    size = "--set", "width=48", "height=32"
    ball = trimesh.creation.icosphere(2)
    for suffix in ("obj", "glb"):
        ball.export(tmp_path / f"ball.{suffix}")
        reftrace("trace", f"ball.{suffix}", *size, "--out", f"{suffix}.png")
    stored = Path(site, "reference_tracer_grading/scenes/exercise_triangle.npz")
    reftrace("trace", stored, "--out", "stored.png")
    reftrace("compare", "ball.obj", *size, "--against", "obj.png", "--out", "compared")
    assert (tmp_path / "compared" / "page.html").exists()
    blend = PROJECT / "sample_scenes/suzanne.blend"
    said = reftrace("trace", blend, "--out", "x.png", code=INPUT_ERROR)
    version = name.partition("-")[0]
    if version in PYTHONS:
        assert 'module: pip install "reference_tracer[blender]"' in said
    else:
        assert f"made for Python 3.11 and 3.13 and not for {version}: python3.13 -m pip" in said
    exr = reftrace("trace", "ball.obj", *size, "--out", "ball.exr", code=INPUT_ERROR)
    assert 'pip install "reference_tracer[images]"' in exr


def test_blender_installs_it_by_address(release: Path, tmp_path: Path):
    class Handler(SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), partial(Handler, directory=release)) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        done = run(
            sys.executable,
            "-c",
            INSTALL,
            f"http://127.0.0.1:{server.server_port}/index.json",
            env=os.environ | {"BLENDER_USER_RESOURCES": str(tmp_path)},
            cwd=tmp_path,
        )
        server.shutdown()
    assert "installed by address" in done.stdout, done.stdout + done.stderr
    assert "Traceback" not in done.stdout + done.stderr


MANIFEST = 'version = "1.2.3"'
CHANGELOG = "# Changelog\n\n## 1.2.3 (2026-12-01)\n\nNew.\n\n## 1.2.2 (2026-11-01)\n\nOld.\n"


@pytest.fixture
def script(monkeypatch: pytest.MonkeyPatch) -> dict:
    monkeypatch.syspath_prepend(PROJECT / "tools")
    return runpy.run_path(str(PROJECT / "tools/release.py"))


def test_notes_are_the_newest_section(script):
    assert script["newest"](CHANGELOG) == ("1.2.3", "2026-12-01", "New.\n")


@pytest.mark.parametrize(
    ("status", "tags", "changelog", "complaint"),
    [
        ("", ["v1.2.3"], CHANGELOG, None),
        ("", [], CHANGELOG.replace("2026-12-01", "unreleased"), None),
        (" M addon/scene.py", [], CHANGELOG, "addon/scene.py"),
        ("", [], CHANGELOG.replace("1.2.3", "1.3.0"), "1.3.0 is the newest"),
        ("", ["v1.2.2"], CHANGELOG, "tag is v1.2.2"),
        ("", ["v1.2.3"], CHANGELOG.replace("2026-12-01", "unreleased"), "is unreleased"),
    ],
)
def test_what_is_refused(script, status, tags, changelog, complaint):
    if complaint is None:
        script["check"](status, tags, MANIFEST, changelog)
    else:
        with pytest.raises(script["BuildError"], match=complaint):
            script["check"](status, tags, MANIFEST, changelog)
