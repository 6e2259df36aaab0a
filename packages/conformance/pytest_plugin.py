"""A plugin of pytest: the fixture `assert_sees`, whose failures leave a page.

It imports nothing of the tracer before the fixture is used.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import wraps
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any
from zlib import crc32

import pytest

if TYPE_CHECKING:
    from reference_tracer.comparison.comparison import Comparison

_OPTION = "--reftrace-pages"
_LONGEST = 120  # bytes of a folder's name: file systems allow 255, and some less for a whole path


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option for the pages' folder."""
    parser.getgroup("reference tracer").addoption(
        _OPTION,
        metavar="DIR",
        help="folder for the pages of failed assert_sees (default: the test's own tmp_path)",
    )


@pytest.fixture
def assert_sees(request: pytest.FixtureRequest, tmp_path: Path) -> Callable[..., Comparison]:
    """Return `reference_tracer_conformance.testing.assert_sees`, whose failures leave a page."""
    from .testing import assert_sees as check

    asked = request.config.getoption(_OPTION)
    folder = Path(asked, _name_of(request.node.nodeid)) if asked else tmp_path
    calls = count(1)

    @wraps(check)
    def seeing(*args: Any, **kwargs: Any) -> Comparison:
        __tracebackhide__ = True
        return check(*args, **{"page": folder / f"sees-{next(calls)}"} | kwargs)

    return seeing


def _name_of(test: str) -> str:
    """Return a folder's name for a test; one that is too long for a file system ends in a number.

    Parameters
    ----------
    test : str
        Its id in pytest, with all its parameters.
    """
    name = re.sub(r"[^\w.-]+", "-", test)
    if len(name.encode()) <= _LONGEST:
        return name
    short = name.encode()[:_LONGEST].decode(errors="ignore")
    return f"{short}-{crc32(test.encode(errors='replace')):08x}"
