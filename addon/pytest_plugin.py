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

import pytest

if TYPE_CHECKING:
    from .comparison.comparison import Comparison

_OPTION = "--reftrace-pages"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option for the pages' folder."""
    parser.getgroup("reference tracer").addoption(
        _OPTION,
        metavar="DIR",
        help="folder for the pages of failed assert_sees (default: the test's own tmp_path)",
    )


@pytest.fixture
def assert_sees(request: pytest.FixtureRequest, tmp_path: Path) -> Callable[..., Comparison]:
    """Return `reference_tracer.testing.assert_sees`, whose failures leave a page."""
    from .testing import assert_sees as check

    asked = request.config.getoption(_OPTION)
    folder = Path(asked, re.sub(r"[^\w.-]+", "-", request.node.nodeid)) if asked else tmp_path
    calls = count(1)

    @wraps(check)
    def seeing(*args: Any, **kwargs: Any) -> Comparison:
        __tracebackhide__ = True
        return check(*args, **{"page": folder / f"sees-{next(calls)}"} | kwargs)

    return seeing
