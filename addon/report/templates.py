"""Writes pages that open offline, each one file, from the templates in `page/`.

A template names its style sheets and its scripts; the written file holds their contents in place of
their names. A Content Security Policy lets only these scripts run and nothing be fetched, so that
no name in a scene can do either.
"""

from __future__ import annotations

import base64
import hashlib
import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from ..derivation.derivation import Derivation
from ..derivation.formulas import VECTORS
from ..translations import tables
from .plots import Plot
from .shown import data, shown

_HERE = Path(__file__).parent
_STYLE = re.compile(r'<link rel="stylesheet" href="([\w.]+)" />')
_SCRIPT = re.compile(r'<script src="([\w.]+)"></script>')
_NO_SCRIPT = "script-src 'none'"  # of the template's policy
_DATA = '<script type="application/json" id="{}"></script>'


def html(held: Mapping[str, object], name: str = "page.html") -> str:
    """Return the page that shows this content."""
    # As functions, here and below: what replaces a match may hold backslashes.
    text = _STYLE.sub(lambda m: f"<style>\n{_text(m[1])}</style>", _text(name))
    text = text.replace(_NO_SCRIPT, _policy([_text(name) for name in _SCRIPT.findall(text)]))
    text = _SCRIPT.sub(lambda m: f"<script>{_text(m[1])}</script>", text)
    for part, given in (("languages", tables("page")), ("data", held)):
        empty = _DATA.format(part)
        text = text.replace(empty, empty.replace("></", f">{json_text(given)}</"))
    return text


def alone(title: str, derivations: Sequence[Derivation] = (), plots: Sequence[Plot] = ()) -> str:
    """Return a page that shows derivations and plots, and nothing else."""
    held = {
        "title": title,
        "formulas": {"vectors": sorted(VECTORS)},
        "derivations": [*map(shown, derivations)],
        "plots": [*map(data, plots)],
    }
    return html(held, "alone.html")


def json_text(held: Mapping[str, object]) -> str:
    """Return JSON that cannot end a script element, whatever names it holds.

    Raises
    ------
    ValueError
        If a number is not finite.
    """
    text = json.dumps(held, allow_nan=False, ensure_ascii=False, separators=(",", ":"))
    for letter in "<>&":  # which JSON has inside strings only
        text = text.replace(letter, f"\\u{ord(letter):04x}")
    return text.encode("utf-8", "replace").decode("utf-8")  # a lone surrogate is no UTF-8


def _text(name: str) -> str:
    return (_HERE / "page" / name).read_text(encoding="utf-8")


def _policy(scripts: Sequence[str]) -> str:
    """Return the part of the policy that lets these scripts run."""
    digests = (base64.b64encode(hashlib.sha256(s.encode()).digest()).decode() for s in scripts)
    return " ".join(["script-src", *(f"'sha256-{digest}'" for digest in digests)])
