"""Work that is done in turns with Blender, which evaluates and draws in between."""

from __future__ import annotations

from collections.abc import Callable, Generator
from concurrent.futures import Future
from typing import Any, Generic, TypeAlias, TypeVar

from bpy.types import Depsgraph

from ..tracer.signals import check

T = TypeVar("T")
# Work in turns: it is sent an evaluated depsgraph, and yields to have it drawn, saying whether that
# is not the last picture; it goes on when that is written, and yields for the next evaluation.
Turns: TypeAlias = Generator[bool, Any, T]


def once(of: Callable[[Any], T]) -> Turns[T]:
    """Return what a function makes of the evaluation; nothing is drawn."""
    return of((yield False))


class InTurns(Generic[T]):
    """Work that is done in turns with Blender.

    Blender's handlers print what is raised in them, and forget it: so it is raised at the end. A
    signal is heard at the next turn, and ends the work.
    """

    def __init__(self, work: Turns[T]) -> None:
        self._work = work
        self._end: Future[T] = Future()
        self.wants_more = False  # than the picture that is to be drawn
        self.go_on()

    def go_on(self, depsgraph: Depsgraph = None) -> bool:
        """Do the work's next turn; return whether it has ended."""
        self.hear()
        return self._do(lambda: self._work.send(depsgraph))

    def hear(self) -> None:
        """Have the work end, if a signal was heard."""
        try:
            check()
        except KeyboardInterrupt as interrupt:
            self.fail(interrupt)

    def fail(self, error: BaseException) -> None:
        """Have the work fail where it is, unless it has ended."""
        self._do(lambda: self._work.throw(error))

    def result(self) -> T:
        """Return what the work returned, or raise what it raised."""
        return self._end.result(timeout=0)

    def _do(self, turn: Callable[[], bool]) -> bool:
        if not self._end.done():
            self.wants_more = False
            try:
                self.wants_more = turn()
            except StopIteration as stop:
                self._end.set_result(stop.value)
            except BaseException as error:
                self._end.set_exception(error)
        return self._end.done()
