"""Blender looks for an add-on beside its manifest: this file hands over to `addon/`.

The imports stand inside the functions because pytest, too, may import this file, and then it has no
parent package that a relative import could start from.
"""


def register() -> None:
    """Add Reference Tracer to Blender."""
    from . import addon

    addon.register()


def unregister() -> None:
    """Take Reference Tracer out of Blender."""
    from . import addon

    addon.unregister()
