# %% [markdown]
# # The camera
#
# From a pixel to a ray, by both cameras of the exercise. Needs numpy, trimesh and the package
# `reference_tracer`; no Blender.

# %%
import math
from dataclasses import replace
from importlib.resources import files

import numpy as np
import trimesh
from picture import Picture
from reference_tracer import camera_rays, load_scene, render

SCENES = files("reference_tracer_grading") / "scenes"

# %% [markdown]
# ## 1. The perspective camera
#
# In camera space: the eye is (0, 0, 0), and the axes are x, y and −z. You see the
# formulas alone. α is *half* the vertical angle.

# %%
scene = load_scene(str(SCENES / "exercise_perspective.npz"))
camera = scene.camera
rows, columns = camera.height, camera.width
alpha = math.atan(camera.window.top)
print(f"{columns} x {rows} pixels, half the vertical angle is {math.degrees(alpha):.2f} degrees")


# %%
def direction(i, j):
    """Return d of the pixel in column i and row j (row 0 is the lowest), in camera space."""
    pixel = math.tan(alpha) / (rows / 2)
    x = (i - (columns - 1) / 2) * pixel
    y = (j - (rows - 1) / 2) * pixel
    return np.stack(np.broadcast_arrays(x, y, -1.0))


for i, j in ((0, 0), (columns - 1, rows - 1), (columns // 2, rows // 2)):
    d = direction(i, j)
    print(f"pixel ({i}, {j}): d = {d}, of length {np.linalg.norm(d):.4f}")

# %% [markdown]
# The tracer's own rays, turned into camera space, are the same to within rounding.

# %%
i, j = np.meshgrid(np.arange(columns), np.arange(rows))  # row by row, from the lowest
rays = camera_rays(camera, i.ravel() + 0.5, j.ravel() + 0.5)
axes = camera.world_from_camera[:3, :3]
theirs = axes.T @ rays.directions
ours = direction(i, j).reshape(3, -1)
print(f"largest difference: {np.abs(theirs - ours).max():.0e}")
assert np.abs(theirs - ours).max() < 1e-6

# %% [markdown]
# ## 2. The picture, and the half pixel
#
# The half in i + ½ moves every edge. So many pixels change without it:

# %%
frame = render(scene)
half = 0.5 * (camera.window.right - camera.window.left) / columns
moved = render(scene.seen_by(replace(camera, window=camera.window.moved(-half, -half))))
changed = (frame.color != moved.color).any(axis=2)
print(f"{changed.sum():,} of {changed.size:,} pixels")
assert 0 < changed.mean() < 0.05
Picture(frame.color)

# %%
Picture(np.where(changed[..., None], np.array((1, 0, 0, 1)), frame.color * (0.3, 0.3, 0.3, 1)))

# %% [markdown]
# ## 3. The tangent, misread
#
# tan(α / (rows/2)) is nearly the same as tan(α) / (rows/2), while α is small.

# %%
for degrees in (5, 15.11, 30, 60):
    a = math.radians(degrees)
    factor = math.tan(a / (rows / 2)) / (math.tan(a) / (rows / 2))
    print(f"α = {degrees}°: the top row is {rows / 2 * (1 - factor):.1f} pixels off")

# %% [markdown]
# ## 4. A mesh of your own
#
# trimesh makes or reads one. Without a camera it is framed.

# %%
_ = trimesh.creation.icosphere(subdivisions=2).export("mesh.ply")
mesh = load_scene("mesh.ply")
small = replace(mesh.camera, width=240, height=135, region=None)
seen = render(mesh.seen_by(small))
print(f"{mesh.triangle_count} triangles, seen in {(seen.triangle_index >= 0).sum()} pixels")
Picture(seen.color)

# %% [markdown]
# **Your turn.**
#
# 1. Write `origin_and_direction(i, j)` of the *orthographic* camera, and compare it with
#    `camera_rays` of `exercise_orthographic.npz`.
# 2. Normalise d in `direction`. What becomes of t, and of the picture?
# 3. Take α for the whole angle. By what factor is everything smaller?
