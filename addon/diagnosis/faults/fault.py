"""The record of a fault: how it is made, how it is fitted to a picture, and its texts.

A fault is what a mistaken exporter, camera or reader would have made. The self-check makes it, to
see that the comparison finds it; the diagnosis puts it into the scene that is traced, to see
whether this gives the picture that was to be explained. Both read the records of this folder.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import IntEnum
from typing import Any, Generic, TypeVar

from ...arrays import Colors
from ...causes.case import Case
from ...scene import Camera, Instance, Mesh, Scene, alike
from ...tracer.frame import Frame
from ...tracer.progress import Work, at_once
from ..evidence import Evidence

G = TypeVar("G", bound="Guess")
Values = tuple[float, ...]


@dataclass(frozen=True, eq=False, kw_only=True)
class Guess:
    """A guess of what a fault is exactly. The base record names its object, if it has one."""

    object: str = ""  # that has it; empty where it is the whole scene's, or the picture's
    words: str = ""  # what else the sentence says
    values: Values = ()  # the numbers in the sentence, in the order of the fault's `numbers`
    low: Values = ()  # the least of each with which as many pixels agree; empty if not fitted
    high: Values = ()  # the largest of each, likewise


@dataclass(frozen=True, eq=False)
class Numbers(Guess):
    """A fault of some size."""

    values: Values = ()
    low: Values = ()
    high: Values = ()


@dataclass(frozen=True, eq=False)
class Option(Guess):
    """One of several ways to make the fault, by index."""

    number: int


Make = Callable[[Case, G], Case | None]  # None where there is nothing to get wrong
Find = Callable[[Evidence], Work[list[G]]]
Refine = Callable[[Evidence, G], Work[G | None]]
After = Callable[[Colors, G, Evidence], Colors]
Pick = Callable[[Case, Frame], Guess | None]


@dataclass(frozen=True)
class Example:
    """How the self-check makes a fault."""

    name: str  # in JSON
    text: str  # what is wrong, in words
    pick: Pick = lambda case, frame: Guess()  # the frame is traced of the case
    make: Make[Any] | None = None  # puts the fault into the picture, not into the scene


def with_values(*values: float) -> Pick:
    """Return a function that picks the same numbers in every scene."""
    return lambda case, frame: Numbers(values)


def with_option(number: int) -> Pick:
    """Return a function that picks the same option in every scene."""
    return lambda case, frame: Option(number)


def always(*guesses: G) -> Find[G]:
    """Return a function that finds the same guesses in every picture."""
    return at_once(lambda evidence: [*guesses])


ONCE: Find[Any] = always(Guess())  # of a fault that has no numbers and is of no object


class SearchEndedError(Exception):
    """Ends a search; one that catches it returns what it has found so far."""


class Effort(IntEnum):
    """The effort of finding a fault: those of less effort are tried first."""

    NOTHING = 0
    VIEW = 1
    FILM = 2
    CAMERA = 3
    LEFT_OUT = 4
    PIXELS = 5
    OBJECT = 6
    ANYTHING = 7


# The steps of the search, in words, in their order.
TRIED = {
    Effort.NOTHING: "colours, and what Blender says of the scene",
    Effort.VIEW: "a camera's conventions, and rows",
    Effort.FILM: "the lens",
    Effort.CAMERA: "the camera's place and turn",
    Effort.LEFT_OUT: "what is clipped; an object that is missing, or as in its file",
    Effort.PIXELS: "samples, sizes and triangles",
    Effort.OBJECT: "one object",
    Effort.ANYTHING: "what can look like much else",
}


@dataclass(frozen=True)
class Fault(Generic[G]):
    """A fault: the comparison's own claim of what is wrong with a picture."""

    name: str  # in JSON
    sentence: str  # with the names of `numbers`, {object} and {words}
    why: str  # who makes it, and how: for the documents
    advice: str  # what to do, with the names of `sentence`
    # Return the case that agrees if the picture has the fault: the scene with it, or the picture
    # without it.
    assume: Make[G]
    find: Find[G] = ONCE  # the guesses that are tried
    numbers: tuple[str, ...] = ()  # names of the guess' values
    # Makes the picture's pixels, (h, w, 4), of those traced of that case, (h', w', 4).
    after: After[G] | None = None
    sampled: bool = True  # whether a guess can be scored on single pixels
    refine: Refine[G] | None = None  # fits a guess on a finer sample
    effort: Effort = Effort.NOTHING
    sums_up: bool = False  # a summary: faults that explain as much are listed as its causes
    everywhere: bool = False  # changes all pixels: not tried beside an object's fault
    vague: bool = False  # allows for several pictures: an exact fault is reported in its place
    removes: bool = False  # its object is not visible
    turns: bool = False  # turns the picture: tried also where all colours are wrong
    examples: tuple[Example, ...] = ()
    words: str = ""  # the words of any guess, for the documents
    witness: str = ""  # the public report of it, "owner/repository#number" on GitHub

    def sentence_of(self, guess: Guess) -> str:
        """Return the sentence with a guess' numbers and names."""
        return self._filled(self.sentence, guess)

    def advice_of(self, guess: Guess) -> str:
        """Return the advice with a guess' numbers and names."""
        return self._filled(self.advice, guess)

    def _filled(self, text: str, guess: Guess) -> str:
        numbers = dict(zip(self.numbers, guess.values, strict=False))
        return text.format(object=guess.object, words=guess.words, **numbers)


def unchanged(case: Case, guess: Guess) -> Case:
    """Return the case itself: the fault lies in what is done after tracing."""
    return case


AnyFault = Fault[Any]  # with guesses of its own kind


def of_camera(change: Callable[..., Camera | None]) -> Make[Guess]:
    """Return a function that changes the camera, by a function of it and the guess' numbers."""

    def assume(case: Case, guess: Guess) -> Case | None:
        camera = change(case.scene.camera, *guess.values)
        if camera is None or alike(camera, case.scene.camera):
            return None
        return case.with_scenes(lambda scene: scene.seen_by(camera))

    return assume


Way = tuple[str, Callable[[Camera], Camera | None]]  # the words of an option, and how it is made


@dataclass(frozen=True)
class Ways:
    """Makes a camera's fault in the way that the option says."""

    every: tuple[Way, ...]

    def __call__(self, case: Case, guess: Option) -> Case | None:
        """Return the case with the fault."""
        _, change = self.every[guess.number]
        return of_camera(change)(case, guess)

    def options(self) -> Iterator[tuple[Option, Callable[[Camera], Camera | None]]]:
        """Yield each way as a guess, and how a camera is changed by it."""
        for number, (words, change) in enumerate(self.every):
            yield Option(number, words=words), change


def ways(*every: Way) -> tuple[Ways, Find[Option]]:
    """Return how a camera's fault is made in several ways, each with words of its own."""
    made = Ways(every)
    return made, always(*(option for option, _ in made.options()))


def options(*changes: Callable[[Camera], Camera | None]) -> tuple[Ways, Find[Option]]:
    """Return how a camera's fault is made in several ways, and a function that guesses each."""
    return ways(*(("", change) for change in changes))


def instances_named(scene: Scene, name: str) -> list[int]:
    """Return the instances of an object's meshes; those of all objects if the name is empty."""
    return [n for n, i in enumerate(scene.instances) if name in ("", scene.objects[i.object])]


Key = tuple[str, int]  # an object's name, and which of its instances and planes it is


def keys_of(scene: Scene) -> list[Key]:
    """Return what each instance and plane is called, also where a scene lists them otherwise."""
    before: Counter[str] = Counter()
    out = []
    for name in (scene.objects[n] for n in scene.instance_objects[:-1]):
        out.append((name, before[name]))
        before[name] += 1
    return out


def of_object(change: Callable[..., Instance | None]) -> Make[Guess]:
    """Return a function that changes an object's instances, by a function of each.

    It takes an instance and the guess' numbers. A guess of no object changes all objects.
    """

    def assume(case: Case, guess: Guess) -> Case | None:
        if not instances_named(case.scene, guess.object):
            return None
        return case.with_scenes(
            lambda scene: with_instances(
                scene, guess.object, lambda instance: change(instance, *guess.values)
            )
        )

    return assume


def with_instances(scene: Scene, name: str, change: Callable[[Instance], Instance | None]) -> Scene:
    """Return a scene with an object's instances changed, or left out where that gives None."""
    own = set(instances_named(scene, name))
    made = (change(i) if n in own else i for n, i in enumerate(scene.instances))
    return replace(scene, instances=tuple(i for i in made if i is not None))


def of_meshes(change: Callable[[Mesh], Mesh]) -> Make[Guess]:
    """Return a function that changes all meshes."""

    def changed(scene: Scene) -> Scene:
        return replace(scene, meshes=tuple(map(change, scene.meshes)))

    return lambda case, guess: case.with_scenes(changed)
