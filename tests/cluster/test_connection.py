"""Which workers are taken: those that answer, are of the same version, and are reached safely."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import time

import dask.config
import psutil
import pytest
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import INPUT_ERROR
from reference_tracer.files.scenes import save_scene
from reference_tracer.rendering import render
from reference_tracer.scene import SceneError
from reference_tracer_cluster import connection, pictures
from reference_tracer_cluster.cluster import ClusterError
from reference_tracer_cluster.connection import connected

from .conftest import dask as running_dask

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    ("address", "said"),
    [
        ("local:0", "from 1 to 256"),
        ("local:257", "from 1 to 256"),
        ("local:-1", "must be tcp://HOST:PORT"),
        ("local:two", "must be tcp://HOST:PORT"),
        ("127.0.0.1:8786", "must be tcp://HOST:PORT"),
        ("tcp://127.0.0.1", "must be tcp://HOST:PORT"),
        ("tcp://127.0.0.1:99999", "must be tcp://HOST:PORT"),
        ("ucx://127.0.0.1:8786", "must be tcp://HOST:PORT"),
        ("tcp://:8786", "must be tcp://HOST:PORT"),
        ("tcp://192.0.2.1:8786", "use tls://"),
        ("tcp://[2001:db8::1]:8786", "use tls://"),
        ("tcp://localhost.example.org:8786", "use tls://"),
        ("tls://127.0.0.1:8786", "needs certificates"),
    ],
)
def test_an_address_is_refused(address, said):
    with pytest.raises(SceneError, match=said), connected(address):
        pass


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "127.8.9.10", "[::1]"])
def test_this_machine_needs_no_certificates(host):
    assert connection._security(f"tcp://{host}:8786") is None


@pytest.mark.parametrize("listens", [False, True])
def test_nobody_answers(listens, monkeypatch):
    """Nor where something listens that is no scheduler."""
    assert connection.TIMEOUT < 10
    monkeypatch.setattr(connection, "TIMEOUT", 0.5)
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        if listens:
            other.listen()
        address = f"tcp://127.0.0.1:{other.getsockname()[1]}"
        with pytest.raises(ClusterError, match="no scheduler answers"), connected(address):
            pass


# Workers that are of other versions than they are.
OTHERS = {
    "numpy": "import numpy; numpy.__version__ = '1.0.0'",
    "code": "import reference_tracer; reference_tracer.__version__ = '0.0.9'",
    "nothing": "import sys; sys.modules['reference_tracer_cluster'] = None",
}


def test_workers_of_other_versions_are_named(tmp_path, monkeypatch):
    monkeypatch.setattr(connection, "TIMEOUT", 2.0)
    with running_dask(tmp_path) as running:
        with pytest.raises(ClusterError, match="has no workers"), connected(running.address):
            pass
        names = {}
        for name, code in OTHERS.items():
            (tmp_path / f"{name}.py").write_text(code)
            names[name] = running.work(name, "--preload", str(tmp_path / f"{name}.py"))
        monkeypatch.undo()
        with pytest.raises(ClusterError) as error, connected(running.address):
            pass
    said = {part.split()[1]: part for part in str(error.value).split("; ")}
    assert "has numpy 1.0.0, not " in said[names["numpy"]]
    assert "has Reference Tracer 0.0.9 (code" in said[names["code"]]
    assert "has no usable Reference Tracer" in said[names["nothing"]]


def test_who_joins_later_is_asked_too(tmp_path, scene):
    (tmp_path / "late.py").write_text(OTHERS["numpy"])
    with running_dask(tmp_path) as running:
        running.work("first")
        with connected(running.address) as cluster:
            running.end("first")
            late = running.work("late", "--preload", str(tmp_path / "late.py"))
            with pytest.raises(ClusterError, match=f"worker {late} is of another version"):
                render(scene, tracer=pictures.tracer(cluster))


def test_with_certificates(tmp_path, scene):
    key, certificate = str(tmp_path / "key.pem"), str(tmp_path / "certificate.pem")
    made = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-subj", "/CN=here"]
    subprocess.run([*made, "-keyout", key, "-out", certificate], check=True, capture_output=True)
    tls = ("--tls-ca-file", certificate, "--tls-cert", certificate, "--tls-key", key)
    own = {"ca-file": certificate, "client.cert": certificate, "client.key": key}
    own = {f"distributed.comm.tls.{name}": file for name, file in own.items()}
    with running_dask(tmp_path, *tls) as running:
        running.work("first")
        with dask.config.set(own), connected(running.address) as cluster:
            found = render(scene, tracer=pictures.tracer(cluster))
        with pytest.raises(ClusterError, match="no scheduler answers"):
            with connected(running.address.replace("tls", "tcp")):
                pass
    assert running.address.startswith("tls://") and (found.t == render(scene).t).all()


def test_own_processes_end_with_it(tmp_path, scene, capsys):
    """Whether it is done, or a terminal's Ctrl-C ends it."""
    path = tmp_path / "scene.npz"
    save_scene(path, scene)
    command = "trace", str(path), "--scheduler", "local:2", "--out", str(tmp_path / "picture.exr")
    before = set(psutil.Process().children(recursive=True))
    assert main(command) == 0
    left = set(psutil.Process().children(recursive=True)) - before
    assert not [p for p in left if "resource_tracker" not in str(p.cmdline())]
    many = "--samples", "64", "--method", "textbook"
    argv = [sys.executable, "-m", "reference_tracer.cli.main", *command, *many]
    work = subprocess.Popen(argv, start_new_session=True, stderr=subprocess.PIPE, text=True)
    workers: list[psutil.Process] = []
    while len([p for p in workers if p.cpu_times().user > 0.8]) < 2:
        assert work.poll() is None
        time.sleep(0.1)
        workers = psutil.Process(work.pid).children(recursive=True)
    os.killpg(work.pid, signal.SIGINT)
    assert work.communicate()[1].strip() == "reftrace: interrupted"
    assert work.returncode == 130 and not psutil.wait_procs(workers, timeout=30)[1]


def test_without_dask(monkeypatch, tmp_path, capsys):
    monkeypatch.setitem(sys.modules, "distributed", None)
    monkeypatch.delitem(sys.modules, "reference_tracer_cluster.connection")
    argv = ["extremes", "--out", str(tmp_path / "out"), "--scheduler", "local:2"]
    assert main(argv) == INPUT_ERROR
    assert 'pip install "reference_tracer[cluster]"' in capsys.readouterr().err
