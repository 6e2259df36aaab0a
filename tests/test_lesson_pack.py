"""The lesson pack of `make lessons`: whole, printable, and its notebooks run in Chromium."""

from __future__ import annotations

import re
import runpy
import shutil
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

pytestmark = [pytest.mark.torture, pytest.mark.browser]

PROJECT = Path(__file__).parent.parent
LESSONS = PROJECT / "docs" / "lessons"
NAMES = "constant_shading", "perspective_camera", "plane", "triangle"


@pytest.fixture(scope="module")
def pack(tmp_path_factory):
    import make_lessons

    make_lessons.run(PROJECT / "tools" / "build_extension.py")
    out = tmp_path_factory.mktemp("pack") / "lessons"
    make_lessons.build(out, None)
    return out


def test_every_link_leads_into_the_pack(pack):
    pages = [p for p in pack.rglob("*.html") if "lite" not in p.relative_to(pack).parts]
    assert len(pages) > 40
    for page in pages:
        for link in re.findall(r'(?:href|src)="([^"#:]+)(?:#[^"]*)?"', page.read_text("utf-8")):
            assert (page.parent / link).exists(), (page.name, link)


@pytest.mark.parametrize("folder", ["lessons", "lessons/de"])
def test_worksheets_are_for_paper(folder, pack):
    """They have the formulas that they speak of, with indices set, and no links; and room."""
    for name in NAMES:
        text = (pack / folder / "worksheets" / f"{name}.html").read_text("utf-8")
        sheet = text[text.index("<main") : text.index("</main>")]
        assert "<pre><code>" in sheet and "<a " not in sheet and "_s" not in sheet
        assert ".worksheets > ol > li { break-inside: avoid; padding-bottom" in text
    assert "n<sub>s1</sub> = (p₂ − p₃)" in sheet  # the triangle's


def test_the_index_says_what_each_file_is_for_and_in_which_order(pack):
    items = re.findall(
        r'<li><a href="([^"]+)">[^<]+</a>: (.+)</li>', (pack / "index.html").read_text()
    )
    assert items[0][0] == "lessons/README.html" and all(what for _, what in items)
    sheets = [Path(to).stem for to, _ in items if "worksheets" in to]
    assert sheets == list(NAMES) and all((pack / to).exists() for to, _ in items)


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
def tried(pack):
    """Run a notebook in Chromium: its path -> what it prints, and what it wants from elsewhere."""
    from documents import browser

    serve = partial(_Quiet, directory=pack)
    with ThreadingHTTPServer(("127.0.0.1", 0), serve) as server, browser.opened() as opened:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        address = f"http://127.0.0.1:{server.server_port}/"

        def run(path):
            elsewhere = []

            def answer(route):
                if route.request.url.startswith(address):
                    route.continue_()
                else:
                    elsewhere.append(route.request.url)
                    route.abort()

            size = {"width": 1200, "height": 9000}  # a cell out of sight is not there
            context = opened.new_context(viewport=size)
            context.route("**/*", answer)
            tab = context.new_page()
            tab.goto(f"{address}lite/notebooks/index.html?path={path}.ipynb")
            ready = '.jp-Notebook-ExecutionIndicator[data-status="idle"]'
            tab.wait_for_selector(ready, timeout=120_000)
            tab.get_by_role("menuitem", name="Run", exact=True).click()
            tab.get_by_role("menuitem", name="Run All Cells", exact=True).click()
            tab.wait_for_selector(".jp-OutputArea-output", timeout=240_000)
            waiting = tab.locator(".jp-InputPrompt", has_text="[*]")
            for _ in range(120):
                if not waiting.count():
                    break
                tab.wait_for_timeout(1000)
            printed = tab.locator(".jp-OutputArea-output").all_inner_texts()
            context.close()
            return "\n".join(printed), elsewhere

        yield run
        server.shutdown()


@pytest.mark.parametrize("name", ["camera", "floating_point", "plane", "triangle", "de/plane"])
def test_a_notebook_prints_there_what_it_prints_here_and_needs_no_network(
    tried, name, monkeypatch, tmp_path, capsys
):
    monkeypatch.syspath_prepend(LESSONS / "notebooks")
    monkeypatch.chdir(tmp_path)
    language, _, stem = name.rpartition("/")
    runpy.run_path(str(LESSONS / language / "notebooks" / f"{stem}.py"))
    here = capsys.readouterr().out
    printed, elsewhere = tried(name)
    assert not elsewhere
    assert [line for line in here.splitlines() if line.strip() not in printed] == []


def test_another_distribution_of_pyodide_can_go_into_the_pack(pack, tmp_path):
    import make_lessons

    own = tmp_path / "own"
    own.mkdir()
    for name in ("pyodide.js", "pyodide-lock.json"):
        (own / name).write_text("another")
    for wheel in pack.glob("*.whl"):
        shutil.copy(wheel, tmp_path)
    make_lessons.build_lite(tmp_path, own)
    settings = (tmp_path / "lite" / "jupyter-lite.json").read_text("utf-8")
    assert '"./static/pyodide/pyodide.js"' in settings
    kept = tmp_path / "lite" / "static" / "pyodide"
    assert {path.read_text("utf-8") for path in kept.iterdir()} == {"another"}
