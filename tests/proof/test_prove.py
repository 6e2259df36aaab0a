"""`make prove` would notice a proof with a hole; Coq itself is asked by CI, not here."""

import re
import sys

import prove
import pytest


@pytest.mark.parametrize(
    "hole",
    [
        "Lemma l : False. Proof. Admitted.",
        "Lemma l : False. Proof. admit.",
        "Axiom l : False.",
        "Parameter l : False.",
        "Conjecture l : False.",
        "Unset Guard Checking.",
        "(* (* a comment in one *) *) Axiom l : False.",
    ],
)
def test_a_hole_is_found(hole, tmp_path):
    (tmp_path / "Holed.v").write_text(f"Lemma m : True.\nProof. exact I. Qed.\n{hole}\n")
    assert len(prove.holes(tmp_path.glob("*.v"))) == 1


def test_words_in_comments_are_no_holes(tmp_path):
    (tmp_path / "Whole.v").write_text(
        "(* Admitted (* Axiom *) *)\nLemma admitted : True. exact I. Qed."
    )
    assert not prove.holes(tmp_path.glob("*.v"))


def test_the_proofs_have_none_and_all_are_read():
    assert not prove.holes(prove.files())
    assert sorted(prove.listed()) == sorted([*prove.files(), *prove.recorded()])


def test_every_file_has_a_name_of_its_own():
    """`From Reftrace Require Import Rounding` finds Rounding.v in whichever folder it is."""
    names = [path.stem for path in prove.listed()]
    assert len(set(names)) == len(names)


def test_every_claim_is_a_theorem_in_words():
    claims = prove.claims()
    text = (prove.PROOFS / "Claims.v").read_text(encoding="utf-8")
    paths = {path.stem: path for path in prove.files()}
    assert len(claims) == len(re.findall(r"^Check ", text, re.MULTILINE)) > 20
    for name, words in claims:
        assert words.endswith(".") and "Require" not in words, name
        file, theorem = name.split(".")
        text = paths[file].read_text(encoding="utf-8")
        assert re.search(
            rf"^(Theorem|Corollary|Lemma) {re.escape(theorem)}(?![\w'])", text, re.MULTILINE
        ), name


def test_the_claims_need_every_file():
    """What is not needed, Coq is not asked what it assumes, nor does `coqchk` read it again."""
    assert required("Claims") == set(prove.listed())


def test_every_file_begins_with_what_it_proves_and_every_folder_is_on_the_page():
    page = (prove.PROOFS / "README.md").read_text(encoding="utf-8")
    for path in prove.files():
        assert re.match(r"\(\*\* .{20,}", path.read_text(encoding="utf-8")), path.name
        folder = path.parent.relative_to(prove.PROOFS).as_posix()
        assert folder == "." or f"`{folder}/`" in page, folder


# What can be read for `certified_with_depth`, without the rest.
THEOREM = "geometry floating_point rule quotient whole code theorem".split()


def test_the_theorem_needs_its_own_folders_and_no_other():
    needed = {path.relative_to(prove.PROOFS) for path in required("CertifiedDepth")}
    for path in prove.files():
        path = path.relative_to(prove.PROOFS)
        assert (path in needed) == (path.parts[0] in THEOREM), path
    recorded = {path.stem for path in needed if path.parts[0] == "recorded"}
    assert recorded == {"RecordedBounds", "RecordedDecisions", "RecordedQuotient"}


def required(name):
    """Return a file of the proofs, and all that it requires: as coqdep has it."""
    paths, found, open_ = {path.stem: path for path in prove.listed()}, set(), [name]
    while open_:
        path = paths[open_.pop()]
        if path not in found:
            found.add(path)
            if path in prove.recorded():
                continue  # these require Trees, as the others do
            text = prove.without_comments(path.read_text(encoding="utf-8"))
            for names in re.findall(r"From Reftrace Require(?: Import| Export)? ([\w\s]+)\.", text):
                open_ += names.split()
    return found


CHECKED = """
CONTEXT SUMMARY
===============

* Theory: Set is predicative

* Axioms:
    Coq.Logic.FunctionalExtensionality.functional_extensionality_dep
    Coq.Reals.ClassicalDedekindReals.sig_not_dec

* Constants/Inductives relying on type-in-type: <none>

* Constants/Inductives relying on unsafe (co)fixpoints: <none>

* Inductives whose positivity is assumed: <none>
"""


def test_what_coqchk_says_is_understood():
    assert prove.checked(CHECKED) == {
        "FunctionalExtensionality.functional_extensionality_dep",
        "ClassicalDedekindReals.sig_not_dec",
    }
    other = "    Reftrace.Claims.hole\n\n* Constants/Inductives relying on type"
    found = prove.checked(CHECKED.replace("\n* Constants/Inductives relying on type", other, 1))
    assert "Claims.hole" in found - prove.AXIOMS


def test_what_a_command_says_on_either_stream_is_kept():
    """Coq 8.16's coqchk prints its summary with its errors."""
    says = "import sys; print('out'); print('err', file=sys.stderr)"
    done = prove.run(sys.executable, "-c", says)
    assert (done.stdout, done.stderr) == ("out\n", "err\n")


@pytest.mark.parametrize("said", ["", CHECKED.replace("assumed: <none>", "assumed: Some.type")])
def test_what_coqchk_finds_wrong_ends_the_program(said):
    with pytest.raises(SystemExit, match="coqchk has not found all in order"):
        prove.checked(said)
