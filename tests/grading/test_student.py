"""A process of its own: whatever a student's file does is said to be its own error, in words."""

from __future__ import annotations

import os
import sys
import time

import numpy as np
import pytest
from reference_tracer_grading.student import Student
from reference_tracer_grading.student_error import StudentError
from reference_tracer_grading.subjects.triangle import FORM
from reference_tracer_processes.running import KEPT, Limits
from reference_tracer_processes.sandbox import sandbox, secret

from .conftest import running

HEAD = "import os, sys\nimport numpy as np\n\ndef intersect(o, d, p):\n    "
NOTHING = "return np.full(len(o), np.inf), np.zeros((len(o), 3))"
RAYS = np.zeros((5, 3)), np.ones((5, 3)), np.arange(45.0).reshape(5, 3, 3)

# What a file does -> its kind of error, and words of the message.
HOSTILE = {
    "syntax": ("def intersect(o, d, p)\n    pass", "syntax", "SyntaxError"),
    "indent": ("def intersect(o, d, p):\npass", "syntax", "IndentationError"),
    "null bytes": ("x = 1\0", "syntax", "null bytes"),
    "no function": ("x = 1", "answer", "no function 'intersect"),
    "not a function": ("intersect = 3", "answer", "no function 'intersect"),
    "import": ("import a_module_that_is_not_there", "exception", "a_module_that_is_not_there"),
    "raises at import": ("1 / 0", "exception", "ZeroDivisionError"),
    "raises": (HEAD + "return o.size_of_it", "exception", "AttributeError"),
    "arguments": ("def intersect(o, d):\n    pass", "exception", "3 were given"),
    "recursion": (HEAD + "return intersect(o, d, p)", "exception", "RecursionError"),
    "exit": (HEAD + "sys.exit(0)", "exit", "must not call sys.exit"),
    "exit at import": ("quit()", "exit", "must not call sys.exit"),
    "keyboard interrupt": (HEAD + "raise KeyboardInterrupt", "exception", "KeyboardInterrupt"),
    "hard exit": (HEAD + "os._exit(3)", "ended", "exit code 3"),
    "none": (HEAD + "return None", "answer", "not NoneType"),
    "one array": (HEAD + "return np.zeros(len(o))", "answer", "not ndarray"),
    "three": (HEAD + "return 1, 2, 3", "answer", "tuple of 3"),
    "shape of t": (HEAD + "return np.zeros((5, 1)), np.zeros((5, 3))", "answer", "must be (5,)"),
    "transposed": (HEAD + "return np.zeros(5), np.zeros((3, 5))", "answer", "transposed?"),
    "complex": (HEAD + "return np.zeros(5, complex), np.zeros((5, 3))", "answer", "complex128"),
    "words": (HEAD + "return ['a'] * 5, np.zeros((5, 3))", "answer", "dtype"),
    "ragged": (HEAD + "return [[1], [1, 2]], np.zeros((5, 3))", "answer", "no array of numbers"),
    "writes": (HEAD + "o -= 1\n    " + NOTHING, "exception", "must not be changed"),
    "sorts": (HEAD + "p.sort()\n    " + NOTHING, "exception", "must not be changed"),
    "reads input": (HEAD + "input()", "exception", "EOFError"),
    "of one ray": (HEAD + "if o[0] > 0: pass\n    " + NOTHING, "exception", "a row for each ray"),
    "changes json": ("import json\njson.dumps = lambda *_: '{}'", "ended", "no answer"),
    "forges an error": (
        "import json, os\nfor fd in range(3, 9):\n    try: os.write(fd, json.dumps("
        "dict(ok=False, kind='<b>', message='', trace=[])).encode() + b'\\n')\n"
        "    except OSError: pass",
        "ended",
        "no answer",
    ),
    "forges a trace": (
        "import json, os\nfor fd in range(3, 9):\n    try: os.write(fd, json.dumps("
        "dict(ok=False, kind='exit', message='', trace=[[1, 2]])).encode() + b'\\n')\n"
        "    except OSError: pass",
        "ended",
        "no answer",
    ),
    "forges seconds": (
        HEAD + 'for fd in range(3, 9):\n        try: os.write(fd, b\'{"ok": true, "seconds": '
        "NaN}\\n')\n        except OSError: pass\n    " + NOTHING,
        "ended",
        "no answer",
    ),
    "an endless line": (
        "import os\nfor fd in range(3, 9):\n    try: os.write(fd, b'x' * (1 << 21))\n"
        "    except OSError: pass",
        "ended",
        "no answer",
    ),
    "steers the terminal": (
        "raise ValueError('\x1b[31m\x07 \\udc80 \u202e')",
        "exception",
        r"\x1b[31m\x07 \udc80 \u202e",
    ),
    "evil words": (
        "class E(Exception):\n    def __str__(self):\n        raise self\n" + HEAD + "raise E",
        "exception",
        "E",
    ),
    "evil length": (
        "class L(tuple):\n    def __len__(self):\n        1 / 0\n" + HEAD + "return L()",
        "exception",
        "ZeroDivisionError",
    ),
}


def failure(path, limits=None):
    with Student(path, FORM, limits) as student, pytest.raises(StudentError) as raised:
        student.ask(*RAYS)
    return raised.value


@pytest.mark.parametrize("name", sorted(HOSTILE))
def test_its_own_error(name, written):
    text, kind, words = HOSTILE[name]
    error = failure(written(text))
    assert error.kind == kind
    assert words in error.message
    assert error.to_dict()["line"] == error.line


def test_what_raises_is_asked_case_by_case(written):
    """The others' answers are as they were; a program's own -inf is a miss, and no exception."""
    text = (
        HEAD
        + "assert 3 not in o[:, 0]\n    "
        + "return np.where(o[:, 0] == 4, -np.inf, 7), p[:, 0]"
    )
    rays = np.repeat(np.arange(9.0)[:, None], 3, 1), np.ones((9, 3)), np.ones((9, 3, 3))
    with Student(written(text), FORM) as student:
        t, s = student.ask(*rays)
        assert student.raised.tolist() == [k == 3 for k in range(9)] and student.raises == 1
        error, (origin, *_) = student.first
        assert "AssertionError" in error.message and error.line == 5 and (origin == 3).all()
        assert (
            np.flatnonzero(~np.isfinite(t)).tolist() == [3, 4] and (np.delete(s, 3, 0) == 1).all()
        )


def test_what_raises_in_a_call_and_in_none_of_its_cases_is_the_functions_own(written):
    text = HEAD + "assert len(o) < 3\n    " + NOTHING
    assert failure(written(text)).kind == "exception"


def test_the_line_is_the_files_own(written):
    text = (
        "import numpy as np\n\ndef helper(x):\n    return np.linalg.inv(x)\n\n"
        + HEAD.split("\n\n")[1]
    )
    error = failure(written(text + "return helper(np.zeros((2, 2)))"))
    assert "Singular" in error.message
    assert [t[1] for t in error.trace] == [7, 4] and error.line == 4
    assert {t[0] for t in error.trace} == {"student.py"}
    assert error.trace[0][3] == "return helper(np.zeros((2, 2)))"


def test_line_of_a_syntax_error(written):
    error = failure(written("x = 1\n\ny = (\n"))
    assert error.line == 3


@pytest.mark.parametrize("where", ["in the function", "at import"])
def test_time_limit(where, written):
    loop = "while True:\n        pass" if "function" in where else "pass\nwhile True:\n    pass"
    error = failure(written(HEAD + loop), Limits(seconds=1.5))
    assert error.kind == "time" and "1.5 s" in error.message


def test_the_time_limit_is_of_a_scene(written):
    path = written(HEAD.replace("import os", "import time, os") + "time.sleep(1.0)\n    " + NOTHING)
    with Student(path, FORM, Limits(seconds=3.5)) as student:
        student.ask(*RAYS)
        student.new_scene()
        student.ask(*RAYS)
        with pytest.raises(StudentError, match="time limit"):
            for _ in range(3):
                student.ask(*RAYS)
        student.new_scene()
        student.ask(*RAYS)  # it is started again


def test_memory_limit(written):
    text = HEAD + "a = np.ones(2**28)\n    " + NOTHING
    error = failure(written(text), Limits(memory=1 << 30))
    assert error.kind == "memory" and "the limit is 1 GiB" in error.message


def test_what_it_prints(written):
    text = HEAD + "print('x' * 100, flush=True)\n    " * 3 + "os.write(2, b'y' * 10**6)\n    "
    with Student(written(text + NOTHING), FORM) as student:
        t, s = student.ask(*RAYS)
    assert np.isinf(t).all() and not s.any()
    assert student.printed == 303 + 10**6
    assert len(student.said) == KEPT and student.said.startswith("x" * 100)


def test_nothing_of_it_is_left(written):
    """What it has started ends with it, and Ctrl-C of the terminal is not for it."""
    seconds = f"60.{os.getpid()}"  # no other process sleeps as long
    text = f"import subprocess\nsubprocess.Popen(['sleep', '{seconds}'])\n" + HEAD + NOTHING
    with Student(written(text), FORM) as student:
        student.ask(*RAYS)
        assert running(seconds)
    for _ in range(100):
        if not running(seconds):
            break
        time.sleep(0.05)
    assert not running(seconds)


LIVING_ON = {  # what outlives the student's process, and holds its streams open
    "fork": "if os.fork() == 0:\n    os.setsid()\n    time.sleep(60)\n    os._exit(0)\n",
    "process": "subprocess.Popen(['sleep', '60'], start_new_session=True)\n",
}


@pytest.mark.parametrize("kind", LIVING_ON)
def test_nobody_waits_for_what_lives_on(kind, written):
    text = f"import subprocess, time, os\n{LIVING_ON[kind]}{HEAD}{NOTHING}"
    began = time.monotonic()
    with Student(written(text), FORM) as student:
        assert np.isinf(student.ask(*RAYS)[0]).all()
    with Student(written(text.replace("import sub", "print('x')\nimport sub")), FORM) as student:
        assert np.isinf(student.ask(*RAYS)[0]).all()
        student._process.kill()
        with pytest.raises(StudentError, match=r"SIGKILL|before it had answered"):
            for _ in range(100):  # in the sandbox it is ended a moment later
                student.ask(*RAYS)
                time.sleep(0.05)
    assert time.monotonic() - began < 50  # and not the minute


def test_what_it_may_reach(written, tmp_path):
    """In the sandbox it writes nothing, and does not see the key that records are signed with."""
    key, other = secret(), written("50", "other_record.json")
    text = (
        f"import glob\nkeys = glob.glob({str(tmp_path / 'state' / '*' / '*')!r})\n"
        f"try:\n    open({str(other)!r}, 'w').write('100')\nexcept OSError:\n    pass\n{HEAD}"
        "return np.full(5, len(keys)), p[:, 0]"
    )
    with Student(written(text), FORM) as student:
        assert (student.ask(*RAYS)[0] == 0).all()
    assert (other.read_text() == "50") == bool(sandbox())
    assert bool(key) == bool(sandbox()) and key == secret()


def test_two_processes_give_one_answer(written):
    """A file that forks has a second process, which goes on as if it had been asked."""
    text = "import os\nos.fork()\n" + HEAD + "return o[:, 0], p[:, 0]"
    rays = np.arange(15.0).reshape(5, 3), np.ones((5, 3)), np.ones((5, 3, 3))
    with Student(written(text), FORM) as student:
        for _ in range(3):
            assert student.ask(*rays)[0].tolist() == [0, 3, 6, 9, 12]


@pytest.mark.parametrize("limits", [Limits(seconds=1e12), Limits(memory=1 << 100)])
def test_limits_that_no_system_has(limits, written):
    with Student(written(HEAD + NOTHING), FORM, limits) as student:
        assert np.isinf(student.ask(*RAYS)[0]).all()


def test_what_it_prints_does_not_steer_the_terminal(written):
    with Student(written("print('\x1b[2J<b>', flush=True)\n" + HEAD + NOTHING), FORM) as student:
        student.ask(*RAYS)
    assert student.said == "\\x1b[2J<b>\n"


def test_it_is_given_what_it_is_asked(written, rng):
    """The very numbers, and other forms of answer than arrays."""
    text = HEAD + "return list(o[:, 0]), [list(s) for s in p[:, 1]]"
    rays = rng.normal(size=(7, 3)), rng.normal(size=(7, 3)), rng.normal(size=(7, 3, 3))
    with Student(written(text), FORM) as student:
        for some in (slice(7), slice(0), slice(2, 3)):
            t, s = student.ask(*(r[some] for r in rays))
            assert (t == rays[0][some, 0]).all() and (s == rays[2][some, 1]).all()
    assert student.seconds > 0


def test_it_may_import_what_lies_beside_it(written):
    written("answer = 42.0\n", "helper_beside.py")
    text = "from helper_beside import answer\n" + HEAD + "return np.full(5, answer), p[:, 0]"
    with Student(written(text), FORM) as student:
        assert (student.ask(*RAYS)[0] == 42).all()
    assert "helper_beside" not in sys.modules


def test_random_numbers_are_the_same_every_time(written):
    text = HEAD + "return np.random.rand(5), np.random.rand(5, 3)"
    answers = []
    for _ in range(2):
        with Student(written(text), FORM) as student:
            answers.append(student.ask(*RAYS))
    assert (answers[0][0] == answers[1][0]).all()
