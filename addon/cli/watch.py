"""Says every ten seconds what `reftrace` is doing, where the work has no steps in which it could.

As while a file is read, or Blender draws: `running.meanwhile` names it. A thread says it, which
touches nothing else. The extension leaves it out: in Blender nothing starts threads.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import Event, Thread

from ..wording import show
from . import running


@contextmanager
def watched(wait: Callable[[float], bool] | None = None) -> Iterator[None]:
    """Print on standard error what is named meanwhile, every LINE_EVERY seconds of the block.

    Parameters
    ----------
    wait : callable, optional
        Waits for some seconds, or until the block has ended; returns whether it has.
    """
    end = Event()

    def tell() -> None:
        past = 0.0
        while not (wait or end.wait)(running.LINE_EVERY):
            past += running.LINE_EVERY
            for words in running.named[-1:]:
                with suppress(OSError, ValueError):  # nobody reads it; it is closed
                    show(f"{words} ({past:.0f} s)", file=sys.stderr)

    thread = Thread(target=tell, daemon=True)
    thread.start()
    try:
        yield
    finally:
        end.set()
        thread.join()
