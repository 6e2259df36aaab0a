"""Refreshes the documents: runs every command that they name, and computes every figure.

    python tools/make_docs.py [--no-browser] [--no-window] [FILE.md ...]

Fills in what stands between the markers (`documents/markers.py` says which there are), draws
docs/images/lessons and causes, docs/images/extremes.svg and the README's diagnosis.gif, takes the
picture of out/demo/page.html in Chromium, and the tutorial's in a real Blender window (which needs
root, Chromium, and the extension in dist/).
"""

from __future__ import annotations

import argparse
import io
import shlex
import shutil
from contextlib import chdir, redirect_stderr, redirect_stdout
from functools import cache
from pathlib import Path

from documents import (
    architecture,
    causes,
    derivations,
    figures,
    pictures,
    python,
    records,
    story,
    subjects,
)
from documents.markers import Command, commands, refreshed
from documents.markers import figures as figures_of
from reference_tracer.cli import main as reftrace

PROJECT = Path(__file__).resolve().parents[1]
DOCS = PROJECT / "docs"
IMAGES = DOCS / "images"
MADE = "docs", "lessons"  # folders below out/ for what the documents' commands make
LINES = 100  # of one command's output, at most


def documents() -> list[Path]:
    """The Markdown files that have something to be filled in."""
    texts = {path: path.read_text(encoding="utf-8") for path in sorted(DOCS.rglob("*.md"))}
    return [path for path, text in texts.items() if commands(text) or figures_of(text)]


@cache  # lessons in two languages have the same commands, of which one writes a file only once
def printed(text: str) -> str:
    """Run a command in the project's folder, in this process; returns what it prints.

    A process for each would start Blender anew, which takes longer than most commands.
    """
    name, *arguments = shlex.split(text)
    if name != "reftrace":
        raise SystemExit(f"documents run reftrace, not '{name}'")
    said, wrong = io.StringIO(), io.StringIO()
    with chdir(PROJECT), redirect_stdout(said), redirect_stderr(wrong):
        code = reftrace.main(arguments)
    if code not in (0, 1, 2):  # agree, warnings, differences: what it found
        raise SystemExit(f"{text}\n{said.getvalue()}{wrong.getvalue()}")
    return said.getvalue()


def run(command: Command) -> str:
    """Return what a command of a document prints."""
    out = printed(command.text)
    if command.printed and (lines := out.count("\n")) > LINES:
        raise SystemExit(f"{command.text} prints {lines} lines: no document has room for that")
    return out


def main() -> None:
    parser = argparse.ArgumentParser(description="Refresh the documents.")
    parser.add_argument("files", nargs="*", type=Path, metavar="FILE.md")
    parser.add_argument("--no-browser", action="store_true", help="no pictures of the page")
    parser.add_argument("--no-window", action="store_true", help="no pictures of Blender's window")
    options = parser.parse_args()
    for folder in MADE:
        shutil.rmtree(PROJECT / "out" / folder, ignore_errors=True)
    pictures.write(IMAGES / "lessons")
    causes.write(IMAGES / "causes")
    if not options.files:  # it takes a minute
        run(Command("reftrace extremes --out out/docs/extremes", ""))
        story.write(IMAGES / "diagnosis.gif")
    if not options.no_browser:
        from documents import browser, drawings

        drawings.write(IMAGES / "lessons")
        if not options.files:
            plotted = PROJECT / "out" / "docs" / "extremes" / "extremes.html"
            drawings.save_plot(plotted, IMAGES / "extremes.svg")
        page = PROJECT / "out" / "demo" / "page.html"  # of `make demo`
        browser.save(page, IMAGES / "page.png", 1400, 1130)
    if not options.no_window:
        from documents import clips, window

        window.write(IMAGES / "tutorial")
        clips.write(IMAGES / "lessons" / "clips")
    values = figures.values() | derivations.values() | records.values() | subjects.values()
    values |= {"python_api": python.page()}
    page = PROJECT / "ARCHITECTURE.md"
    page.write_text(architecture.refreshed(page.read_text(encoding="utf-8")), encoding="utf-8")
    for path in options.files or documents():
        text = path.read_text(encoding="utf-8")
        path.write_text(refreshed(text, run, values), encoding="utf-8")
        print(path.resolve().relative_to(PROJECT), flush=True)


if __name__ == "__main__":
    main()
