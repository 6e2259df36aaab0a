"""A bar on the terminal for work that takes long."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from .. import interrupts


@contextmanager
def progress_bar() -> Iterator[Callable[[float], None]]:
    """Show a bar on standard error, if it is a terminal and tqdm is there."""
    interrupts.check()
    try:
        from tqdm import tqdm
    except ImportError:
        if sys.stderr.isatty():
            print(
                "reftrace: no progress bar without tqdm: pip install 'reference_tracer[progress]'",
                file=sys.stderr,
            )
        yield lambda share: interrupts.check()
        return
    layout = "{percentage:3.0f} %|{bar}| {elapsed}, {remaining} left"
    with tqdm(total=1.0, bar_format=layout, disable=None, leave=False) as bar:

        def show(share: float) -> None:
            interrupts.check()
            bar.update(share - bar.n)

        yield show
