"""Says who made the other side's picture, and refuses one of another size."""

from __future__ import annotations

from dataclasses import dataclass, field


class SizeError(ValueError):
    """The pictures differ in size: how, then what else can be done where there are options."""

    def __str__(self) -> str:
        return "".join(self.args)


def check_size(own: tuple[int, ...], traced: tuple[int, ...]) -> None:
    """Refuse a picture of another size than the traced one: (h, w) each, or (h, w, c).

    Raises
    ------
    SizeError
        If they differ.
    """
    if own != traced:
        (height, width), (h, w) = own[:2], traced[:2]
        raise SizeError(
            f"The picture has {width} x {height} pixels, the traced one {w} x {h}. Render it at "
            "that size",
            f", or trace a .blend or a mesh at its own: --set width={width} height={height}",
        )


@dataclass(frozen=True)
class Source:
    """Who made the picture: one of Blender's engines, or anybody (then it has a file)."""

    name: str = "picture"
    version: str | None = None
    file: str = ""
    known: str = ""  # of a file: how it is known what made it, in words
    remarks: tuple[str, ...] = ()  # what a file says of its pixels that is not applied
    settings: dict[str, object] = field(default_factory=dict)
    what: str = "the picture"  # that its file holds

    def __str__(self) -> str:
        return f"{self.what} '{self.file}'" if self.file else f"Blender's {self.name} picture"


ANYBODY = Source()
