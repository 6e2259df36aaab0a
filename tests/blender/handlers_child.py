"""One comparison after another, each with a handler of a script's that adds or removes data.

`python handlers_child.py JUDGE:HANDLER:ACTION:KIND ...` prints a line for each that is survived.
What crashes Blender ends it: so it is a process of its own.
"""

import sys

import bpy
import reference_tracer
from reference_tracer.blender.ui.results import Kind, latest

DATA = bpy.data


def new_object():
    bpy.context.scene.collection.objects.link(DATA.objects.new("Added", DATA.meshes[0]))


def new_collection():
    bpy.context.scene.collection.children.link(DATA.collections.new("Added"))


NEW = {
    "objects": new_object,
    "collections": new_collection,
    "meshes": lambda: DATA.meshes.new("Added"),
    "materials": lambda: DATA.materials.new("Added"),
    "images": lambda: DATA.images.new("Added", 4, 4),
    "scenes": lambda: DATA.scenes.new("Added"),
}


def removes(kind):
    found = (b for b in getattr(DATA, kind) if b.name.startswith("Added"))
    if block := next(found, None):
        getattr(DATA, kind).remove(block)


def compared(judge, name, action, kind):
    """Return the verdict on the scene that Blender starts with, and how often the handler ran."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = 32, 18
    scene.reference_tracer.judge = judge
    if action == "remove":
        for _ in range(40):  # more than there are calls
            NEW[kind]()
    calls = []

    def handler(*_):
        calls.append(name)
        if len(calls) <= 40:  # what is added may itself be told to the handler, without end
            NEW[kind]() if action == "add" else removes(kind)

    handlers = getattr(bpy.app.handlers, name)
    handlers.append(handler)
    before = {s.name for s in DATA.scenes}
    try:
        bpy.ops.reference_tracer.compare()
    finally:
        handlers.remove(handler)
    assert not {s for s in DATA.scenes if s.name not in before and not s.name.startswith("Added")}
    return latest(Kind.COMPARISON, scene).content.verdict, len(calls)


reference_tracer.register()
for wanted in sys.argv[1:]:
    print("survived", wanted, *compared(*wanted.split(":")), sep="\t", flush=True)
reference_tracer.unregister()
