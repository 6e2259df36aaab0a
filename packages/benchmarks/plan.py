"""The plan of a benchmark: which scene, at which size, through which camera, beside which peers.

All is beside embreex. The others are so slow that only some pictures have them: the whole takes
less than half an hour, the quick one less than 2 minutes.
"""

from __future__ import annotations

from dataclasses import dataclass

from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE
from reference_tracer.scene import SceneError

from . import scenes
from .scenes import SUBJECTS

SMALL, LARGE = (480, 270), (1920, 1080)  # pixels
QUICK_ADVERSARIAL = "slivers_20k", "inside_soup"
QUICK_LARGE = "cube", "icosphere_82k", "suzanne"
QUICK_CYCLES = "cube", "icosphere_82k"
MANY = 200_000  # triangles: an R-tree of more takes minutes and gigabytes to build
REPEATS, QUICK_REPEATS = 5, 3
BLENDER = frozenset({"bvhtree", "cycles", "workbench"})
# What is measured as a user runs it, see `commands.py`; the quick ones are short.
QUICK_COMMANDS = (
    "reftrace --help",
    "trace mesh.ply, 1.3 M triangles",
    "F12, 1920 x 1080",
    "F12, 1920 x 1080, the picture alone",
)
COMMANDS = (
    *QUICK_COMMANDS,
    "compare suzanne, 960 x 540",
    "compare 12 triangles, 1920 x 1080",
    "compare 385,000 pixels that one cause excuses",
)


@dataclass(frozen=True)
class Case:
    """One picture, and the slow peers that it is held against."""

    scene: str
    width: int
    height: int
    camera: str
    peers: frozenset[str] = frozenset()

    @property
    def cost(self) -> float:
        """About how long it takes, in some unit."""
        return self.width * self.height + SUBJECTS[self.scene].traced_triangles + 500_000

    @property
    def title(self) -> str:
        """Say which it is."""
        return f"{self.scene}, {self.width} x {self.height}, {self.camera}"


@dataclass(frozen=True)
class Plan:
    """All cases, scene by scene, and how long they may take."""

    cases: tuple[Case, ...]
    quick: bool
    repeats: int
    budget: float  # seconds for the repeats of one case
    slow: float  # seconds for each peer that is measured on a sample of rays
    seconds: float = 1e9  # for all cases: who comes late gets fewer rounds
    commands: tuple[str, ...] = ()  # of COMMANDS


def plan(names: list[str] | None = None, quick: bool = False, repeats: int | None = None) -> Plan:
    """Return what is to be measured.

    Parameters
    ----------
    names : list of str, optional
        Scenes, without the commands; all by default, but for --quick, which leaves out some of
        the adversarial and the slow commands.
    quick : bool
    repeats : int, optional
        Rounds of every case, if they fit its time.

    Raises
    ------
    SceneError
        If there is no such scene, or there are to be fewer rounds than one.
    """
    if repeats is not None and repeats < 1:
        raise SceneError(f"--repeats is {repeats}; it must be at least 1")
    chosen = [scenes.subject(name).name for name in dict.fromkeys(names or _default(quick))]
    cases = [case for name in chosen for case in (_quick if quick else _whole)(name)]
    commands = () if names else QUICK_COMMANDS if quick else COMMANDS
    if quick:
        repeats, times = repeats or QUICK_REPEATS, {"budget": 5.0, "slow": 0.3, "seconds": 80.0}
    else:
        repeats, times = repeats or REPEATS, {"budget": 10.0, "slow": 3.0, "seconds": 1200.0}
    return Plan(tuple(cases), quick, repeats, **times, commands=commands)


def _default(quick: bool) -> list[str]:
    groups = (scenes.EVERYDAY,) if quick else (scenes.EVERYDAY, scenes.ADVERSARIAL, scenes.SCALING)
    found = [s.name for s in SUBJECTS.values() if s.group in groups]
    return [*found, *QUICK_ADVERSARIAL] if quick else found


def _quick(name: str) -> list[Case]:
    peers = set(BLENDER) if name in QUICK_CYCLES else set()
    peers |= {"rtree"} if SUBJECTS[name].triangles <= 10_000 else set()
    found = [Case(name, *SMALL, PERSPECTIVE.name, frozenset(peers))]
    if SUBJECTS[name].group == scenes.EVERYDAY:
        found.append(Case(name, *SMALL, ORTHOGRAPHIC.name))
    return [*found, Case(name, *LARGE, PERSPECTIVE.name)] if name in QUICK_LARGE else found


def _whole(name: str) -> list[Case]:
    subject = SUBJECTS[name]
    if subject.group == scenes.SCALING:
        return [Case(name, *LARGE, PERSPECTIVE.name)]
    peers = set(BLENDER) if subject.group == scenes.EVERYDAY else set()
    if subject.triangles <= MANY and subject.group == scenes.EVERYDAY:
        peers.add("rtree")
    return [
        Case(name, *SMALL, PERSPECTIVE.name),
        Case(name, *SMALL, ORTHOGRAPHIC.name),
        Case(name, *LARGE, PERSPECTIVE.name, frozenset(peers)),
        Case(name, *LARGE, ORTHOGRAPHIC.name),
    ]
