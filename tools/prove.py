"""Has Coq read the proofs, and says what it has read.

    python tools/prove.py

First proofs/recorded/ is compared with what the tracer does now. Then every file of proofs/ is
compiled, and Coq is asked what the theorems named in proofs/Claims.v assume. Nothing may be left
out (`Admitted`), and nothing assumed but what Coq's real numbers rest on.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from pathlib import Path

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


def files(folder: Path = PROOFS) -> list[Path]:
    """Return the Coq files of the proofs, in all folders."""
    return sorted(folder.rglob("*.v"))


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


def holes(folder: Path = PROOFS) -> list[str]:
    """Return where in the proofs something is left out or taken for granted."""
    found = []
    for path in files(folder):
        for match in HOLES.finditer(without_comments(path.read_text(encoding="utf-8"))):
            found.append(f"{path.name}: {match.group(1)}")
    return found


def claims() -> list[tuple[str, str]]:
    """Return name and words of each theorem that is claimed."""
    text = (PROOFS / "Claims.v").read_text(encoding="utf-8")
    return [(name, " ".join(words.split())) for words, name in _CLAIM.findall(text)]


def run(*command: str) -> str:
    """Return what a command says; the whole program ends where it fails."""
    done = subprocess.run(command, cwd=PROOFS, text=True, capture_output=True)
    if done.returncode:
        sys.exit(f"{done.stdout[-4000:]}{done.stderr[-4000:]}\n{' '.join(command)}: failed")
    return done.stdout


def assumptions(theorems: list[str]) -> set[str]:
    """Return what Coq says that these assume, all together."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "Asked.v")
        every = ", ".join(f"@{name}" for name in theorems)
        text = f"From Reftrace Require Claims.\nDefinition every := ({every}).\n"
        path.write_text(f"{text}Print Assumptions every.\n", encoding="utf-8")
        said = run("coqc", "-Q", ".", "Reftrace", str(path))
    _, found, listed = said.partition("Axioms:")
    if not found:  # what is about real numbers rests on some
        sys.exit(f"Coq's answer is not understood:\n{said}")
    # A name begins its line, with its type after it; what is indented goes on with a type.
    return {line.split()[0] for line in listed.splitlines() if line and not line[0].isspace()}


def main() -> None:
    """Compare, compile, ask, and print."""
    check = [sys.executable, str(PROOFS.parent / "tools/record_trees.py"), "--check"]
    compared = subprocess.run(check, text=True, capture_output=True)
    if compared.returncode:
        sys.exit(
            f"{compared.stderr}\nThe theorems speak of other code than this. See docs/proof.md."
        )
    if sorted(listed()) != files():
        sys.exit("proofs/_CoqProject must name each file of proofs/ once")
    if left_out := holes():
        sys.exit("\n".join(["The proofs have holes:", *left_out]))
    run("coq_makefile", "-f", "_CoqProject", "-o", "Makefile.coq")
    run("make", "-f", "Makefile.coq", "-j2", "--no-print-directory")
    every = claims()
    for name, words in every:
        print(f"{name}\n    {words}")
    if others := (assumed := assumptions([name for name, _ in every])) - AXIOMS:
        sys.exit(f"assumed beyond Coq's real numbers: {', '.join(sorted(others))}")
    texts = [path.read_text(encoding="utf-8") for path in files()]
    lines = sum(len(text.splitlines()) for text in texts)
    print(
        f"\n{len(every)} theorems of {len(texts)} files, {lines:,} lines: read by Coq; 0 admitted."
        f"\nThey assume what Coq's real numbers do: {', '.join(sorted(assumed))}"
    )


if __name__ == "__main__":
    main()
