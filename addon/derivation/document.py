"""Turns a derivation into a lecture: headings, sentences, tables, for Markdown and pages alike.

The blocks hold text and no markup. The sentences are in `document.toml`.
"""

from __future__ import annotations

import tomllib
from pathlib import Path

from ..certainty import Certainty
from ..files.images import hex_color
from . import blocks
from .blocks import Block, Heading, Paragraph, Table, numbers
from .derivation import Derivation, Test
from .digits import digits_text
from .formulas import ERRATA
from .textbook import FLOATS, Arithmetic, Judgement

_TEXTS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
_NOTHING = "nothing", "–"  # is seen, and its t
CERTAINTY_SENTENCES = {c: _TEXTS["certainty"][c.name.lower()] for c in Certainty}


def _text(name: str, **of: object) -> str:
    return _TEXTS[name].strip().format(**of)


def _said(name: str, tone: str = "", **of: object) -> Paragraph:
    return Paragraph(_text(name, **of), tone)


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
    start, end = (digits_text(t) for t in (camera.clip_start, camera.clip_end))
    shown = [_text("camera", camera=camera, start=start, end=end)]
    if (camera.region.width, camera.region.height) != (camera.width, camera.height):
        shown.append(_text("border", pixel=pixel))
    out: list[Block] = [
        Heading(1, f"The ray through pixel ({pixel.x}, {pixel.y}){of}"),
        Paragraph(answer_sentence(derivation), "answer"),
    ]
    if test := derivation.seen_test:  # its other t: the one that the tables come to
        t = digits_text(test.number("t", Arithmetic.FLOAT64))
        out.append(_said("other_t", "note", t=t))
    return [*out, Paragraph(" ".join(shown)), _said("reading", "note")]


def answer_sentence(derivation: Derivation) -> str:
    """Return the surface that is seen, in a sentence, and where its t comes from."""
    seen, certified = derivation.seen, derivation.certified
    if seen is None:
        return _text("background")
    proven = certified.certainty is not Certainty.NOT_CERTIFIED
    origin = _text("proven" if proven else "not_proven")
    return _text("answer", seen=seen, t=digits_text(certified.t), origin=origin)


def _camera(derivation: Derivation) -> list[Block]:
    return [
        Heading(2, "1. From the pixel to the ray", "1"),
        _said("window"),
        numbers(derivation.camera),
        _said("stored"),
        numbers(derivation.ray),
    ]


def _candidates(derivation: Derivation) -> list[Block]:
    pixel, tests = derivation.pixel, derivation.tests
    triangles = sum(not t.candidate.is_plane for t in tests)
    planes = len(tests) - triangles
    lines = [_text("boxes", pixel=pixel, count=triangles + pixel.left_out)]
    if pixel.left_out:
        lines.append(_text("left_out", pixel=pixel, triangles=triangles))
    if planes:
        lines.append(_text("planes", planes=planes))
    if pixel.refused:
        lines.append(_text("refused", pixel=pixel))
    out: list[Block] = [Heading(2, "2. What the ray may meet", "2"), Paragraph(" ".join(lines))]
    if not tests:
        return out
    rows = tuple(_summary(k, test) for k, test in enumerate(tests, 1))
    out.append(Table(("", "surface", "t", "s₁", "s₂", "s₃", *(k.value for k in Arithmetic)), rows))
    if triangles:
        out += [_said("erratum", "note", number=k, erratum=e) for k, e in enumerate(ERRATA, 1)]
    return out


def _summary(number: int, test: Test) -> tuple[str, ...]:
    values = {q.key: digits_text(q.values[Arithmetic.FLOAT64][0]) for q in test.quantities}
    said = [test.judgements[kind].accepted for kind in Arithmetic]
    cells = (values.get(key, "") for key in ("t", "s1", "s2", "s3"))
    return f"2.{number}", test.candidate.title, *cells, *("hit" if s else "no" for s in said)


def _test(number: int, test: Test, is_seen: bool) -> list[Block]:
    c = test.candidate
    mesh = "" if c.is_plane else f" (mesh “{c.mesh}”, instance {c.instance}, slot {c.slot})"
    rows = tuple(_judgement(kind, test.judgements[kind]) for kind in Arithmetic)
    out: list[Block] = [
        Heading(3, f"2.{number} {c.title}{mesh}", f"2-{number}", not is_seen),
        numbers(test.quantities),
        Table(("", "verdict", "why", "as printed"), rows),
    ]
    truth = test.judgements[Arithmetic.EXACT].accepted
    for kind in FLOATS:
        said = test.judgements[kind].accepted
        if said != truth:
            out.append(_said("accepts" if said else "rejects", "warning", kind=kind.capitalize()))
    return out


def _judgement(kind: Arithmetic, said: Judgement) -> tuple[str, ...]:
    why = "; ".join(r.sentence for r in said.reasons) or "all conditions hold"
    printed = {None: "–", True: "hit", False: "no"}[said.literal]
    if said.accepted and said.literal is False:
        printed = "lost: the sum is not 1"
    return kind.value, "accepted" if said.accepted else "rejected", why, printed


def _nearest(derivation: Derivation) -> list[Block]:
    rows = []
    for kind, k in derivation.nearest.items():
        test = None if k is None else derivation.tests[k]
        seen = (test.candidate.title, digits_text(test.number("t", kind))) if test else _NOTHING
        rows.append((kind.value, *seen))
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
        _said("nearest"),
        Table(("", "sees", "t"), tuple(rows)),
        _said("methods"),
        Table(("method", "precision", "sees", "t", ""), methods),
    ]


def _color(derivation: Derivation) -> list[Block]:
    seen = derivation.seen
    if seen is None:
        why = "color_of_background"
    elif len(seen.colors) > 1 and not derivation.shading:
        why = "color_not_finite"
    elif derivation.shading:
        why = "color_mean"
    else:
        why = "color_of_plane" if seen.is_plane else "color_of_slot"
    steps: list[Block] = [numbers(derivation.shading)] if derivation.shading else []
    rgba = ", ".join(digits_text(v) for v in derivation.color)
    srgb = hex_color(derivation.color)
    value = Paragraph(_text("rgba", rgba=rgba, srgb=srgb), "", srgb)
    return [Heading(2, "4. Its colour", "4"), _said(why, seen=seen), *steps, value]


def _certain(derivation: Derivation) -> list[Block]:
    certified = derivation.certified
    sentence, answer = CERTAINTY_SENTENCES[certified.certainty], answer_sentence(derivation)
    out: list[Block] = [
        Heading(2, "5. How certain this is", "5"),
        _said("certain", "answer", answer=answer, sentence=sentence),
    ]
    if certified.ties:
        names = "; ".join(sorted(derivation.title_of(n) for n in certified.ties))
        out.append(_said("ties", "warning", names=names))
    return out
