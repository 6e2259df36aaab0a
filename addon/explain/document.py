"""A derivation as a lecture: headings, sentences and tables, for Markdown and HTML alike.

In comes a `Derivation`; out goes a list of blocks, which hold text and no markup.
"""

from __future__ import annotations

from ..images import to_display
from ..tracer.certified.certainty import Certainty
from . import blocks
from .blocks import Block, Heading, Paragraph, Table, numbers
from .derivation import Derivation, Test
from .digits import digits_text
from .formulas import ERRATA
from .pixel import CERTAINTY_SENTENCES
from .textbook import FLOATS, Arithmetic, Judgement

READING = (
    "How to read the tables: every number is computed three times, from the same input and by the "
    "same formula: in float32, in float64, and exactly, with fractions of integers. A float "
    "is written with as many digits as tell it from its neighbours; marked digits are wrong. “off” "
    "is the error in ulp, units in the last place: a number that is as good as its type allows is "
    "off by 0.5 at most. An exact number that ends in … has more digits (the JSON has it whole, as "
    "a fraction)."
)


def lecture(derivation: Derivation) -> list[Block]:
    """Return the whole lecture."""
    return [
        *_opening(derivation),
        *_camera(derivation),
        *_candidates(derivation),
        *(
            block
            for k, test in enumerate(derivation.tests, 1)
            for block in _test(k, test, test.candidate is derivation.seen)
        ),
        *_nearest(derivation),
        *_color(derivation),
        *_certain(derivation),
    ]


def document_markdown(derivation: Derivation) -> str:
    """Return the lecture as Markdown."""
    return "\n\n".join(map(blocks.markdown, lecture(derivation))) + "\n"


def _opening(derivation: Derivation) -> list[Block]:
    pixel, camera = derivation.pixel, derivation.pixel.camera
    of = f" of {pixel.source}" if pixel.source else ""
    part = ""
    if (camera.region.width, camera.region.height) != (camera.width, camera.height):
        part = (
            f" The border shows a part: this is pixel ({pixel.column}, {pixel.row}) of the whole."
        )
    other_t = []  # of what is seen: the one that the tables come to
    if test := derivation.seen_test:
        t = digits_text(test.number("t", Arithmetic.FLOAT64))
        other_t.append(Paragraph(f"By the textbook’s formula in float64, t = {t} m.", "note"))
    return [
        Heading(1, f"The ray through pixel ({pixel.x}, {pixel.y}){of}"),
        Paragraph(answer_sentence(derivation), "answer"),
        *other_t,
        Paragraph(
            f"Camera “{camera.name}”: {camera.projection.name}, {camera.width} × {camera.height} "
            f"pixels, it shows depths from {digits_text(float(camera.clip_start))} m to "
            f"{digits_text(float(camera.clip_end))} m. "
            f"Pixel (0, 0) is the lower left.{part}"
        ),
        Paragraph(READING, "note"),
    ]


def answer_sentence(derivation: Derivation) -> str:
    """Return what is seen, in a sentence, and where its t comes from."""
    seen = derivation.seen
    if seen is None:
        return "The ray meets nothing within the clip range: the pixel shows the background."
    proven = derivation.certified.certainty is not Certainty.NOT_CERTIFIED
    origin = "proven: the exact value, rounded once" if proven else "not proven"
    return (
        f"The pixel sees {seen.title}, at t = {digits_text(derivation.certified.t)} m ({origin})."
    )


def _camera(derivation: Derivation) -> list[Block]:
    return [
        Heading(2, "1. From the pixel to the ray", "1"),
        Paragraph(
            "The camera looks through its view window, which the pixels divide evenly. The ray "
            "through the middle of a pixel is x = o + t d."
        ),
        numbers(derivation.camera),
        Paragraph(
            "From here on, the ray in float64 and the corners in float64 are the scene, exactly as "
            "they are stored; the exact numbers below are about them. Float32 has them rounded."
        ),
        numbers(derivation.ray),
    ]


def _candidates(derivation: Derivation) -> list[Block]:
    pixel, tests = derivation.pixel, derivation.tests
    triangles = sum(not t.candidate.is_plane for t in tests)
    planes = len(tests) - triangles
    lines = [
        f"Of {pixel.triangles:,} triangles in the scene, {triangles + pixel.left_out:,} have a box "
        "on the film that holds the pixel's centre, before the eye or behind it; no other can be "
        "met."
    ]
    if pixel.left_out:
        lines.append(
            f"{triangles:,} of them are below, {pixel.left_out:,} are left out: first comes what "
            "the textbook accepts, the nearest first, then what the ray passes most closely."
        )
    if planes:
        lines.append(f"Infinite planes may be met by any ray: {planes:,}, all below.")
    if pixel.refused:
        lines.append(f"{pixel.refused:,} triangles have a corner that is not finite: left out.")
    out: list[Block] = [Heading(2, "2. What the ray may meet", "2"), Paragraph(" ".join(lines))]
    if not tests:
        return out
    rows = tuple(_summary(k, test) for k, test in enumerate(tests, 1))
    out.append(Table(("", "surface", "t", "s₁", "s₂", "s₃", *(k.value for k in Arithmetic)), rows))
    if triangles:
        out += [Paragraph(f"Erratum {k}: {e}", "note") for k, e in enumerate(ERRATA, 1)]
    return out


def _summary(number: int, test: Test) -> tuple[str, ...]:
    values = {q.key: digits_text(q.values[Arithmetic.FLOAT64][0]) for q in test.quantities}
    said = [test.verdicts[kind].accepted for kind in Arithmetic]
    cells = (values.get(key, "") for key in ("t", "s1", "s2", "s3"))
    return f"2.{number}", test.candidate.title, *cells, *("hit" if s else "no" for s in said)


def _test(number: int, test: Test, is_seen: bool) -> list[Block]:
    c = test.candidate
    mesh = "" if c.is_plane else f" (mesh “{c.mesh}”, instance {c.instance}, slot {c.slot})"
    rows = tuple(_verdict(kind, test.verdicts[kind]) for kind in Arithmetic)
    out: list[Block] = [
        Heading(3, f"2.{number} {c.title}{mesh}", f"2-{number}", not is_seen),
        numbers(test.quantities),
        Table(("", "verdict", "why", "as printed"), rows),
    ]
    truth = test.verdicts[Arithmetic.EXACT].accepted
    for kind in FLOATS:
        said = test.verdicts[kind].accepted
        if said != truth:
            does = "accepts what is truly missed" if said else "rejects what is truly hit"
            out.append(Paragraph(f"{kind.capitalize()} {does}.", "warning"))
    return out


def _verdict(kind: Arithmetic, verdict: Judgement) -> tuple[str, ...]:
    why = "; ".join(r.sentence for r in verdict.reasons) or "all conditions hold"
    printed = {None: "–", True: "hit", False: "no"}[verdict.literal]
    if verdict.accepted and verdict.literal is False:
        printed = "lost: the sum is not 1"
    return kind.value, "accepted" if verdict.accepted else "rejected", why, printed


def _nearest(derivation: Derivation) -> list[Block]:
    rows = [(kind.value, "nothing", "–") for kind in Arithmetic]
    for at, (kind, k) in enumerate(derivation.nearest.items()):
        if k is not None:
            test = derivation.tests[k]
            rows[at] = kind.value, test.candidate.title, digits_text(test.number("t", kind))
    methods = tuple(
        (
            a.method.value,
            a.precision.value,
            derivation.title_of(a.seen),
            digits_text(a.precision.dtype.type(a.t)),
            "as proven" if a.seen == derivation.certified.seen else "differs",
        )
        for a in derivation.answers
    )
    return [
        Heading(2, "3. The nearest", "3"),
        Paragraph("Of all that is accepted, the least t is seen: the textbook's answer."),
        Table(("", "sees", "t"), tuple(rows)),
        Paragraph("What the tracer's methods see of these, beside what is proven:"),
        Table(("method", "precision", "sees", "t", ""), methods),
    ]


def _color(derivation: Derivation) -> list[Block]:
    seen = derivation.seen
    if seen is None:
        said = "Nothing is met, so the pixel has the background's colour."
    elif len(seen.colors) > 1 and not derivation.shading:
        said = "A colour at a corner is not finite, and so the mean of the corners' may not be."
    elif derivation.shading:
        said = "The colour is the mean of those at the corners, weighed by s₁, s₂, s₃; alpha is 1."
    elif seen.is_plane:
        said = f"Constant shading: the colour of {seen.object}; alpha is 1."
    else:
        said = (
            f"Constant shading: the colour of material slot {seen.slot} of {seen.object}; alpha is "
            "1 on every surface, and light plays no part."
        )
    steps: list[Block] = [numbers(derivation.shading)] if derivation.shading else []
    rgba = ", ".join(digits_text(v) for v in derivation.color)
    shown = to_display([[derivation.color]])[0, 0, :3]
    srgb = "#" + "".join(f"{v:02x}" for v in shown)
    text_ = f"linear RGBA ({rgba}); on a screen (sRGB) {srgb}"
    return [Heading(2, "4. Its colour", "4"), Paragraph(said), *steps, Paragraph(text_, "", srgb)]


def _certain(derivation: Derivation) -> list[Block]:
    certified = derivation.certified
    said = CERTAINTY_SENTENCES[certified.certainty]
    out: list[Block] = [
        Heading(2, "5. How certain this is", "5"),
        Paragraph(f"{answer_sentence(derivation)} This is {said}.", "answer"),
    ]
    if certified.ties:
        names = "; ".join(sorted(derivation.title_of(n) for n in certified.ties))
        out.append(Paragraph(f"All that this pixel may be said to see: {names}.", "warning"))
    return out
