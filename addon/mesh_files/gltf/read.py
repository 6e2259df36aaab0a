"""Reads a .glb or .gltf: `container` → `extensions` → `nodes` → `shapes` and `skins` → `Contents`.

What the file holds is applied, refused by name, or named in a note with what it changes.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...scene import Mesh, SceneError
from ...wording import count_of
from ..contents import Contents, Placed
from .accessors import Accessors
from .buffers import Buffers
from .container import open_container
from .document import Document, Thing, short
from .extensions import INSTANCING, check_extensions
from .nodes import Tree, instances, read_tree
from .notes import Notes
from .shapes import Pose, Shapes, pose_of
from .skins import Skin, read_skin


def read_gltf(path: Path) -> Contents:
    """Read the meshes of a file's default scene, at rest, as Khronos' specification says.

    Positions are metres, Y up, as in the file. A mesh of several nodes is one `Mesh`. A skinned
    one is in world space, and its matrix the identity.

    Raises
    ------
    SceneError
        If the file is no glTF 2, is damaged, or needs what is not applied. The message names the
        thing in the file, but not the file.
    OSError
        If the file cannot be read.
    """
    notes = Notes()
    with np.errstate(all="ignore"):  # what is not finite is looked for, and refused by name
        container = open_container(path, notes)
        document = container.document
        check_extensions(document, notes)
        buffers = Buffers(document, path.parent, container.binary, notes)
        placed = _Reader(document, Accessors(document, buffers), notes).placed()
    _name_the_unused(document, notes)
    return Contents(tuple(placed), notes.sentences(), notes.missing())


class _Reader:
    """Reads the scene of one file."""

    def __init__(self, document: Document, accessors: Accessors, notes: Notes) -> None:
        self._document = document
        self._accessors = accessors
        self._notes = notes
        self._tree = read_tree(document, notes)
        self._shapes = Shapes(document, accessors, notes)
        self._meshes: dict[Pose, Mesh] = {}
        self._skins: dict[int, Skin] = {}

    def placed(self) -> list[Placed]:
        """Return every appearance of a mesh in the scene that is shown."""
        tree = self._tree
        shown = list(tree.below(_roots(self._document, tree, self._notes)))
        self._name_the_left_out(shown)
        seen = [k for k in shown if "mesh" in tree.nodes[k].content and k not in tree.hidden]
        names = _names(self._document, tree, seen)
        return [placed for k in seen for placed in self._of_node(k, names[k])]

    def _name_the_left_out(self, shown: list[int]) -> None:
        """Name nodes with a mesh that is not traced, and instances of no mesh."""
        nodes, hidden = self._tree.nodes, self._tree.hidden
        meshes = {k for k, node in enumerate(nodes) if "mesh" in node.content}
        left_out = {
            "Meshes outside the traced scene are left out": sorted(meshes - set(shown)),
            "Meshes hidden by KHR_node_visibility are left out": [
                k for k in shown if k in hidden and k in meshes
            ],
            "Instances of a node without a mesh show nothing": [
                k for k in shown if k not in meshes and nodes[k].extension(INSTANCING)
            ],
        }
        for sentence, numbers in left_out.items():
            if numbers:
                self._notes.add(sentence, *(nodes[k].label for k in numbers))

    def _of_node(self, number: int, name: str) -> list[Placed]:
        node = self._tree.nodes[number]
        pose = pose_of(node, self._document)
        worlds = instances(self._tree, number, self._accessors, self._notes)
        if pose.skin is not None:  # the joints alone place it
            if node.extension(INSTANCING):
                raise SceneError(
                    f"{node.label} has instances and a skin, and no specification says how these "
                    "go together: export the copies as nodes"
                )
            worlds = np.eye(4)[None]
        if pose not in self._meshes:
            self._meshes[pose] = self._shapes.mesh(pose, self._skin(pose.skin, node))
        mesh = self._meshes[pose]
        return [Placed(mesh, world, name) for world in worlds if len(mesh.triangles)]

    def _skin(self, number: int | None, node: Thing) -> Skin | None:
        if number is None:
            return None
        if number not in self._skins:
            self._skins[number] = read_skin(
                self._document, number, node.label, self._tree, self._accessors, self._notes
            )
        return self._skins[number]


def _roots(document: Document, tree: Tree, notes: Notes) -> list[int]:
    """Return the nodes that the shown scene begins with (specification 3.5.1)."""
    count, number = document.count("scenes"), document.refers("scene")
    if number is None and not count:
        notes.add("The file has no scene; all its nodes are traced")
        return [k for k in range(len(tree.nodes)) if k not in tree.parents]
    scene = document.thing("scenes", number or 0, "the file")
    if number is None and count > 1:
        notes.add(
            f"The file has {count} scenes and does not say which is shown; the first is traced",
            scene.label,
        )
    roots = scene.refers_all("nodes")
    for root in roots:
        document.thing("nodes", root, scene.label)
    return roots


def _names(document: Document, tree: Tree, numbers: list[int]) -> dict[int, str]:
    """Return a name for the object of each node; no two have the same."""
    names: dict[int, str] = {}
    taken: set[str] = set()
    for number in numbers:
        node = tree.nodes[number]
        mesh = document.thing("meshes", node.whole("mesh"), node.label)
        name = node.name or mesh.name or f"node {number}"
        while name in taken:
            name = f"{name} (node {number})"
        names[number] = name
        taken.add(name)
    return names


def _name_the_unused(document: Document, notes: Notes) -> None:
    """Name what the file has that is no mesh."""
    animations = [short(a.name) or a.label for a in document.every("animations")]
    if animations:
        notes.add("Animations are not played; everything is traced at rest", *animations)
    if count := document.count("cameras"):
        seeing = (node for node in document.every("nodes") if "camera" in node.content)
        names = (short(node.name) or node.label for node in seeing)
        notes.add(
            f"The file has {count_of(count, 'camera')}; --camera uses one by its node's name",
            *names,
        )
    lights = document.extension("KHR_lights_punctual")
    if lights and (count := len(lights.items("lights"))):
        notes.add(f"Lights are not used: the file has {count}")
