"""Writes a comparison as one HTML file that opens offline and says why each pixel differs.

`content.py` gathers what it shows, and `page.schema.json` says what that is. `page.html` (and
`pixel.html`, of one derivation) names its style sheets and its scripts; the written file holds
their contents in place of their names. A Content Security Policy lets only these scripts run and
nothing be fetched, so that no name in a scene can do either.
"""

from __future__ import annotations

import base64
import hashlib
import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from ...comparison.comparison import Comparison
from ...comparison.extras import Extras
from ...translations import tables
from ..folders import replacing_file
from .content import content

NAME = "page.html"  # of the file that a comparison leaves

_HERE = Path(__file__).parent
_STYLE = re.compile(r'<link rel="stylesheet" href="([\w.]+)" />')
_SCRIPT = re.compile(r'<script src="([\w.]+)"></script>')
_NO_SCRIPT = "script-src 'none'"  # of the template's policy
_DATA = '<script type="application/json" id="{}"></script>'


def write(
    path: str | Path,
    comparison: Comparison,
    extras: Extras | None = None,
    stored: Mapping[str, bytes] | None = None,
) -> None:
    """Write the page of a comparison, and of what else was found out.

    `stored` is as :func:`content.content` has it.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    text = html(content(comparison, extras, stored=stored))
    with replacing_file(Path(path)) as new:
        new.write_text(text, encoding="utf-8")


def html(held: Mapping[str, object], name: str = NAME) -> str:
    """Return the page that shows this content, by one of this folder's templates."""
    text = template(name)
    text = text.replace(_NO_SCRIPT, _policy([_text(name) for name in _SCRIPT.findall(text)]))
    text = _SCRIPT.sub(lambda m: f"<script>{_text(m[1])}</script>", text)
    for part, given in (("languages", tables("page")), ("data", held)):
        empty = _DATA.format(part)
        text = text.replace(empty, empty.replace("></", f">{json_text(given)}</"))
    return text


def template(name: str) -> str:
    """Return a page of this folder, its style sheets within it."""
    # As functions, here and above: what replaces a match may hold backslashes.
    return _STYLE.sub(lambda m: f"<style>\n{_text(m[1])}</style>", _text(name))


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
    return (_HERE / name).read_text(encoding="utf-8")


def _policy(scripts: Sequence[str]) -> str:
    """Return the part of the policy that lets these scripts run."""
    digests = (base64.b64encode(hashlib.sha256(s.encode()).digest()).decode() for s in scripts)
    return " ".join(["script-src", *(f"'sha256-{digest}'" for digest in digests)])
