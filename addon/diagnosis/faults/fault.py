"""What a fault is: how it is made, how it is fitted to a picture, and what is said of it.

A fault is what a mistaken exporter, camera or reader would have made. The self-check makes it, to
see that the comparison finds it; the diagnosis puts it into the scene that is traced, to see
whether this gives the picture that was to be explained. Both read the records of this folder.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import IntEnum
from typing import TYPE_CHECKING

from ...arrays import Colors
from ...causes.case import Case
from ...pictures.picture import Curve
from ...scene import Camera, Instance, Scene
from ...tracer.frame import Frame
from ...tracer.progress import Work

if TYPE_CHECKING:
    from ..evidence import Evidence


@dataclass(frozen=True, eq=False)
class Guess:
    """Which fault it is exactly: its numbers, the object that has it, or the scene with it."""

    values: tuple[float, ...] = ()  # as the fault's `numbers` name them; more are not told
    # Between what they may lie, for all pixels to agree as well; empty if they were not fitted.
    low: tuple[float, ...] = ()
    high: tuple[float, ...] = ()
    object: str = ""
    scene: Scene | None = None  # with a fault that only Blender can make
    words: str = ""  # what else the sentence says
    curve: Curve | None = None  # what was done to the picture's colours
    box: tuple[int, int, int, int] | None = None  # left, bottom, right, top: of some pixels


# Return the case with the fault; None where there is nothing to get wrong. The frame is traced of
# the case.
Make = Callable[[Case, Frame, Guess], Case | None]
Find = Callable[["Evidence"], Work[list[Guess]]]
Refine = Callable[["Evidence", Guess], Work[Guess | None]]
After = Callable[[Colors, Guess, "Evidence"], Colors]
Pick = Callable[[Case, Frame], Guess | None]


@dataclass(frozen=True)
class Example:
    """How the self-check makes a fault."""

    name: str  # in JSON
    text: str  # what is wrong, in words
    pick: Pick = lambda case, frame: Guess()


def with_values(*values: float) -> Pick:
    """Return what picks the same numbers in every scene."""
    return lambda case, frame: Guess(values)


def once(evidence: Evidence) -> Work[list[Guess]]:
    """Return the one guess of a fault that has no numbers and is about no object."""
    return [Guess()]
    yield


class Effort(IntEnum):
    """What it takes to find a fault: those of less effort are looked for first."""

    NOTHING = 0  # it has no numbers, or few that are tried
    FILM = 1  # one or two numbers of where rays pass the film are fitted
    PIXELS = 2  # pixels, or triangles, are gone through
    CAMERA = 3  # where the camera stands and looks is fitted
    SIZE = 4  # a number of an object is fitted
    PLACE = 5  # where an object is
    ANYTHING = 6  # what can be made to look like much else


@dataclass(frozen=True)
class Fault:
    """A fault: the comparison's own claim of what is wrong with a picture."""

    name: str  # in JSON
    sentence: str  # with the names of `numbers`, {object} and {words}
    advice: str  # what to do, with the same names
    make: Make
    find: Find = once  # the guesses that are tried
    numbers: tuple[str, ...] = ()  # of the guess' values, those that are told
    # The case with the fault taken out of its picture; by default, the fault is in the scene.
    put_right: Make | None = None
    # What the picture's pixels are after that, from those that are traced in the case with the
    # fault, (h', w', 4); the shape is (h, w).
    after: After | None = None
    sampled: bool = True  # whether single pixels can say how good a guess is
    refine: Refine | None = None  # fits a guess in a finer sample
    effort: Effort = Effort.NOTHING
    sums_up: bool = False  # it says what is seen: faults that do as well are reasons for it
    everywhere: bool = False  # it is in all pixels: none is looked for beside a fault of an object
    vague: bool = False  # it allows for more than one picture: what is exact is told in its place
    examples: tuple[Example, ...] = ()
    words: str = ""  # what a guess' words say, in general: for the documents

    def told(self, guess: Guess) -> str:
        """Return the sentence with a guess' numbers and names."""
        return self._filled(self.sentence, guess)

    def advised(self, guess: Guess) -> str:
        """Return the advice with a guess' numbers and names."""
        return self._filled(self.advice, guess)

    def _filled(self, text: str, guess: Guess) -> str:
        numbers = dict(zip(self.numbers, guess.values, strict=False))
        return text.format(object=guess.object, words=guess.words, **numbers)

    def tried(self, case: Case, frame: Frame, guess: Guess) -> Case | None:
        """Return the case that agrees if the picture has this fault."""
        if guess.scene is not None:
            return case.in_scene(guess.scene)
        return (self.put_right or self.make)(case, frame, guess)


def of_camera(change: Callable[..., Camera | None]) -> Make:
    """Return what changes the camera of all scenes, by a function of it and the numbers."""

    def make(case: Case, frame: Frame, guess: Guess) -> Case | None:
        camera = change(case.scene.camera, *guess.values)
        return None if camera is None else case.with_scenes(lambda scene: scene.seen_by(camera))

    return make


def options(*changes: Callable[[Camera], Camera | None]) -> tuple[Make, Find]:
    """Return what makes a fault of the camera that has several forms, and what finds which."""

    def make(camera: Camera, number: float) -> Camera | None:
        return changes[int(number)](camera)

    def find(evidence: Evidence) -> Work[list[Guess]]:
        return [Guess((float(number),)) for number in range(len(changes))]
        yield

    return of_camera(make), find


def instances_named(scene: Scene, name: str) -> list[int]:
    """Return the instances of the meshes of an object."""
    return [n for n, i in enumerate(scene.instances) if scene.objects[i.object] == name]


def of_object(change: Callable[..., Instance | None]) -> Make:
    """Return what changes an object's instances in all scenes, by a function of each.

    It takes the instance and the guess' numbers; without a name, all objects are changed.
    """

    def make(case: Case, frame: Frame, guess: Guess) -> Case | None:
        if guess.object and not instances_named(case.scene, guess.object):
            return None

        def changed(scene: Scene) -> Scene:
            own = set(instances_named(scene, guess.object))
            made = [
                change(instance, *guess.values) if n in own or not guess.object else instance
                for n, instance in enumerate(scene.instances)
            ]
            return replace(scene, instances=tuple(i for i in made if i is not None))

        return case.with_scenes(changed)

    return make
