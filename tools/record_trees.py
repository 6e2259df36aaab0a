"""Writes proofs/Recorded.v: what the tracer's functions compute, operation by operation.

    python tools/record_trees.py [--check]

The functions run as they are, on numbers that remember where they come from (tools/recorder).
--check writes nothing, and says what is another.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from recorder import coq
from recorder.records import RECORDS, outputs

RECORDED = Path(__file__).resolve().parents[1] / "proofs" / "Recorded.v"


def main() -> None:
    parser = argparse.ArgumentParser(description="Record what the tracer computes.")
    parser.add_argument("--check", action="store_true", help="write nothing, say what changed")
    options = parser.parse_args()
    found = [output for record in RECORDS for output in outputs(record)]
    if not options.check:
        RECORDED.write_text(coq.text(found), encoding="utf-8")
    elif changed := coq.differences(RECORDED.read_text(encoding="utf-8"), found):
        sys.exit("\n\n".join(changed))


if __name__ == "__main__":
    main()
