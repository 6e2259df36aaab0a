"""Reference Tracer: a renderer that one can read, and a judge of Blender's own picture.

As a Python package this folder is `reference_tracer`; inside Blender it is the add-on.
Nothing here imports bpy: the tracer works wherever numpy does.
"""

__version__ = "0.1.0"


def register() -> None:
    """Register the render engine, operators, panels, properties and commands (inside Blender)."""
    from .blender import commands, registration

    registration.register()
    commands.register()


def unregister() -> None:
    """Undo :func:`register`."""
    from .blender import commands, registration

    commands.unregister()
    registration.unregister()
