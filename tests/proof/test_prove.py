"""`make prove` would notice a proof with a hole; Coq itself is asked by CI, not here."""

import re

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
    assert len(prove.holes(tmp_path)) == 1


def test_words_in_comments_are_no_holes(tmp_path):
    (tmp_path / "Whole.v").write_text(
        "(* Admitted (* Axiom *) *)\nLemma admitted : True. exact I. Qed."
    )
    assert not prove.holes(tmp_path)


def test_the_proofs_have_none_and_all_are_read():
    assert not prove.holes()
    listed = (prove.PROOFS / "_CoqProject").read_text().split()
    files = {path.name for path in prove.PROOFS.glob("*.v")}
    assert files == set(listed) - {"-Q", ".", "Reftrace"}


def test_every_claim_is_a_theorem_in_words():
    claims = prove.claims()
    text = (prove.PROOFS / "Claims.v").read_text()
    assert len(claims) == len(re.findall(r"^Check ", text, re.MULTILINE)) > 20
    for name, words in claims:
        assert words.endswith(".") and "Require" not in words, name
        file, theorem = name.split(".")
        text = (prove.PROOFS / f"{file}.v").read_text()
        assert re.search(
            rf"^(Theorem|Corollary|Lemma) {re.escape(theorem)}(?![\w'])", text, re.MULTILINE
        ), name


def test_the_document_names_every_file():
    text = (prove.PROOFS.parent / "docs" / "proof.md").read_text(encoding="utf-8")
    for path in prove.PROOFS.glob("*.v"):
        assert path.stem in text, f"docs/proof.md doesn't say what {path.name} is"
