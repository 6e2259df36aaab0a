# %% [markdown]
# # The triangle
#
# The exercise's test, written down as printed, and its two errata. Needs numpy and the package
# `reference_tracer`; no Blender.

# %%
from dataclasses import replace
from importlib.resources import files

import numpy as np
from picture import Picture
from reference_tracer import camera_rays, load_scene, render

scene = load_scene(str(files("reference_tracer_grading") / "scenes/exercise_triangle.npz"))
camera = replace(scene.camera, width=320, height=180, region=None)  # every second pixel
scene = scene.seen_by(camera)

# %% [markdown]
# ## 1. As printed


# %%
def dot(a, b):
    return (a * b).sum(axis=-1)


def weights(p1, p2, p3, x):
    """Return s1, s2, s3 as printed, (3, n)."""
    n = np.cross(p3 - p1, p2 - p1)
    n_s1 = np.cross(p2 - p3, x - p3)
    n_s2 = np.cross(p1 - p2, x - p2)
    n_s3 = np.cross(p3 - p1, x - p1)
    return np.stack([dot(n, n_s) / dot(n, n) for n_s in (n_s1, n_s2, n_s3)])


def intersect(o, d, p1, p2, p3, sum_is_1):
    """Test n rays with one triangle; return t, inf where there is no hit."""
    n = np.cross(p3 - p1, p2 - p1)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = -dot(o - p1, n) / dot(d, n)
        s = weights(p1, p2, p3, o + t[:, None] * d)
        hit = (s >= 0).all(axis=0) & (s <= 1).all(axis=0) & (t > 0)
        if sum_is_1:
            hit &= s.sum(axis=0) == 1
    return np.where(hit, t, np.inf)


# %% [markdown]
# ## 2. The nearest of all triangles

# %%
j, i = np.divmod(np.arange(camera.width * camera.height), camera.width)
rays = camera_rays(camera, i + 0.5, j + 0.5)
o, d = rays.origins.T, rays.directions.T

triangles = []  # (corners, colour)
for instance in scene.instances:
    mesh = scene.meshes[instance.mesh]
    turn, move = instance.world_from_object[:3, :3], instance.world_from_object[:3, 3]
    corners = mesh.vertices.astype(float) @ turn.T + move
    slots = mesh.slots if mesh.slots is not None else np.zeros(len(mesh.triangles), int)
    for indices, slot in zip(mesh.triangles, slots, strict=True):
        triangles.append((corners[indices], instance.colors[min(slot, len(instance.colors) - 1)]))


def picture(sum_is_1):
    nearest = np.full(len(d), np.inf)
    color = np.tile(np.asarray(scene.background, float), (len(d), 1))
    for corners, own in triangles:
        t = intersect(o, d, *corners, sum_is_1)
        nearer = t < nearest
        nearest[nearer], color[nearer] = t[nearer], own
    return nearest.reshape(camera.height, -1), color.reshape(camera.height, camera.width, 4)


literal, literal_color = picture(sum_is_1=True)
repaired, repaired_color = picture(sum_is_1=False)
Picture(literal_color)

# %%
Picture(repaired_color)

# %% [markdown]
# ## 3. How many pixels are lost?
#
# `render` proves what each pixel sees.

# %%
frame = render(scene)
proven = frame.t
sees = np.isfinite(proven)
lost = sees & (literal != proven) & ~np.isclose(literal, proven, rtol=1e-9)
wrong = ~np.isclose(np.where(sees, repaired, 0), np.where(sees, proven, 0), rtol=1e-9)
print(f"with s1 + s2 + s3 == 1: {lost.sum():,} of {sees.sum():,} pixels are lost")
print(f"without: {wrong.sum()}")
assert 0.2 < lost.sum() / sees.sum() < 0.7 and not wrong.any()

# %% [markdown]
# ## 4. The first erratum: what does s₂ weigh?
#
# Put each corner in for x. s should say (1, 0, 0), (0, 1, 0), (0, 0, 1).

# %%
p1, p2, p3 = np.array(((0, 0, 0), (4, 0, 0), (0, 3, 0)), float)
for name, corner in (("p1", p1), ("p2", p2), ("p3", p3)):
    print(f"x = {name}: s1, s2, s3 = {weights(p1, p2, p3, corner)}")
assert weights(p1, p2, p3, p2).tolist() == [0, 0, 1]

# %% [markdown]
# *Fundamentals of Computer Graphics*, 2.7.2, has the same three products for a triangle a b c and a
# point p, where α weighs a, β weighs b and γ weighs c:
#
#     n   = (b − a) × (c − a)      n_a = (c − b) × (p − b)
#     n_b = (a − c) × (p − c)      n_c = (b − a) × (p − a)
#
# They are the exercise's with a = p1, **b = p3, c = p2**. So β, its s₂, weighs p3.

# %%
a, b, c, p = p1, p3, p2, np.array((1, 1, 0), float)
assert (np.cross(b - a, c - a) == np.cross(p3 - p1, p2 - p1)).all()
assert (np.cross(c - b, p - b) == np.cross(p2 - p3, p - p3)).all()  # n_a is n_s1
assert (np.cross(a - c, p - c) == np.cross(p1 - p2, p - p2)).all()  # n_b is n_s2
assert (np.cross(b - a, p - a) == np.cross(p3 - p1, p - p1)).all()  # n_c is n_s3

# %% [markdown]
# **Your turn.**
#
# 1. Give the corners the colours red, green and blue, and colour each pixel by its weights. Do it
#    as printed, too.
# 2. Exchange p2 and p3 of every triangle. What changes?
# 3. Keep only triangles with d · n > 0. Which of the scene's triangles vanish?
# 4. Have your own test judged: `reftrace judge --template mine.py` writes a file to begin with.
