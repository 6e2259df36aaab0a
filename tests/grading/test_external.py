"""A program is kept from the network and from files; what it does wrong is its own error."""

from __future__ import annotations

import shlex
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from reference_tracer.cli.main import main
from reference_tracer.tracer.progress import result_of
from reference_tracer_grading.external import Program, Run
from reference_tracer_grading.judging import judge, names
from reference_tracer_grading.student_error import StudentError
from reference_tracer_grading.subjects.triangle import FORM
from reference_tracer_processes.running import KEPT, Limits
from reference_tracer_processes.sandbox import sandbox

RAYS = np.zeros((5, 3)), np.ones((5, 3)), np.arange(45.0).reshape(5, 3, 3)
PYTHON = shlex.quote(sys.executable)


ENOUGH = Limits(seconds=3600)  # half of which may go by, also on a busy machine


def program(written, text, arguments="{rays} {answers}", exchange="csv", limits=None):
    path = written("import sys\n" + text, "program.py")
    command = f"{PYTHON} {shlex.quote(str(path))} {arguments}"
    return Program(Run(command, exchange), FORM, limits)


ECHO = """
lines = open(sys.argv[1]).read().split()
with open(sys.argv[2], "w") as out:
    for line in lines:
        v = line.split(",")
        out.write(",".join((v[3], v[6], v[7], v[8])) + "\\n")
"""


def test_rays_come_as_they_are_and_answers_go_as_they_are(written):
    rng = np.random.default_rng(3)
    o, d, p = rng.normal(size=(7, 3)), rng.normal(size=(7, 3)) * 1e-300, rng.normal(size=(7, 3, 3))
    t, s = program(written, ECHO).ask(o, d, p)
    assert (t == d[:, 0]).all() and (s == p[:, 0]).all()  # to the last bit


def test_by_pipe_and_raw(written):
    o, d, p = RAYS
    text = """
import struct
data = sys.stdin.buffer.read()
for k in range(0, len(data), 120):
    v = struct.unpack("<15d", data[k : k + 120])
    sys.stdout.buffer.write(struct.pack("<4d", v[6], *v[3:6]))
"""
    t, s = program(written, text, "", "raw").ask(o, d, p)
    assert (t == p[:, 0, 0]).all() and (s == d).all()


@pytest.mark.parametrize(
    "miss", ["inf", "nan", "Infinity", "inf,0,0,0", "-inf", "1.#INF", "1.#INF00"]
)
def test_a_miss_may_be_written_in_several_ways(miss, written):
    text = f"for line in open(sys.argv[1]): print('{miss}', file=open(sys.argv[2], 'a'))"
    t, _ = program(written, text).ask(*RAYS)
    assert not np.isfinite(t).any()


HOSTILE = {
    "a word": ("open(sys.argv[2], 'w').write('1,2,3,4\\nhello\\n')", "answer", "line 2"),
    "three numbers": ("open(sys.argv[2], 'w').write('1,2,3\\n' * 5)", "answer", "t,s1,s2,s3"),
    "a number alone": ("open(sys.argv[2], 'w').write('1\\n' * 5)", "answer", "line 1"),
    "too few": ("open(sys.argv[2], 'w').write('inf\\n' * 4)", "answer", "4 lines of 5"),
    "too many": ("open(sys.argv[2], 'w').write('inf\\n' * 6)", "answer", "6 lines of 5"),
    "no file": ("pass", "answer", "wrote no answers"),
    "bytes": ("open(sys.argv[2], 'wb').write(bytes(range(128, 200)))", "answer", "line 1"),
    "raises": ("1 / 0", "ended", "exit code 1: ZeroDivisionError"),
    "exit code": ("sys.exit(3)", "ended", "exit code 3"),
    "ends itself": ("import os; os.kill(os.getpid(), 9)", "ended", "137|SIGKILL"),
    "a fifo": ("import os; os.mkfifo(sys.argv[2])", "answer", "no file"),
    "a folder": ("import os; os.mkdir(sys.argv[2])", "answer", "no file|directory"),
    "a link": ("import os; os.symlink('/dev/zero', sys.argv[2])", "answer", "cannot be read"),
    "endless": ("open(sys.argv[2], 'w').write('inf\\n' * 99_999)", "answer", "too much"),
    "its folder": (
        "import os, shutil\nown = os.environ['TMPDIR']\n"
        "[os.remove(os.path.join(own, name)) for name in os.listdir(own)]",
        "answer",
        "wrote no answers",
    ),
    "memory": ("x = bytearray(3 << 30); open(sys.argv[2], 'w')", "ended", "MemoryError"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_what_it_does_wrong_is_its_own_error(name, written):
    text, kind, words = HOSTILE[name]
    with pytest.raises(StudentError, match="|".join(words.split("|"))) as caught:
        program(written, text).ask(*RAYS)
    assert caught.value.kind == kind


def test_one_that_is_not_there(tmp_path):
    with pytest.raises(StudentError):
        Program(Run(str(tmp_path / "nothing")), FORM).ask(*RAYS)


def test_one_that_never_ends_is_ended_with_all_that_it_started(written):
    text = "import subprocess; subprocess.Popen(['sleep', '60']).wait()"
    began = time.monotonic()
    with pytest.raises(StudentError, match="time limit") as caught:
        program(written, text, limits=Limits(seconds=0.5)).ask(*RAYS)
    assert caught.value.kind == "time" and time.monotonic() - began < 30


def test_what_it_prints_is_kept_but_not_all(written):
    text = "print('x' * 99_999)\nopen(sys.argv[2], 'w').write('inf\\n' * 5)"
    own = program(written, text)
    own.ask(*RAYS)
    assert own.printed == 100_000 and own.said == "x" * KEPT


def test_a_program_is_judged_as_a_file_is(written, right, checks):
    """The same mistake gets the same name and the same points."""
    wrong = right["textbook"].replace("t = -dot", "t = dot")
    file = result_of(judge(written(wrong), checks, []))
    bridge = """
import numpy as np
v = np.loadtxt(sys.argv[1], delimiter=",", ndmin=2)
with np.errstate(all="ignore"):
    t, s = intersect(v[:, :3], v[:, 3:6], v[:, 6:].reshape(-1, 3, 3))
np.savetxt(sys.argv[2], np.column_stack((t, s)), fmt="%.17g", delimiter=",")
"""
    path = written("import sys\n" + wrong + bridge, "bridge.py")
    run = Run(f"{PYTHON} {path} {{rays}} {{answers}}")
    other = result_of(judge(run, checks, []))
    assert [f.name for f in other.faults] == [f.name for f in file.faults] == ["t_sign"]
    assert other.score == file.score and other.checks == file.checks


BY_LINES = """
import sys
with open(sys.argv[1]) as rays, open(sys.argv[2], "w") as answers:
    for line in rays:
        v = [float(word) for word in line.split(",")]
        t, s = one(v[:3], v[3:6], (v[6:9], v[9:12], v[12:]))
        print(t, *s, sep=",", file=answers)
"""


def test_a_program_that_dies_keeps_what_the_rest_of_its_answers_earns(
    written, no_guard, checks, monkeypatch
):
    """It dies of a division by zero, and is started some 130 times to find of which."""
    starts = []
    run = Program._run
    monkeypatch.setattr(Program, "_run", lambda *given: starts.append(1) or run(*given))
    command = f"{PYTHON} {written(no_guard + BY_LINES)}"
    run_as = Run(f"{command} {{rays}} {{answers}}")
    found = result_of(judge(run_as, checks, limits=ENOUGH))
    [fault] = found.faults
    assert (fault.name, found.verdict, found.errors) == ("raises", "wrong", [])
    assert "ZeroDivisionError" in fault.sentence and "directions = [" in fault.sentence
    assert found.checks.right["surface"] == 2600 and 80 < found.score < 90
    assert 800 <= fault.pairs <= 810  # few beside them
    assert len(starts) <= Program.parts + 30
    # Some groups were not asked one by one: it is said how many pairs that are.
    assert "of these in groups" in fault.sentence


def test_one_case_of_many_is_found_in_few_starts(written, monkeypatch):
    starts = []
    run = Program._run
    monkeypatch.setattr(Program, "_run", lambda *given: starts.append(1) or run(*given))
    text = "lines = open(sys.argv[1]).read()\nassert '4321' not in lines\n"
    text += "open(sys.argv[2], 'w').write('inf\\n' * lines.count('\\n'))"
    rays = np.zeros((5000, 3)), np.ones((5000, 3)), np.ones((5000, 3, 3))
    rays[0][3210] = 4321
    own = program(written, text, limits=ENOUGH)
    own.ask(*rays)
    assert np.flatnonzero(own.raised).tolist() == [3210] and own.unasked == 0
    assert len(starts) < 30


@pytest.mark.slow
def test_who_dies_here_and_there_is_no_one_who_always_dies(written):
    """Groups that are not asked one by one say nothing of how many raise: the rest counts."""
    text = "lines = open(sys.argv[1]).read()\nassert '4321' not in lines\n"
    text += "open(sys.argv[2], 'w').write('inf\\n' * lines.count('\\n'))"
    rays = np.zeros((2000, 3)), np.ones((2000, 3)), np.ones((2000, 3, 3))
    dies = np.random.default_rng(7).random(2000) < 0.05
    rays[0][dies] = 4321
    own = program(written, text, limits=ENOUGH)
    own.ask(*rays)
    assert own.raised[dies].all() and 0 < own.unasked
    assert (~own.raised).mean() > 0.1


def test_a_program_has_the_name_of_its_authors_folder_or_file(tmp_path):
    for name in ("anna", "bob"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "ray.js").write_text("")
    commands = {
        f"java -Xms16m -cp {tmp_path / 'anna'} Ray {{rays}} {{answers}}": "anna",
        f"node {tmp_path / 'anna' / 'ray.js'}": "anna/ray.js",
        f"node --max={tmp_path / 'bob' / 'ray.js'} {{rays}}": "bob/ray.js",
        "nothing of this -is there": "nothing of this -is there",
    }
    assert names([Run(command) for command in commands]) == list(commands.values())


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--run", "'unclosed"], "No closing quotation"),
        (["--run", ""], "there is no command"),
        (["--exchange", "raw"], "--exchange is for --run"),
        ([], "--run for a program in another language"),
    ],
)
def test_options_that_mean_nothing(arguments, words, capsys):
    assert main(["judge", *arguments]) == 4
    assert words in capsys.readouterr().err


def test_marks_of_an_encoding_and_empty_last_lines_are_no_answers(written):
    text = """
with open(sys.argv[2], "w", encoding="utf-8-sig") as out:
    out.write("inf\\n" * 5 + "\\n\\n")
"""
    t, _ = program(written, text).ask(*RAYS)
    assert len(t) == 5 and not np.isfinite(t).any()


def test_a_program_knows_nothing_of_the_teachers_environment(written, monkeypatch):
    """In the sandbox; nor does it reach the socket of another program."""
    import socket
    import tempfile

    monkeypatch.setenv("TOKEN_OF_A_TEACHER", "secret")
    with tempfile.TemporaryDirectory() as folder:
        path = f"{folder}/socket"
        with socket.socket(socket.AF_UNIX) as server:
            server.bind(path)
            server.listen()
            text = f"""
import os, socket
reached = True
try:
    socket.socket(socket.AF_UNIX).connect({path!r})
except OSError:
    reached = False
told = "TOKEN_OF_A_TEACHER" in os.environ
open(sys.argv[2], "w").write(f"{{told:d}},{{reached:d}},0,0\\n" * 5)
"""
            t, s = program(written, text).ask(*RAYS)
    kept_in = bool(sandbox())
    assert t[0] == s[0, 0] == (not kept_in)


@pytest.mark.parametrize("where", ["/tmp", "/"])
def test_where_it_is_started_shows_no_hidden_folder(where, monkeypatch):
    """Its own file is seen there, and what lies beside it is not."""
    import tempfile

    text = """
import os, sys
seen = os.path.exists(sys.argv[0]), os.path.exists(sys.argv[3])
open(sys.argv[2], "w").write("%d,%d,0,0\\n" % seen * 5)
"""
    with tempfile.NamedTemporaryFile("w", encoding="utf-8", dir="/tmp", suffix=".py") as own:
        own.write(text)
        own.flush()
        with tempfile.NamedTemporaryFile(dir="/tmp") as secret:
            monkeypatch.chdir(where)
            hidden = f"$(echo {secret.name})"  # a word that names no file: else it would be shown
            python = Path(sys.executable).resolve()  # not the link of a clone that lies in /tmp
            command = f"sh -c '{python} {own.name} {{rays}} {{answers}} {hidden}' {own.name}"
            t, s = Program(Run(command, "csv"), FORM).ask(*RAYS)
    assert t[0] == 1 and s[0, 0] == (not sandbox())


def test_two_of_one_name_are_two(written):
    path = written("pass", "same.py")
    assert names([path, Run("same.py"), Run("same.py")]) == [
        "same.py",
        "same.py (2)",
        "same.py (3)",
    ]
