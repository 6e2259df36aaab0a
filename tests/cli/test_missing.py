"""The commands of packages that stand beside the add-on, where the add-on is alone."""

from __future__ import annotations

import subprocess
import sys

import pytest
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import INPUT_ERROR


@pytest.fixture
def alone(monkeypatch):
    """No package but the add-on is installed."""
    monkeypatch.setattr("importlib.metadata.entry_points", lambda group: ())


@pytest.mark.parametrize("name", ["judge", "bench"])
@pytest.mark.parametrize(
    "options",
    [["a.py", "--out", "there"], ["--help"]],
    ids=" ".join,
)
def test_a_sentence_says_how_to_get_it(name, options, alone, capsys):
    assert main([name, *options]) == INPUT_ERROR
    printed = capsys.readouterr()
    assert printed.out == "" and len(printed.err.splitlines()) == 1
    assert f"the command {name} is not part of the add-on" in printed.err
    assert "pip install --editable ." in printed.err


def test_no_mesh_is_named_where_no_reader_is_installed():
    hide = "import importlib.metadata as m; m.entry_points = lambda group: ()"
    run = f"{hide}\nfrom reference_tracer.cli.main import main\nmain(['trace', '--help'])"
    ended = subprocess.run([sys.executable, "-c", run], capture_output=True, text=True)
    assert "scene.blend or scene.npz" in ended.stdout and "a mesh (" not in ended.stdout


@pytest.mark.parametrize("name", ["judge", "bench"])
def test_installed_it_has_its_own_help(name, capsys):
    with pytest.raises(SystemExit) as end:
        main([name, "--help"])
    assert end.value.code == 0 and f"reftrace {name}" in capsys.readouterr().out
