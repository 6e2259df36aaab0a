"""A verdict that cannot be fooled: what imitates an excusable difference is found all the same.

Every attack of `tests/attacks/` on Blender's picture of every sample scene, with what is known of
whose surfaces it shows, and by its colours alone, as `compare --against` judges a foreign picture.
"""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs.compare import gather_case
from reference_tracer.causes.explain import (
    AGREE,
    ANTI_ALIASING,
    CAUSES,
    EDGE,
    NOT_DECIDABLE,
    UNEXPLAINED,
    explain,
)
from reference_tracer.pictures.curves import FIT
from reference_tracer.rendering import render
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.progress import result_of

from ..attacks.colors import SHADES, all_recoloured, one_recoloured
from ..attacks.subject import Subject, alone, near_edges
from ..attacks.table import ATTACKS, withstood

SCENES = sorted(p.stem for p in (Path(__file__).parents[2] / "sample_scenes").glob("*.blend"))
WIDTH = 120
AT_MOST = 250  # changed pixels whose cause is looked for
OF_A_FILTER = 6  # of anti-aliased ones: each is asked for hundreds of samples
MANY = 20_000  # triangles, of which each such sample takes long: one attack on a filter will do
# Excused may be what the tracer's own picture, traced so far beside, shows in another way; besides,
# a few pixels: what lies behind the edge between two triangles, depth ties, slivers.
BAND = 1.5 / 256  # pixels: no surface of the scenes that can be decided may be off by more
FEW, SHARE = 3, 0.02


@pytest.fixture(scope="module")
def gathered() -> dict[str, Subject]:
    """What was gathered of the scenes: it is done once."""
    return {}


@pytest.fixture(scope="module")
def edges_of():
    """Return what finds the pixels near to edges; once for every scene."""
    known = {}

    def run(made):
        scene = made.case.scene
        if id(scene) not in known:  # kept with the scene, so that the number stays its own
            known[id(scene)] = scene, near_edges(scene, made.frame, BAND)
            assert known[id(scene)][1].mean() < 0.1  # forest's needles
        return known[id(scene)][1]

    return run


@pytest.fixture
def subjects(gathered, opened):
    """Return what yields every sample scene's name, and what is attacked."""

    def run(known):
        for name in SCENES:
            if name not in gathered:
                opened(name, WIDTH)
                case = gather_case(bpy.context, identity=True, self_check=True)
                frame = render(case.scene, case.settings)
                causes = result_of(explain(case, frame)).causes
                assert not (causes.cause == UNEXPLAINED).any()
                gathered[name] = Subject(case, frame, causes.cause != NOT_DECIDABLE)
            right = gathered[name]
            if known(name):
                yield name, right
            else:
                yield name, Subject(alone(right.case), right.frame, right.decidable)

    return run


def explained(made):
    """Return what is found of an attack's picture."""
    most = OF_A_FILTER if made.case.picture.sampling.filter_radius else AT_MOST
    return result_of(explain(made.case, made.frame, most))


def excused(made, found):
    """Return how many of the changed pixels got which cause, but unexplained, and of how many."""
    cause, changed = found.causes.cause, made.changed
    if found.background:  # the whole of what sees nothing: said of the comparison, which warns
        changed = changed & (made.frame.instance_index != NOTHING)
    count = {c: int((cause[changed] == c).sum()) for c in CAUSES}
    # Those that were passed over agree, as far as one knows.
    agree = max(0, count.pop(AGREE) - len(found.causes.passed_over))
    looked_at = agree + sum(count.values())
    del count[UNEXPLAINED]
    return {c.key: n for c, n in (count | {AGREE: agree}).items() if n}, looked_at


def out_of_bounds(causes, made):
    """Return how many excuses of changed pixels are not rounding's, or beyond their own bound."""
    differ = made.changed & ~np.isin(causes.cause, (AGREE, UNEXPLAINED))
    of_rounding = np.isin(causes.cause, [c for c in CAUSES if c.rounding])
    return int((differ & ~(of_rounding & (causes.figure <= causes.allowed))).sum())


def of_identity(attack, name, turn):
    """Return whether a scene is attacked with what is known of its surfaces, or without.

    Two scenes are so and two otherwise, in the next turn the others; whose a mix is, is not known.
    """
    if attack.imitates is ANTI_ALIASING and attack.name != "half_pixel":
        return False
    return (ATTACKS.index(attack) + SCENES.index(name) + 2 * turn) % 4 < 2


def of_every_day(attack, name):
    """Return whether an attack is made on a scene in every run, and not in the long ones alone.

    Every fifth attack is; of each cause at least one on every scene.
    """
    alone = len(withstood()[attack.imitates]) == 1
    return alone or (ATTACKS.index(attack) + SCENES.index(name)) % 5 == 0


LONG = [pytest.param(turn, marks=pytest.mark.torture) for turn in (1, 2)]
# An object in another shade is shown on every second scene in every run; in the long ones on all.
EVERY = pytest.mark.parametrize("every", [2, pytest.param(1, marks=pytest.mark.torture)])


def shown_on(shade, name, every):
    """Return whether a shade is shown on a scene."""
    return (list(SHADES).index(shade) + SCENES.index(name)) % every == 0


@pytest.mark.parametrize("turn", [0, *LONG])
@pytest.mark.parametrize("attack", ATTACKS, ids=[a.name for a in ATTACKS])
def test_what_is_damaged_is_found_but_for_rounding(attack, turn, subjects, edges_of):
    fooled, attacked = {}, 0
    for name, subject in subjects(lambda name: of_identity(attack, name, turn)):
        if turn == 0 and not of_every_day(attack, name):
            continue
        made = attack.make(subject)
        if made is None or not made.changed.any():
            continue
        triangles = made.frame.statistics.triangles
        if (
            made.case.picture.sampling.filter_radius
            and triangles > MANY
            and attack.name != "overshot"
        ):
            continue
        attacked += 1
        found = explained(made)
        why, looked_at = excused(made, found)
        at_edges = edges_of(made) & made.changed & (found.causes.cause == EDGE)
        few = sum(why.values()) - at_edges.sum() <= FEW + SHARE * looked_at
        if not few or out_of_bounds(found.causes, made) or found.causes.transform:
            fooled[name] = (why, f"of {looked_at}", found.causes.transform)
    assert fooled == {}
    assert attacked >= 1


@pytest.mark.parametrize("turn", [0, pytest.param(1, marks=pytest.mark.torture)])
def test_no_damage_makes_a_pixel_undecidable(turn, subjects):
    """That is said of where surfaces lie, whatever the picture shows, and is known of it."""
    mirrored = next(a for a in ATTACKS if a.name == "mirrored_x")
    for name, subject in subjects(lambda name: (SCENES.index(name) + turn) % 2):
        cause = explained(mirrored.make(subject)).causes.cause
        assert ((cause == NOT_DECIDABLE) == ~subject.decidable).all(), name


def shows_another(made):
    """Return whether an object is shown in the colour of another one: it may be that one."""
    shown = np.unique(made.case.picture.color[made.changed], axis=0)
    others = np.unique(made.frame.color[~made.changed], axis=0)
    return (np.abs(shown[:, None] - others).max(axis=-1) < FIT).any(axis=1).all()


@EVERY
@pytest.mark.parametrize("shade", SHADES)
def test_one_object_in_another_shade_is_named_and_is_no_transform(shade, every, subjects):
    wrong, attacked = {}, 0
    for name, subject in subjects(lambda _: False):
        if not shown_on(shade, name, every):
            continue
        made = one_recoloured(SHADES[shade])(subject)
        if made is None or not made.changed.any():
            continue
        attacked += 1
        if shows_another(made):
            continue
        causes = result_of(explain(made.case, made.frame)).causes  # of all pixels, as for a user
        shades = getattr(causes, "shades", ())
        if causes.transform or {s.object for s in shades} != {made.object}:
            wrong[name] = (causes.transform, [(s.object, s.pixels, s.transform) for s in shades])
    assert wrong == {}
    assert attacked >= len(SCENES) // 2 // every


@pytest.mark.parametrize("shade", SHADES)
def test_a_transform_of_the_whole_picture_is_still_named(shade, subjects):
    lost, attacked = {}, 0
    for name, subject in subjects(lambda _: False):
        made = all_recoloured(SHADES[shade])(subject)
        inside = made.changed & subject.inside & (subject.object >= 0)
        colors = np.unique(subject.frame.color[inside], axis=0)
        # Less than three colours fit more than one transform.
        if len(colors) < 3:
            continue
        attacked += 1
        causes = explained(made).causes
        if not causes.transform or (causes.cause[inside] == UNEXPLAINED).any():
            lost[name] = (causes.transform, int((causes.cause[inside] == UNEXPLAINED).sum()))
    assert lost == {}
    assert attacked >= len(SCENES) // 2


def test_every_cause_that_excuses_withstands_an_attack():
    """A new cause needs one."""
    table = withstood()
    assert set(table) == {c for c in CAUSES if c.explains} | {NOT_DECIDABLE}
    assert [cause.key for cause, attacks in table.items() if not attacks] == []
    assert len({a.name for a in ATTACKS}) == len(ATTACKS)
