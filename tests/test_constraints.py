"""The pinned versions fit together, for each Python that has some of its own."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, requires, version
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

PINS = (Path(__file__).parents[1] / "constraints.txt").read_text("utf-8")


def pinned(python: str) -> dict[str, str]:
    """The version of each package for a Python."""
    lines = [Requirement(line) for line in PINS.splitlines() if line and line[0] != "#"]
    own = [r for r in lines if not r.marker or r.marker.evaluate({"python_version": python})]
    return {canonicalize_name(r.name): str(r.specifier).removeprefix("==") for r in own}


def contradictions(pins: dict[str, str], python: str) -> Iterator[str]:
    """What the packages that are installed here in their pinned version need of the others."""
    of_python = {"python_version": python, "python_full_version": f"{python}.9", "extra": ""}
    for name, pin in pins.items():
        try:
            needed = requires(name) if version(name) == pin else None
        except PackageNotFoundError:
            continue
        for other in map(Requirement, needed or ()):
            has = pins.get(canonicalize_name(other.name))
            if has and (not other.marker or other.marker.evaluate(of_python)):
                if not other.specifier.contains(has, prereleases=True):
                    yield f"{name} {pin} needs {other}, and {has} is pinned"


@pytest.mark.parametrize("python", ["3.11", "3.13"])
def test_no_pin_contradicts_another(python):
    pins = pinned(python)
    assert len(pins) > 50
    assert not list(contradictions(pins, python))
