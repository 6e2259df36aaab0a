"""Writes proofs/recorded/: what the tracer's functions compute, operation by operation.

    python tools/record_trees.py [--check]

The functions run as they are, on numbers that remember where they come from (tools/recorder).
--check writes nothing, and says what is another than `make prove` has had Coq read last.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from recorder import coq
from recorder.records import every_output

RECORDED = Path(__file__).resolve().parents[1] / "proofs" / "recorded"
PROVEN = RECORDED / "proven.txt"  # digests of what Coq has read: the files themselves are not kept


def proven() -> dict[str, str]:
    """Return the digests of the expressions that Coq has read last, by name."""
    lines = PROVEN.read_text(encoding="utf-8").splitlines()
    return dict(line.split() for line in lines)


def write() -> str:
    """Record all functions and write the Coq files; return their digests as `PROVEN` has them."""
    lines = []
    for file, found in every_output():
        path, text = RECORDED / f"{file}.v", coq.text(file, found)
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
        lines += [f"{name} {digest}\n" for name, digest in coq.digests(file, found).items()]
    return "".join(lines)


def check() -> list[str]:
    """Record all functions; return in words what Coq has not read so."""
    before = proven()
    changed = []
    for file, found in every_output():
        changed += coq.differences(file, before, found)
    return changed


def main() -> None:
    """Write the files, or compare with what Coq has read."""
    parser = argparse.ArgumentParser(description="Record what the tracer computes.")
    parser.add_argument("--check", action="store_true", help="write nothing, say what changed")
    if not parser.parse_args().check:
        write()
    elif changed := check():
        sys.exit("\n\n".join(changed))


if __name__ == "__main__":
    main()
