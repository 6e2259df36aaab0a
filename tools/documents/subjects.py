"""What the pages on grading say of each subject, from its record."""

from __future__ import annotations

from reference_tracer_grading.mutations import mutations
from reference_tracer_grading.subjects import NAMES, subject


def values() -> dict[str, str]:
    """Return every part by its name: lines, counts of wrong programs, names of slips and groups."""
    out, named = {}, {}
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
        slips = (f"`{slip.name}`" for program in own.programs for slip in program.slips)
        named[name] = ", ".join(dict.fromkeys(slips)), ", ".join(f"`{g}`" for g in own.groups)
    for k, part in enumerate(("slips", "groups")):
        rows = (f"| `{name}` | {texts[k]} |" for name, texts in named.items() if texts[k])
        out[part] = "\n".join(("", "| `--subject` | names |", "|---|---|", *rows, ""))
    return out
