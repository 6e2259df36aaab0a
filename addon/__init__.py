"""Reference Tracer: a renderer that one can read, and a judge of Blender's own picture.

As a Python package this folder is `reference_tracer`; inside Blender it is the add-on.
Nothing here imports bpy: the tracer works wherever numpy does.

What a script may use is named in `__all__`, and described in docs/python.md; all else may change.
It is imported once it is asked for, so that Blender starts no later for it.
"""

from typing import Any

__version__ = "0.1.0"

__all__ = [  # noqa: F822  # each is imported on first use
    "Camera",
    "Comparison",
    "Frame",
    "Instance",
    "Mesh",
    "Plane",
    "Rays",
    "Region",
    "Scene",
    "SceneError",
    "Settings",
    "Verdict",
    "ViewWindow",
    "camera_rays",
    "compare",
    "describe",
    "explain",
    "inside",
    "load_scene",
    "read_camera",
    "render",
    "save_scene",
    "trace",
    "write_camera",
]


def __getattr__(name: str) -> Any:
    """Return one of what is offered."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from . import api

    return getattr(api, name)


def __dir__() -> list[str]:
    """Return what is offered, and what every module has."""
    return sorted([*globals(), *__all__])


def _command(argv: list[str]) -> int:
    """Run `blender FILE --command reference_tracer ...`; return the exit code."""
    from .cli import in_blender

    return in_blender.run(argv)


def register() -> None:
    """Register the render engine, operators, panels, properties and commands (inside Blender)."""
    from .blender import registration

    registration.register(_command)


def unregister() -> None:
    """Undo :func:`register`."""
    from .blender import registration

    registration.unregister()
