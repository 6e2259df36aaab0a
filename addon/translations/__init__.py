"""The interface's words in other languages: a JSON file each, such as `de.json`.

`blender` and `page` are the two that are translated, each English text with its translation. What a
text says of a scene stands in braces: in Blender as for Python's format; in the page `{0}` is
anything, a name or a text that is translated itself, and `{0:,}` a number alone.
"""

from __future__ import annotations

import json
from pathlib import Path

_FOLDER = Path(__file__).parent


def tables(part: str) -> dict[str, dict[str, str]]:
    """Return the translations of a part, by language: English texts, each with its translation.

    Parameters
    ----------
    part : {'blender', 'page'}
        Who shows the texts.
    """
    return {
        file.stem: json.loads(file.read_text(encoding="utf-8"))[part]
        for file in sorted(_FOLDER.glob("*.json"))
    }
