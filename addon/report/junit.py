"""Writes what was judged as JUnit's XML, which systems that run tests read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple
from xml.etree import ElementTree

from ..comparison.comparison import Comparison
from ..comparison.verdict import Verdict
from ..wording import count_of, printable
from .lines import describe, ended


class Judged(NamedTuple):
    """One thing that was judged."""

    name: str
    failure: str = ""  # what is wrong, in a line; empty if nothing is
    detail: str = ""  # the same at length
    seconds: float = 0.0


def junit(name: str, suites: Mapping[str, Sequence[Judged]]) -> str:
    """Return the XML: a suite for each name, with a case for each thing that was judged.

    What XML cannot hold, as control characters, is spelt out.

    References
    ----------
    .. [1] The format has no specification; this is the part that Jenkins, GitLab and pytest share.
    """
    root = ElementTree.Element("testsuites", name=name)
    for suite_name, judged in suites.items():
        failures = str(sum(bool(j.failure) for j in judged))
        own = {"name": printable(suite_name), "tests": str(len(judged)), "failures": failures}
        suite = ElementTree.SubElement(root, "testsuite", own)
        for j in judged:
            said = {"name": printable(j.name), "classname": printable(suite_name)}
            case = ElementTree.SubElement(suite, "testcase", said, time=f"{j.seconds:.3f}")
            if j.failure:
                failure = ElementTree.SubElement(case, "failure", message=printable(j.failure))
                failure.text = printable(j.detail)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode", xml_declaration=True)


def wrong_in(found: Comparison) -> str:
    """Return in a line what is wrong in a comparison; empty if its verdict is *agree*."""
    if found.verdict is Verdict.AGREE:
        return ""
    if found.diagnosis and found.diagnosis.told:
        return "; ".join(told.sentence for told in found.diagnosis.told if not told.alternative)
    if unexplained := found.counts.unexplained:
        return (
            f"{count_of(unexplained, 'pixel differs', 'pixels differ')}, and no cause explains it"
        )
    return ended(found).removeprefix(f"verdict: {found.verdict}").lstrip(": ") or found.verdict


def of_comparison(name: str, found: Comparison, seconds: float = 0.0) -> Judged:
    """Return a comparison as a thing that was judged: only one that agrees passes."""
    return Judged(name, wrong_in(found), "\n".join(describe(found)), seconds)
