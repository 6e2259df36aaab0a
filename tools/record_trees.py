"""Writes proofs/recorded/: what the tracer's functions compute, operation by operation.

    python tools/record_trees.py [--check]

The functions run as they are, on numbers that remember where they come from (tools/recorder).
--check writes nothing, and says what has changed.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from recorder import coq
from recorder.records import FILES, Output, Record, outputs

RECORDED = Path(__file__).resolve().parents[1] / "proofs" / "recorded"


def all_outputs(records: Sequence[Record]) -> list[Output]:
    """Record functions; return the results of all, in order."""
    return [output for record in records for output in outputs(record)]


def main() -> None:
    """Write the files, or compare them with what is recorded now."""
    parser = argparse.ArgumentParser(description="Record what the tracer computes.")
    parser.add_argument("--check", action="store_true", help="write nothing, say what changed")
    options = parser.parse_args()
    changed = []
    for file, records in FILES.items():
        path = RECORDED / f"{file}.v"
        found = all_outputs(records)
        if options.check:
            changed += coq.differences(file, path.read_text(encoding="utf-8"), found)
        else:
            path.write_text(coq.text(found), encoding="utf-8")
    if changed:
        sys.exit("\n\n".join(changed))


if __name__ == "__main__":
    main()
