"""Says a comparison in sentences, the most important first."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ..causes.cause import UNEXPLAINED
from ..comparison.comparison import Comparison
from ..comparison.verdict import Verdict
from ..diagnosis.evidence import shows_colors
from ..diagnosis.fault_rows import table
from ..tracer.hits import NOTHING
from ..wording import count_of


def describe(found: Comparison) -> list[str]:
    """Return a comparison in sentences: what a person wants to know first, a fact a line."""
    counts = found.counts
    settings, traced = found.case.settings, found.frame.statistics
    return [
        f"{counts.agree:,} of {counts.total:,} pixels agree with "
        f"{found.case.picture.source}, {counts.differ:,} differ",
        *_of_transform(found),
        *_of_causes(found),
        *_evidence(found),
        *(found.diagnosis.lines() if found.diagnosis else ()),
        *_of_other_colors(found),
        *_measured(found),
        f"traced {count_of(traced.triangles, 'triangle')} in {traced.seconds:.2f} s "
        f"({traced.method}, {settings.precision}, {settings.samples} x {settings.samples} rays "
        "a pixel)",
        *(row.line() for row in found.methods),
        *found.required,
        *table(found.self_check),
        ended(found),
    ]


def ended(found: Comparison) -> str:
    """Return the verdict, and why it is no better than a warning, or what it leaves out."""
    said = f"verdict: {found.verdict.in_words(found.counts).lower()}"
    why: Iterable[str] = ()
    if found.verdict in (Verdict.WARNINGS, Verdict.NOT_COMPARABLE):
        why = [doubt for doubt in dict.fromkeys(found.doubts()) if doubt not in said]
    elif found.background and not found.background.transparent:
        why = (found.background.unjudged(),)
    elif presumed := found.case.picture.presumed:
        why = (presumed,)
    return f"{said} ({'; '.join(why)})" if why else said


def _of_transform(found: Comparison) -> Iterator[str]:
    """Say which transform of all colours is what is wrong, and what to do about it."""
    if found.advice:
        yield f"diagnosis: the picture's colours: {found.causes.transform}"
        yield f"           what to do: {found.advice}"
    elif found.causes.transform:
        yield f"colours: {found.causes.transform}"


def _of_causes(found: Comparison) -> Iterator[str]:
    """Say how many pixels have each cause, and where the first of them are."""
    for cause, count in found.counts.of_causes():
        first = found.counts.examples.get(cause.key, ())[:3]
        at = ", ".join(f"({x}, {y})" for x, y in first)
        yield f"  {cause.label}: {count:,}" + (f", as at {at}" if at else "")
    if more := found.causes.not_asked:
        yield f"  (nearly none of those asked first has a cause: {more:,} more were not asked)"


def _of_other_colors(found: Comparison) -> Iterator[str]:
    """Say that most surfaces are shown in colours that none has, where no fault was found."""
    case, diagnosis = found.case, found.diagnosis
    if not case.picture.has_colors or (diagnosis and diagnosis.told):
        return
    surfaces = (found.frame.object_index != NOTHING).reshape(case.picture.color.shape[:2])
    other = (found.causes.cause == UNEXPLAINED).reshape(surfaces.shape) & surfaces
    if 2 * other.sum() <= surfaces.sum():
        return
    own = shows_colors(case.picture.at(other), case.scene.color_table)
    if 2 * (~own).sum() > surfaces.sum():
        yield "most surfaces are shown in other colours than the scene's"
        yield "           Draw each flat, in those that --colors-out writes"


def _measured(found: Comparison) -> Iterator[str]:
    m = found.metrics
    x, y = m.largest_difference.pixel
    most = f"largest difference {m.largest_difference.value:.3g} at pixel ({x}, {y})"
    if not m.rmse:
        most = "no difference anywhere"
    if said := found.case.picture.measured(m):
        yield f"{said}, {most}"


def _evidence(found: Comparison) -> Iterator[str]:
    """Say what else was found out about the pixels that differ."""
    causes, certificate = found.causes, found.case.certificate
    inside, rim = found.counts.interior, found.counts.boundary
    yield (
        f"{inside.differ:,} of {inside.total:,} interior and {rim.differ:,} of "
        f"{rim.total:,} boundary pixels differ"
    )
    if found.case.picture.source.file:
        words, known = found.case.picture.sampling.renderer.words, found.case.picture.source.known
        why = f", {known}" if known else ""
        yield f"a pixel may differ by the rounding of {words}{why} (--excuse renderer)"
    if found.background:
        yield found.background.line()
    if found.empty:
        yield "the picture is empty: no ray meets anything"
    yield from found.not_judged()
    yield from (shade.line() for shade in causes.shades)
    yield from (f"only one side shows {h}" for h in dict.fromkeys(causes.hidden))
    shows = found.counts.unexplained_shows
    if shows and found.counts.unexplained:
        yield (
            f"of the unexplained pixels {shows.same_object:,} show the same object in "
            f"another colour, {shows.other_object:,} another object"
        )
    if certificate:
        yield certificate.line()
