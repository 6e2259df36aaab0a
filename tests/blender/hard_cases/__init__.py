"""Scenes that are hard to judge, as users build them: each builder takes a `Build` and makes one.

A scene has coloured solids in view besides its hard thing, and stands at a frame where it matters.
What is simulated is stepped there from the first frame on, as Blender keeps no other cache of it.
Nothing here needs more than `bpy` and numpy: a whole Blender can build these scenes, too.
"""

# ruff: noqa: F401 - the tests name the scenes here
from __future__ import annotations

from .edited import (
    EDIT_MODE,
    edited,
    edited_and_changed,
    edited_and_hidden,
    edited_shared,
    edited_subdivided_and_hidden,
    edited_with_mirror,
    edited_with_subdivision,
    edited_without_its_modifier,
)
from .hair import (
    DRAWS_NOTHING,
    HAIR,
    empty_grease_pencil,
    empty_volume,
    grease_pencil,
    grow_hair,
    hair_and_particles,
    hair_curves,
    hair_curves_with_mesh,
    hair_everywhere,
    hair_on_points,
    instanced_hair,
    nodes_with_curves,
    nodes_with_points,
    particle_hair,
    point_cloud,
)
from .pictures import (
    EMPTY,
    SCALED,
    SWITCHED_OFF,
    all_behind,
    all_hidden,
    camera_looks_away,
    far_from_origin,
    fine_edges,
    huge,
    no_mesh,
    tiny,
)
from .simulated import (
    SIMULATIONS,
    baked_rigid_body,
    cloth,
    particles,
    particles_of_collection,
    rigid_body,
    simulation_zone,
    soft_body,
)
from .stage import CYAN, ORANGE, PINK, ball, colored, emitter, grid, stage, step_to
from .surfaces import (
    GLASS,
    IN_FRONT,
    glass_around,
    glass_pane,
    holdout,
    in_front,
    in_front_and_transparent,
    no_active_color,
    painted_instances,
    see_through_object_color,
    textured,
    two_in_front,
    unseen_by_camera_rays,
)

ALL = (
    *SIMULATIONS,
    *EDIT_MODE,
    *HAIR,
    hair_everywhere,
    *DRAWS_NOTHING,
    *GLASS,
    glass_around,
    no_active_color,
    *IN_FRONT,
    unseen_by_camera_rays,
    holdout,
    *EMPTY,
    fine_edges,
    painted_instances,
    *SWITCHED_OFF,
    far_from_origin,
    *SCALED,
)
