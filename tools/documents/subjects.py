"""The records of the grading's subjects as Markdown."""

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
        slips = [slip.name for program in own.programs for slip in program.slips]
        named[name] = [dict.fromkeys(names) for names in (slips, own.groups)]
    for k, part in enumerate(("slips", "groups")):
        listed: set[str] = set()
        rows = ["", "| `--subject` | names |", "|---|---|"]
        for name, both in named.items():
            fresh = [f"`{own}`" for own in both[k] if own not in listed]
            rows += [f"| `{name}` | {', '.join(fresh)} |"] * bool(fresh)
            listed.update(both[k])
        out[part] = "\n".join([*rows, ""])
    return out
