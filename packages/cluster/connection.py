"""An address -> a `Cluster` of workers that are as this process is; or why there is none."""

from __future__ import annotations

import asyncio
import ipaddress
import json
import logging
import re
import signal
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, suppress
from multiprocessing import resource_tracker
from urllib.parse import urlsplit

from reference_tracer.errors import words
from reference_tracer.files.exr import MissingLibraryError
from reference_tracer.scene import SceneError

try:
    import dask.config
    from distributed import Client, LocalCluster, Security
    from distributed.comm import CommClosedError
    from distributed.core import rpc
except ImportError as error:
    raise MissingLibraryError(
        f'--scheduler needs Dask: pip install "reference_tracer[cluster]" ({error})'
    ) from error

from . import tasks
from .cluster import Cluster, ClusterError

TIMEOUT = 6  # seconds: whoever does not answer by then is not there
MOST = 256  # local processes


@contextmanager
def connected(address: str) -> Iterator[Cluster]:
    """Give the workers at an address, and have them drop at the end whatever is not done.

    Raises
    ------
    SceneError
        If it is no address, or one that must be encrypted.
    ClusterError
        If nobody answers, there is no worker, or one is of another version.
    """
    local = re.fullmatch(r"local:(\d+)", address)
    if local and not 1 <= int(local[1]) <= MOST:
        raise SceneError(f"--scheduler {address}: N must be from 1 to {MOST} processes")
    security = None if local else _security(address)
    with _quiet(), _processes(int(local[1])) if local else nullcontext() as own:
        try:
            if not own:
                asyncio.run(asyncio.wait_for(_answered(address, security), TIMEOUT))
            client = Client(
                own or address,
                timeout=TIMEOUT,
                set_as_default=False,
                direct_to_workers=bool(local),  # else there may be no way but the scheduler's
                security=security,
            )
        except (OSError, RuntimeError, TypeError, ValueError) as error:
            do = "start one (docs/cluster.md says how, safely), or try local:2"
            said = f"no scheduler answers at {address} ({words(error)}): {do}"
            raise ClusterError(said) from error
        try:
            cluster = Cluster(client, address)
            _check_workers(cluster)
            yield cluster
        except CommClosedError as error:
            raise ClusterError(f"the scheduler at {address} has ended") from error
        finally:
            client.close(timeout=TIMEOUT)


async def _answered(address: str, security: Security | None) -> None:
    """Return once a scheduler says that it is one: a `Client` waits for ever for who is silent."""
    arguments = security.get_connection_args("client") if security else {}
    async with rpc(address, connection_args=arguments, timeout=TIMEOUT) as asked:
        await asked.identity()


def _security(address: str) -> Security | None:
    """Return how the way to an address is encrypted, as Dask is configured; None where not."""
    try:
        parts = urlsplit(address)
        host, valid = parts.hostname, parts.scheme in ("tcp", "tls") and parts.port
    except ValueError:
        valid = False
    if not valid or not host or parts.path:
        are = "tcp://HOST:PORT, tls://HOST:PORT, or local:N for N processes on this machine"
        raise SceneError(f"--scheduler is {address}; it must be {are}")
    if parts.scheme == "tls":
        security = Security(require_encryption=True)  # as Dask's configuration has it
        if None in (security.tls_ca_file, security.tls_client_cert, security.tls_client_key):
            names = "distributed.comm.tls.ca-file, .client.cert and .client.key"
            raise SceneError(f"--scheduler {address} needs certificates: set {names} for Dask")
        return security
    with suppress(ValueError):
        host = "localhost" if ipaddress.ip_address(host).is_loopback else host
    if host != "localhost":
        why = "is not on this machine, and whoever reaches a Dask scheduler can run code there"
        raise SceneError(f"--scheduler {address} {why}: use tls:// (docs/cluster.md)")
    return None


@contextmanager
def _processes(count: int) -> Iterator[LocalCluster]:
    """Start workers in processes of this machine that nobody else reaches, and end them."""
    # Dask would have malloc give memory back at once: page faults would take as long as tracing.
    kept = {"distributed.nanny.pre-spawn-environ": {"OMP_NUM_THREADS": 1}}
    with _deaf(), dask.config.set(kept):
        own = LocalCluster(
            n_workers=count,
            threads_per_worker=1,
            processes=True,
            host="127.0.0.1",
            dashboard_address=None,
            scheduler_kwargs={"dashboard_address": "127.0.0.1:0"},  # of its health alone
            silence_logs=logging.CRITICAL,
        )
    try:
        yield own
    finally:
        own.close(timeout=TIMEOUT)


@contextmanager
def _deaf() -> Iterator[None]:
    """Have what is started not hear Ctrl-C, which is for this process: it ends them."""
    if hasattr(signal, "pthread_sigmask"):
        resource_tracker.ensure_running()  # which else lets signals through when it is started
        before = signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGHUP))
        try:
            yield
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
    else:
        yield


def _check_workers(cluster: Cluster) -> None:
    """Raise a ClusterError if there is no worker, or some are of other versions."""
    address = cluster.address
    try:
        cluster.client.wait_for_workers(1, timeout=TIMEOUT)
    except TimeoutError:
        do = "start some (docs/cluster.md says how, safely)"
        raise ClusterError(f"the scheduler at {address} has no workers: {do}") from None
    own = tasks.about()
    said = {}
    with suppress(TimeoutError):  # of who is silent; and each task asks again
        options = {"on_error": "return", "callback_timeout": TIMEOUT}
        said = cluster.client.run(tasks.about, **options)
    if wrong := [
        f"worker {w} has {difference(own, t)}" for w, t in sorted(said.items()) if t != own
    ]:
        raise ClusterError("; ".join(wrong))


def difference(own: str, told: object) -> str:
    """Say what a worker has that is another than here."""
    if not isinstance(told, str):
        return f'no usable Reference Tracer ({told}): pip install "reference_tracer[cluster]" there'
    here, there = json.loads(own), json.loads(told)
    found = [f"{k} {there[k]}, not {v}" for k, v in here.items() if there[k] != v]
    return f"{' and '.join(found)}: install the same there as here"


@contextmanager
def _quiet() -> Iterator[None]:
    """Have Dask log nothing: what goes wrong is said in one line of ours."""
    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        yield
    finally:
        logging.disable(before)
