"""The folder of a class: a page for each student, with no other's name, and tables for the teacher.

After Ctrl-C the same command goes on where it was: a student whose file, or whose program, and all
options are the same is not judged again. Students' programs run as their teacher: so all is written
after they have ended, with a digest under a key that they could not read, and a record or a page
that has another is not believed.
"""

from __future__ import annotations

import ast
import hashlib
import hmac
import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import islice
from pathlib import Path
from typing import Any

from reference_tracer import __version__
from reference_tracer.report.folders import write_json, write_text
from reference_tracer_processes.sandbox import sandbox

from .external import Code
from .formats import FORMATS
from .judging import Judgement
from .names import numbered
from .page import class_page, page
from .report import Student, student, to_dict
from .subjects.subject import Subject

JSON, PAGE, STUDENTS = "judge.json", "judge.html", "students"
_LONGEST = 60  # characters of a file's name
MOST_FILES = 2000  # of a folder that are looked at


class ClassFolder:
    """Where judgements are kept.

    Parameters
    ----------
    directory : Path
    subject : Subject
        What they were asked to write.
    names : sequence of str
        What a reader calls the students.
    options : object
        All that they depend on besides the student: what differs is judged anew.
    key : bytes, optional
        What digests are made with; without it nobody's record is believed.
    """

    def __init__(
        self,
        directory: Path,
        subject: Subject,
        names: Sequence[str],
        options: object = None,
        key: bytes | None = None,
    ) -> None:
        self._secret = key
        self._new: dict[str, tuple[str, dict[str, Any]]] = {}  # pages and records, by name
        self._directory = directory
        self._subject = subject
        self._options = repr((subject.name, options))
        self._files = _file_names(names)

    def kept_of(self, submissions: Mapping[str, Code]) -> dict[str, Student]:
        """Return what was said before of those that have not changed since, by name."""
        found = {name: self._kept(name, each) for name, each in submissions.items()}
        return {name: said for name, said in found.items() if said}

    def keep(self, submission: Code, j: Judgement) -> Student:
        """Keep a student's page, and what is said of him, for `save`; return that."""
        said, text = student(j), page(j)
        shown = hashlib.sha256(text.encode()).hexdigest()
        self._new[j.name] = text, {"key": self._key(submission), "page": shown, "student": said}
        return said

    def save(self) -> None:
        """Write what is kept, now that all programs have ended.

        Raises
        ------
        OSError
            If it cannot be written.
        """
        for name, (text, record) in self._new.items():
            write_text(self._page(name), text)
            write_json(self._record(name), {"digest": self._digest(record), "record": record})

    def write(self, students: Sequence[Student], formats: Iterable[str] = ()) -> None:
        """Write the tables of all students.

        Raises
        ------
        OSError
            If one cannot be written.
        """
        pages = [(s, f"{STUDENTS}/{self._page(s['file']).name}") for s in students]
        for name in formats:
            for path, text in FORMATS[name](pages):
                write_text(self._directory / path, text)
        if len(students) == 1:
            text = self._page(students[0]["file"]).read_text(encoding="utf-8")
        else:
            text = class_page(pages, self._subject.title)
        write_text(self._directory / PAGE, text)
        write_json(self._directory / JSON, to_dict(self._subject, students))

    def _kept(self, name: str, submission: Code) -> Student | None:
        with suppress(OSError, ValueError, KeyError, TypeError):
            found = json.loads(self._record(name).read_text(encoding="utf-8"))
            record, said = found["record"], dict(found["record"]["student"])
            shown = hashlib.sha256(self._page(name).read_bytes()).hexdigest()
            is_ours = hmac.compare_digest(found["digest"], self._digest(record))
            is_same = record["key"] == self._key(submission) and record["page"] == shown
            if self._secret and is_ours and is_same and not said["errors"]:
                return said  # an error may have been the machine's
        return None

    def _digest(self, record: Mapping[str, Any]) -> str:
        text = json.dumps(record, sort_keys=True)
        return hmac.new(self._secret or b"", text.encode(), "sha256").hexdigest()

    def _page(self, name: str) -> Path:
        return self._directory / STUDENTS / f"{self._files[name]}.html"

    def _record(self, name: str) -> Path:
        return self._page(name).with_suffix(".json")

    def _key(self, submission: Code) -> str:
        """Return what tells a student's code, and the options, from any other.

        Of a Python file that is what it imports of its own folder, too; of a program all files that
        its command names, and all in folders that it names. What these start is not known.
        """
        if isinstance(submission, Path):
            files = _with_imports(submission)
        else:
            named = [file for path in submission.named for file in _files_in(path)]
            results = self._directory.resolve()  # may lie in such a folder
            files = [file for file in named if results not in file.resolve().parents]
        parts = [__version__, self._options, str(submission), str(bool(sandbox()))]
        for path in files:
            with suppress(OSError):
                parts.append(hashlib.sha256(path.read_bytes()).hexdigest())
        return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def _files_in(path: Path) -> list[Path]:
    """Return a file, or all files in a folder."""
    every = islice(path.rglob("*"), MOST_FILES) if path.is_dir() else (path,)
    return sorted(file for file in every if file.is_file())


def _with_imports(path: Path) -> list[Path]:
    """Return a Python file, and those of its folder that it imports, directly or not."""
    found, left = [], [path]
    while left:
        file = left.pop()
        if file in found:
            continue
        found.append(file)
        with suppress(OSError, SyntaxError, ValueError):
            for name in _imported(ast.parse(file.read_bytes())):
                top = file.parent / name.partition(".")[0]
                module = top.with_suffix(".py")
                left += [module] if module.is_file() else sorted(top.rglob("*.py"))
    return found


def _imported(tree: ast.Module) -> Iterator[str]:
    """Yield the names that a file imports, and those that it imports from a module."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import | ast.ImportFrom):
            yield from (alias.name for alias in node.names)
        if isinstance(node, ast.ImportFrom) and node.module:
            yield node.module


def _file_names(names: Sequence[str]) -> dict[str, str]:
    """Return a file's name for each student, of plain characters, none twice."""
    short = [re.sub(r"[^\w.-]+", "_", n).strip("._")[:_LONGEST] or "student" for n in names]
    return dict(zip(names, numbered(short, "{}_{}", str.casefold), strict=True))
