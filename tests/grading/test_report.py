"""Judgements as a table, as JSON by its schema, and as a page."""

from __future__ import annotations

import csv
import json
import sys
from dataclasses import replace
from html import unescape
from html.parser import HTMLParser
from importlib.resources import files
from xml.etree import ElementTree

import jsonschema
import numpy as np
import pytest
import reference_tracer_grading
from reference_tracer.tracer.progress import result_of
from reference_tracer_grading import command
from reference_tracer_grading.class_folder import ClassFolder
from reference_tracer_grading.formats import FORMATS
from reference_tracer_grading.judged_scene import prepare
from reference_tracer_grading.judging import judge_all
from reference_tracer_grading.page import MARK_COLORS, marked
from reference_tracer_grading.picture import Mark
from reference_tracer_grading.report import student
from reference_tracer_grading.subjects.triangle import TRIANGLE
from reference_tracer_grading.tables import MARKS, VERDICTS, class_table, lines
from reference_tracer_processes.running import Limits

TEXT = """
import numpy as np

def dot(a, b):
    return (a * b).sum(axis=1)

def intersect(o, d, p):
    p1, p2, p3 = p[:, 0], p[:, 1], p[:, 2]
    n = np.cross(p3 - p1, p2 - p1)
    t = -dot(o - p1, n) / dot(d, n)
    x = o + t[:, None] * d
    edges = (p2, p3), (p3, p1), (p1, p2)
    s = np.stack([dot(n, np.cross(a - b, x - b)) for a, b in edges], axis=1) / dot(n, n)[:, None]
    return np.where((s >= 0).all(axis=1) & (t > 0), t, np.inf), s
"""
KEY = b"a key of 32 bytes, or of any other"
FILES = {
    "right.py": TEXT,
    "swapped.py": TEXT.replace("(p3, p1), (p1, p2)", "(p1, p2), (p3, p1)"),
    "blind.py": TEXT.replace("(t > 0)", "False") + "\nprint('<script>alert(1)</script>')\n",
    "one_sided.py": TEXT.replace("(t > 0)", "(t > 0) & (dot(d, n) > 0)"),
    "broken.py": "def intersect(o, d, p):\n    return '<b>' + 1\n",
    "endless <i>.py": "import time\nwhile True:\n    time.sleep(9)\n",
}


@pytest.fixture(scope="module")
def judged(make, tmp_path_factory):
    """What is said of six files, on one scene."""
    folder = tmp_path_factory.mktemp("students")
    for name, text in FILES.items():
        (folder / name).write_text(text, encoding="utf-8")
    quads = make.quad(-1.03, 1.07, -1.01, 1.02, -4), make.quad(3, -3, -2, 2.1, -6, "A & <B>")
    subject = result_of(prepare("a<b", make.scene(make.camera(), *quads), "s.npz", None))
    paths = {name: folder / name for name in FILES}
    limits = Limits(seconds=3)
    work = judge_all(paths, TRIANGLE.cases(), [subject], limits, told=lambda j: j, jobs=2)
    return result_of(work)


@pytest.fixture(scope="module")
def written(judged, tmp_path_factory):
    folder = tmp_path_factory.mktemp("judged")
    kept = ClassFolder(folder, TRIANGLE, list(judged))
    said = [kept.keep(folder / name, j) for name, j in judged.items()]
    kept.save()
    kept.write(said, FORMATS)
    return folder


def test_verdicts(judged):
    assert {name: j.verdict for name, j in judged.items()} == {
        "right.py": "right",
        "swapped.py": "wrong",
        "blind.py": "wrong",
        "one_sided.py": "wrong",
        "broken.py": "failed",
        "endless <i>.py": "failed",
    }


def test_json_is_by_its_schema(written):
    schema = json.loads(files(reference_tracer_grading).joinpath("judge.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    found = json.loads((written / "judge.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator(schema).validate(found)
    assert len(found["students"]) == len(FILES)
    assert sum(found["weights"].values()) == pytest.approx(1)
    swapped = found["students"][1]
    assert [f["name"] for f in swapped["faults"]] == ["s2_s3_swapped"]
    [scene] = swapped["scenes"]
    assert sum(scene["pixels"].values()) == scene["width"] * scene["height"]
    example = scene["examples"][0]
    x, y = example["pixel"]
    assert example["explain"] == f"reftrace explain s.npz --pixel {x} {y}"
    (t, *right), (same, *wrong) = example["certified"], example["student"]
    assert same == t and wrong == pytest.approx([right[0], right[2], right[1]])
    # A schema that lets anything pass would be none.
    swapped["score"] = 101
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(found, schema)


def test_examples_are_reproducible(judged):
    """Ray and triangle as they are printed give the answer that is printed."""
    [scene] = student(judged["swapped.py"])["scenes"]
    space = {}
    exec(FILES["swapped.py"], space)
    for e in scene["examples"]:
        t, s = space["intersect"](*(np.array([v]) for v in e["given"].values()))
        assert (t[0], *s[0].tolist()) == e["student"]


class Page(HTMLParser):
    """Counts elements, and notes what they point at."""

    VOID = "meta", "img"

    def __init__(self, text):
        super().__init__()
        self.open, self.tags, self.links, self.text = [], [], [], ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.links += [value for name, value in attributes if name in ("href", "src")]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data


def test_page(written, judged):
    page = Page((written / "judge.html").read_text(encoding="utf-8"))
    own = [Page((written / link).read_text(encoding="utf-8")) for link in page.links]
    for each in (page, *own):
        assert not each.open  # every element is closed, in the right order
        assert "script" not in each.tags and "i" not in each.tags and "b" not in each.tags
        # The teacher's warning is not for his students.
        assert ("running the students' own code" in each.text) == (each is page)
    assert all(x.startswith("data:image/png;base64,") for each in own for x in each.links)
    assert sum(each.tags.count("img") for each in own) == 3 * 4  # four came to the scene's end
    text = "".join(each.text for each in own)
    assert "A & <B>" in text and "endless <i>.py" in page.text
    assert "<script>alert(1)</script>" in text  # as text
    assert "line 2: return '<b>' + 1" in text
    for j, each in zip(judged.values(), own, strict=True):
        assert f"{j.score:.1f}" in page.text and f"{j.score:.1f}" in each.text
        assert all(f.name in page.text and f.name in each.text for f in j.faults)


def test_no_page_of_a_student_names_another(written, judged):
    names = set(judged)
    pages = sorted((written / "students").glob("*.html"))
    assert len(pages) == len(names)
    for path in pages:
        text = unescape(path.read_text(encoding="utf-8"))
        assert len([name for name in names if name in text]) == 1


def test_map_of_wrong_pixels(judged):
    [found] = judged["one_sided.py"].looks
    picture = marked(found)
    missed = found.mark == Mark.MISSED
    assert missed.any() and not missed.all()
    assert (picture[missed, :3] == MARK_COLORS[Mark.MISSED]).all()
    assert (picture[found.mark == Mark.RIGHT, :3].std(axis=-1) < 1).all()


def test_lines(judged):
    text = {name: "\n".join(lines(j)) for name, j in judged.items()}
    assert text["right.py"].startswith("right.py: all right, score 100.0 of 100")
    assert "reftrace explain s.npz --pixel" in text["swapped.py"]
    assert "the textbook's erratum" in " ".join(text["swapped.py"].split())
    assert "broken.py, line 2: return '<b>' + 1" in text["broken.py"]
    assert "raise it with --time-limit" in " ".join(text["endless <i>.py"].split())
    assert "time limit of 3 s" in " ".join(text["endless <i>.py"].split())
    assert "it prints" in text["blind.py"]
    assert max(len(line) for t in text.values() for line in t.splitlines()) <= 120


def test_class_table(judged):
    table = class_table([student(j) for j in judged.values()])
    assert len(table) == 1 + len(FILES)
    assert table[1].split() == ["right.py", "100.0", "all", "right"]
    assert table[2].split()[2:] == ["wrong", "s2_s3_swapped"]
    assert table[5].split()[1:] == ["0.0", "failed", "exception"]


def test_every_mark_has_its_words_and_color():
    assert set(MARKS) == set(Mark) and len(set(MARKS.values())) == len(Mark)
    assert set(MARK_COLORS) == set(Mark) - {Mark.RIGHT}
    assert len(set(MARK_COLORS.values())) == len(MARK_COLORS)


def test_an_example_of_every_mark(judged):
    """The terminal shows one pixel of each kind, not only of the first."""
    j = judged["swapped.py"]
    [found] = j.looks
    first = found.examples[0]
    other = replace(first, group="missed")
    several = replace(j, looks=[replace(found, examples=[first, first, other])])
    pixels = [line for line in lines(several) if "reftrace explain" in line]
    assert len(pixels) == 2
    assert MARKS[Mark.WRONG_BARYCENTRICS] in pixels[0] and MARKS[Mark.MISSED] in pixels[1]


def test_it_needs_no_library_for_pictures(judged, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "PIL", None)
    kept = ClassFolder(tmp_path, TRIANGLE, ["swapped.py"])
    said = [kept.keep(tmp_path / "swapped.py", judged["swapped.py"])]
    kept.save()
    kept.write(said)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["judge.html", "judge.json", "students"]
    # Who is judged alone has no table of a class.
    assert "wrong pixels" in (tmp_path / "judge.html").read_text(encoding="utf-8")


def test_what_other_programs_read(written, judged):
    rows = list(csv.DictReader((written / "judge.csv").open(encoding="utf-8", newline="")))
    assert [(r["file"], float(r["score"])) for r in rows] == [
        (j.name, j.score) for j in judged.values()
    ]
    suites = ElementTree.parse(written / "judge.xml").getroot()
    assert [s.get("name") for s in suites] == list(judged)
    for suite, j in zip(suites, judged.values(), strict=True):
        failed = [case for case in suite if case.find("failure") is not None]
        assert len(failed) == int(suite.get("failures")) and len(suite) == int(suite.get("tests"))
        assert bool(failed) == (j.verdict != "right")
    results = [json.loads(p.read_text()) for p in (written / "gradescope").rglob("results.json")]
    assert sorted(r["score"] for r in results) == sorted(j.score for j in judged.values())
    verdicts = sorted(VERDICTS[j.verdict].capitalize() for j in judged.values())
    assert sorted(r["output"].partition(".\n")[0].rstrip(".") for r in results) == verdicts
    assert all(0 <= t["score"] <= t["max_score"] for r in results for t in r["tests"])


def test_the_command_knows_all_formats():
    assert set(command.FORMATS) == set(FORMATS)


def test_who_has_not_changed_is_not_judged_again(judged, tmp_path):
    files = {name: tmp_path / name for name in ("right.py", "swapped.py")}
    for name, path in files.items():
        path.write_text(FILES[name], encoding="utf-8")
    kept = ClassFolder(tmp_path / "out", TRIANGLE, list(files), "options", KEY)
    for name, path in files.items():
        kept.keep(path, judged[name])
    kept.save()
    again = ClassFolder(tmp_path / "out", TRIANGLE, list(files), "options", KEY)
    assert set(again.kept_of(files)) == set(files)
    assert not ClassFolder(tmp_path / "out", TRIANGLE, list(files), "others", KEY).kept_of(files)
    files["right.py"].write_text(FILES["right.py"] + "#", encoding="utf-8")
    assert set(kept.kept_of(files)) == {"swapped.py"}
    (tmp_path / "out" / "students" / "swapped.py.json").write_text("{")
    assert not kept.kept_of(files)


@pytest.mark.parametrize("change", ["score", "page", "key", "all"])
def test_a_record_is_checked_before_it_is_believed(change, judged, tmp_path):
    """A hostile program edited others' marks and pages: neither is believed without the key."""
    files = {"right.py": tmp_path / "right.py"}
    files["right.py"].write_text(FILES["right.py"])

    def folder(key):
        return ClassFolder(tmp_path / "out", TRIANGLE, list(files), key=key)

    kept = folder(KEY)
    kept.keep(files["right.py"], judged["right.py"])
    assert not (tmp_path / "out").exists()  # nothing yet that a program could change
    kept.save()
    assert folder(KEY).kept_of(files)
    record, page = (tmp_path / "out" / "students" / f"right.py.{e}" for e in ("json", "html"))
    if change == "score":
        record.write_text(record.read_text().replace('"score": 100', '"score": 12'))
    if change == "page":
        page.write_text(page.read_text() + "<script>alert(1)</script>")
    if change == "all":  # written anew, as by this program, with another key
        forger = folder(b"another")
        forger.keep(files["right.py"], judged["right.py"])
        forger.save()
    assert not folder(None if change == "key" else KEY).kept_of(files)


def test_who_imports_a_file_that_has_changed_is_judged_again(judged, tmp_path):
    (tmp_path / "own.py").write_text("import numpy\nfrom helper import intersect\n")
    (tmp_path / "helper.py").write_text("import deeper\n")
    (tmp_path / "deeper.py").write_text("x = 1\n")
    files = {"own.py": tmp_path / "own.py"}
    kept = ClassFolder(tmp_path / "out", TRIANGLE, list(files), key=KEY)
    kept.keep(files["own.py"], replace(judged["right.py"], name="own.py"))
    kept.save()
    assert kept.kept_of(files)
    (tmp_path / "deeper.py").write_text("x = 2\n")
    assert not kept.kept_of(files)


def test_an_error_is_not_kept(judged, tmp_path):
    """It may have been the machine's: a compiler that was missing, a memory that was full."""
    path = tmp_path / "broken.py"
    path.write_text(FILES["broken.py"])
    kept = ClassFolder(tmp_path / "out", TRIANGLE, ["broken.py"], key=KEY)
    kept.keep(path, judged["broken.py"])
    kept.save()
    assert not kept.kept_of({"broken.py": path})


def test_a_name_is_no_formula(judged):
    said = student(replace(judged["right.py"], name="=1+1.py"))
    [(_, text)] = FORMATS["csv"]([(said, "students/x.html")])
    assert "\n'=1+1.py," in text.replace("\r", "")


def test_files_of_students_have_names_of_their_own(tmp_path):
    names = ["a/b.py", "a_b.py", "A_B.py", "../../x.py", "<i>", "", "é" * 100]
    files = ClassFolder(tmp_path, TRIANGLE, names)._files
    assert len({f.casefold() for f in files.values()}) == len(names)
    assert all("/" not in f and not f.startswith(".") and len(f) < 70 for f in files.values())
