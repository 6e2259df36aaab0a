"""What the pages on grading say of each subject, from its record."""

from __future__ import annotations

from collections.abc import Iterable

from reference_tracer_grading.mutations import mutations
from reference_tracer_grading.subjects import NAMES, subject


def values() -> dict[str, str]:
    """Return every part by its name: lines, groups of cases, slips, counts of wrong programs."""
    out = {}
    for name in NAMES:
        own = subject(name)
        given = ",".join(field.columns for field in own.form.given)
        out[f"given_{name}"] = f"`{given}`"
        out[f"signature_{name}"] = f"`{own.form.signature}`"
        out[f"line_{name}"] = f"`{own.form.line}`"
        shares = (f"{part} {weight:g}" for part, weight in own.weights.items())
        out[f"weights_{name}"] = ", ".join(shares)
        count = sum(1 for program in own.programs for _ in mutations(program))
        out[f"mutations_{name}"] = str(count)
        groups = (f"| `{group}` | {shows} |" for group, shows in own.groups.items())
        out[f"groups_{name}"] = _table("| cases | what they show |", groups)
        slips = {slip.name: slip.sentence for program in own.programs for slip in program.slips}
        named = (
            f"| `{slip}` | {sentence.replace('|', '&#124;')} |" for slip, sentence in slips.items()
        )
        out[f"slips_{name}"] = _table("| name | what is wrong |", named)
    return out


def _table(head: str, rows: Iterable[str]) -> str:
    return "\n".join(("", head, "|---|---|", *rows, ""))
