"""Write the parts of docs/explain.md that the program makes: `python tools/explain_docs.py`.

They are between <!-- NAME --> and <!-- end -->. A test holds the page to them.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from reference_tracer.explain import formulas, markdown, reproducer
from reference_tracer.explain.derivation import derive_pixel

DOCS = Path(__file__).resolve().parents[1] / "docs"
PAGE, PIXEL = DOCS / "explain.md", DOCS / "pixel.json"
_PART = re.compile(r"(<!-- ([a-z-]+) -->\n).*?(\n<!-- end -->)", re.DOTALL)


def formula_table() -> str:
    """Every formula of a ray and a triangle, in the order in which it is computed."""
    lines = ["| | formula | |", "|---|---|---|"]
    orthographic = [f._replace(remark="orthographic") for f in formulas.RAY[True].values()]
    of = [*formulas.CAMERA.values(), *formulas.RAY[False].values(), *orthographic]
    of += [*formulas.TRIANGLE.values(), *formulas.COLOR.values()]
    lines += [f"| {f.label} | {f.right} | {f.remark} |" for f in of if f.right]
    return "\n".join(lines)


def parts() -> dict[str, str]:
    """What goes where."""
    blocks = markdown.text(derive_pixel(reproducer.read(PIXEL))).split("\n\n")

    def after(start: str, count: int) -> str:
        first = next(k for k, block in enumerate(blocks) if block.startswith(start))
        return "\n\n".join(blocks[first + 1 : first + 1 + count])

    return {
        "formulas": formula_table(),
        "errata": "\n".join(f"{k}. {e}" for k, e in enumerate(formulas.ERRATA, 1)),
        "candidates": after("## 2. What the ray may meet", 2),
        "test": after("### 2.1", 3),
        "methods": after("## 3. The nearest", 4),
    }


def refreshed(page: str) -> str:
    """The page with its parts as the program makes them now."""
    made = parts()
    return _PART.sub(lambda m: f"{m[1]}\n{made[m[2]]}\n{m[3]}", page)


if __name__ == "__main__":
    PAGE.write_text(refreshed(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
    sys.exit(0)
