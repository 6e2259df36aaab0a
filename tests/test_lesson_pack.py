"""The lesson pack of `make lessons`: whole, printable, and its notebooks run in Chromium."""

from __future__ import annotations

import hashlib
import json
import re
import runpy
import shutil
import subprocess
import sys
import tarfile
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

pytestmark = [pytest.mark.torture, pytest.mark.browser]

PROJECT = Path(__file__).parent.parent
NOTEBOOKS = PROJECT / "docs" / "lessons" / "notebooks"
NAMES = "constant_shading", "perspective_camera", "plane", "triangle"
KERNEL = "ipython", "jedi", "micropip"  # what a notebook's kernel loads of Pyodide
TYPES = {".mjs": "text/javascript", ".wasm": "application/wasm", ".json": "application/json"}


@pytest.fixture(scope="module")
def pack(tmp_path_factory):
    import make_lessons

    make_lessons.run(PROJECT / "tools" / "build_extension.py")
    out = tmp_path_factory.mktemp("pack") / "lessons"
    make_lessons.build(out, None)
    return out


@pytest.fixture(scope="module")
def pyodide(tmp_path_factory):
    """Pyodide's files by their names, as its public address has them, but for compiled packages.

    npm has its core, PyPI what is plain Python.
    """
    from jupyterlite_pyodide_kernel.constants import PYODIDE_VERSION

    folder = tmp_path_factory.mktemp("pyodide")
    fetch = ["npm", "pack", "--silent", f"pyodide@{PYODIDE_VERSION}"]
    subprocess.run(fetch, cwd=folder, check=True)
    with tarfile.open(folder / f"pyodide-{PYODIDE_VERSION}.tgz") as archive:
        archive.extractall(folder, filter="data")
    core = folder / "package"
    lock = json.loads((core / "pyodide-lock.json").read_text("utf-8"))
    needed: dict[str, dict] = {}
    todo = list(KERNEL)
    while todo:
        name = todo.pop().replace("_", "-")
        if name not in needed:
            needed[name] = lock["packages"][name]
            todo += needed[name]["depends"]
    wheels = [f"{name}=={of['version']}" for name, of in needed.items()]
    download = ["-m", "pip", "download", "--quiet", "--no-deps", "--dest", core, *wheels]
    subprocess.run([sys.executable, *download], check=True)
    for of in needed.values():  # Pyodide packs them anew, without their tests
        of["sha256"] = hashlib.sha256((core / of["file_name"]).read_bytes()).hexdigest()
    (core / "pyodide-lock.json").write_text(json.dumps(lock), "utf-8")
    return {path.name: path for path in core.iterdir()}


def test_every_link_leads_into_the_pack(pack):
    pages = [p for p in pack.rglob("*.html") if "lite" not in p.relative_to(pack).parts]
    assert len(pages) > 40
    for page in pages:
        for link in re.findall(r'(?:href|src)="([^"#:]+)(?:#[^"]*)?"', page.read_text("utf-8")):
            assert (page.parent / link).exists(), (page.name, link)


def test_it_has_what_a_lecturer_needs(pack):
    lessons = pack / "lessons"
    for kind in ("slides", "plans", "worksheets", "solutions"):
        for name in NAMES:
            for folder in (lessons, lessons / "de"):
                assert (folder / kind / f"{name}.html").stat().st_size > 1500
                printed = (folder / kind / f"{name}.pdf").read_bytes()
                assert printed.startswith(b"%PDF") and len(printed) > 10_000
    assert 'href="lessons/de/README.html"' in (pack / "index.html").read_text("utf-8")
    german = (lessons / "de" / "worksheets" / "plane.html").read_text("utf-8")
    assert '<html lang="de">' in german and '<a href="../README.html">Lektionen</a>' in german
    slides = (lessons / "slides" / "triangle.html").read_text("utf-8")
    assert slides.count("<section") >= 6 and "literal_share" not in slides
    assert {p.name for p in (pack / "scenes").iterdir()} == {
        f"exercise_{name}.{kind}"
        for name in ("orthographic", "perspective", "plane", "triangle")
        for kind in ("blend", "npz")
    }
    assert list(pack.glob("reference_tracer-*.zip")) and list(pack.glob("reference_tracer-*.whl"))


class _Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def tried(pack, pyodide):
    """Run a notebook in Chromium: its name -> what it prints, and what could not be fetched."""
    from documents import browser

    serve = partial(_Quiet, directory=pack)
    with ThreadingHTTPServer(("127.0.0.1", 0), serve) as server, browser.opened() as opened:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        address = f"http://127.0.0.1:{server.server_port}/"

        def run(name):
            missing = []

            def answer(route):
                url = route.request.url
                path = pyodide.get(url.rpartition("/")[2]) if "/pyodide/v" in url else None
                if url.startswith(address):
                    route.continue_()
                elif path:
                    kind = TYPES.get(path.suffix, "application/octet-stream")
                    allowed = {"Access-Control-Allow-Origin": "*"}
                    route.fulfill(body=path.read_bytes(), content_type=kind, headers=allowed)
                else:
                    try:
                        route.fulfill(response=route.fetch(timeout=20_000))
                    except Exception:  # there is no network here, or it does not have that
                        missing.append(url)
                        route.abort()

            size = {"width": 1200, "height": 9000}  # a cell out of sight is not there
            context = opened.new_context(viewport=size)
            context.route("**/*", answer)
            tab = context.new_page()
            tab.goto(f"{address}lite/notebooks/index.html?path={name}.ipynb")
            tab.wait_for_selector(".jp-Notebook", timeout=120_000)
            tab.get_by_role("menuitem", name="Run", exact=True).click()
            tab.get_by_role("menuitem", name="Run All Cells", exact=True).click()
            tab.wait_for_selector(".jp-OutputArea-output", timeout=120_000)
            waiting = tab.locator(".jp-InputPrompt", has_text="[*]")
            for _ in range(120):
                if not waiting.count():
                    break
                tab.wait_for_timeout(1000)
            printed = tab.locator(".jp-OutputArea-output").all_inner_texts()
            context.close()
            return "\n".join(printed), missing

        yield run
        server.shutdown()


def test_floating_point_runs_in_the_browser(tried, capsys):
    """It is plain Python, and prints there what it prints here."""
    runpy.run_path(str(NOTEBOOKS / "floating_point.py"))
    here = capsys.readouterr().out
    printed, missing = tried("floating_point")
    assert not missing
    assert printed.split() == here.split()


@pytest.mark.parametrize("name", ["camera", "plane", "triangle"])
def test_the_others_run_there_once_numpy_can_be_fetched(tried, name, monkeypatch, tmp_path, capsys):
    """Where there is no network, numpy is the one thing that the pack and the registries lack."""
    printed, missing = tried(name)
    if missing:
        assert {url.rpartition("/")[2].partition("-")[0] for url in missing} == {"numpy"}
        assert "No module named 'numpy'" in printed
        return
    monkeypatch.syspath_prepend(NOTEBOOKS)
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(NOTEBOOKS / f"{name}.py"))
    for line in capsys.readouterr().out.splitlines():
        assert line.strip() in printed


def test_pyodide_can_go_into_the_pack(pack, pyodide, tmp_path):
    import make_lessons

    for wheel in pack.glob("*.whl"):
        shutil.copy(wheel, tmp_path)
    make_lessons.build_lite(tmp_path, next(iter(pyodide.values())).parent)
    settings = (tmp_path / "lite" / "jupyter-lite.json").read_text("utf-8")
    assert '"./static/pyodide/pyodide.mjs"' in settings
    assert (tmp_path / "lite" / "static" / "pyodide" / "pyodide.asm.wasm").exists()
