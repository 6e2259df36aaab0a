"""Has Coq read the proofs, and says what it has read.

    python tools/prove.py

First what the tracer does now is recorded in proofs/recorded/. Then every file of proofs/ is
compiled, and Coq is asked what the theorems named in proofs/Claims.v assume. Nothing may be left
out (`Admitted`), and nothing assumed but what Coq's real numbers rest on. What was compiled is read
once more by `coqchk`, which has Coq's kernel alone, and none of its tactics. At the end digests of
what was recorded are kept: by them `make test` knows, without Coq, that the code is as proven.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path

import record_trees
from recorder.records import NAMES

PROOFS = Path(__file__).resolve().parents[1] / "proofs"
# What Coq's library of real numbers, and Flocq on it, take for granted: classical logic, and that
# functions that are equal everywhere are equal.
AXIOMS = {
    "ClassicalDedekindReals.sig_not_dec",
    "ClassicalDedekindReals.sig_forall_dec",
    "FunctionalExtensionality.functional_extensionality_dep",
    "Classical_Prop.classic",
}
# What would let a theorem stand without its proof.
HOLES = re.compile(
    r"\b(Admitted|admit|give_up|Axioms?|Parameters?|Conjectures?|Abort All|Unset\s+Guard\s+Checking"
    r"|bypass_check|Unset\s+Universe\s+Checking|Unset\s+Positivity\s+Checking)\b"
)
_CLAIM = re.compile(r"\(\*\*\s*((?:(?!\*\)).)*?)\s*\*\)\s*Check (\S+)\.", re.DOTALL)


def files() -> list[Path]:
    """Return the Coq files that people have written, in all folders."""
    return sorted(p for p in PROOFS.rglob("*.v") if p.parent != record_trees.RECORDED)


def recorded() -> list[Path]:
    """Return the Coq files that are recorded from the code, be they there or not."""
    return [record_trees.RECORDED / f"{name}.v" for name in NAMES]


def listed() -> list[Path]:
    """Return the files that `_CoqProject` names; the program ends if it is not as it must be."""
    flags, *names = (PROOFS / "_CoqProject").read_text(encoding="utf-8").splitlines()
    if flags != "-Q . Reftrace":
        sys.exit("proofs/_CoqProject must begin with `-Q . Reftrace`")
    return [PROOFS / name for name in names]


def without_comments(text: str) -> str:
    """Return Coq's text without its comments, which may stand in one another."""
    out, level = [], 0
    for piece in re.split(r"(\(\*|\*\))", text):
        level += (piece == "(*") - (piece == "*)")
        if not level and piece != "*)":
            out.append(piece)
    return "".join(out)


def holes(paths: Iterable[Path]) -> list[str]:
    """Return where in Coq files something is left out or taken for granted."""
    found = []
    for path in paths:
        for match in HOLES.finditer(without_comments(path.read_text(encoding="utf-8"))):
            found.append(f"{path.name}: {match.group(1)}")
    return found


def claims() -> list[tuple[str, str]]:
    """Return name and words of each theorem that is claimed."""
    text = (PROOFS / "Claims.v").read_text(encoding="utf-8")
    return [(name, " ".join(words.split())) for words, name in _CLAIM.findall(text)]


def run(*command: str) -> subprocess.CompletedProcess[str]:
    """Return what a command says, on both streams; the whole program ends where it fails."""
    done = subprocess.run(command, cwd=PROOFS, text=True, capture_output=True)
    if done.returncode:
        sys.exit(f"{done.stdout[-4000:]}{done.stderr[-4000:]}\n{' '.join(command)}: failed")
    return done


def assumptions(theorems: list[str]) -> set[str]:
    """Return what Coq says that these assume, all together."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "Asked.v")
        every = ", ".join(f"@{name}" for name in theorems)
        text = f"From Reftrace Require Claims.\nDefinition every := ({every}).\n"
        path.write_text(f"{text}Print Assumptions every.\n", encoding="utf-8")
        said = run("coqc", "-Q", ".", "Reftrace", str(path)).stdout
    _, found, listed = said.partition("Axioms:")
    if not found:  # what is about real numbers rests on some
        sys.exit(f"Coq's answer is not understood:\n{said}")
    # A name begins its line, with its type after it; what is indented goes on with a type.
    return {line.split()[0] for line in listed.splitlines() if line and not line[0].isspace()}


def checked(said: str) -> set[str]:
    """Return the axioms that `coqchk -o` names; the program ends if it names anything else."""
    summary = re.search(r"\* Axioms:(.*?)\n\s*\* (.*)", said, re.DOTALL)
    if not summary or re.findall(r": (.+)", summary[2]) != ["<none>"] * 3:
        sys.exit(f"coqchk has not found all in order:\n{said}")
    return {".".join(name.split(".")[-2:]) for name in summary[1].split()}


def main() -> None:
    """Record, compile, ask, and print."""
    if sorted(listed()) != sorted([*files(), *recorded()]):
        sys.exit("proofs/_CoqProject must name each file of proofs/ once")
    digests = record_trees.write()
    if left_out := holes(listed()):
        sys.exit("\n".join(["The proofs have holes:", *left_out]))
    run("coq_makefile", "-f", "_CoqProject", "-o", "Makefile.coq")
    run("make", "-f", "Makefile.coq", "-j2", "--no-print-directory")
    every = claims()
    for name, words in every:
        print(f"{name}\n    {words}")
    if others := (assumed := assumptions([name for name, _ in every])) - AXIOMS:
        sys.exit(f"assumed beyond Coq's real numbers: {', '.join(sorted(others))}")
    asked = run("coqchk", "-silent", "-o", "-Q", ".", "Reftrace", "Reftrace.Claims")
    again = checked(asked.stdout + asked.stderr)  # its summary is on the second, in Coq 8.16
    if not again <= AXIOMS:
        sys.exit(f"coqchk names other axioms: {', '.join(sorted(again - AXIOMS))}")
    texts = [path.read_text(encoding="utf-8") for path in listed()]
    lines = sum(len(text.splitlines()) for text in texts)
    print(
        f"\n{len(every)} theorems of {len(texts)} files, {lines:,} lines: read by Coq; 0 admitted."
        f"\nThey assume what Coq's real numbers do: {', '.join(sorted(assumed))}"
    )
    if record_trees.PROVEN.read_text(encoding="utf-8") != digests:
        record_trees.PROVEN.write_text(digests, encoding="utf-8")
        print("The code is another than was proven last: proofs/recorded/proven.txt is new.")


if __name__ == "__main__":
    main()
