# %% [markdown]
# # The plane
#
# t = −((o − p) · n) / (d · n), for all rays of a picture at once. Needs numpy and the package
# `reference_tracer`; no Blender.

# %%
from importlib.resources import files

import numpy as np
from picture import Picture
from reference_tracer import camera_rays, load_scene, render

scene = load_scene(str(files("reference_tracer_grading") / "scenes/exercise_plane.npz"))
camera, plane = scene.camera, scene.planes[0]
p, n = plane.point, plane.normal
print("a point of the plane:", p, "its normal:", n)

# %% [markdown]
# ## 1. One formula, all rays

# %%
j, i = np.divmod(np.arange(camera.width * camera.height), camera.width)  # from the lowest row
rays = camera_rays(camera, i + 0.5, j + 0.5)
o, d = rays.origins.T, rays.directions.T  # (n, 3) or (1, 3)
with np.errstate(divide="ignore"):
    t = -((o - p) @ n) / (d @ n)
t = t.reshape(camera.height, camera.width)
print("in front of the eye:", (t > 0).sum(), "of", t.size, "pixels")

# %% [markdown]
# The tracer's answer, where nothing stands before the plane:

# %%
frame = render(scene)
on_plane = (frame.instance_index >= 0) & (frame.triangle_index < 0)
worst = (np.abs(t - frame.t)[on_plane] / frame.t[on_plane]).max()
print(f"{on_plane.sum():,} pixels see the plane; t differs by {worst:.1e} of itself at most")
assert worst < 1e-9
Picture(frame.color)

# %% [markdown]
# ## 2. The horizon
#
# The depth of the highest rows that see the plane. One pixel is a long way there.

# %%
row_numbers = np.flatnonzero(on_plane.any(axis=1))
depth = np.array([np.median(t[row][on_plane[row]]) for row in row_numbers])
for row, one in list(zip(row_numbers, depth, strict=True))[-4:]:
    print(f"row {row}: {one:.0f} m")
steepness = 1 / depth  # proportional to d · n, so it falls evenly from row to row
below = steepness[-1] / (steepness[-2] - steepness[-1])
print(f"the highest row's centre is {below:.2f} pixels below the horizon")
assert 1.8 < below < 1.9

# %% [markdown]
# ## 3. Parallel rays
#
# d · n = 0. numpy divides and says inf or NaN; Python itself raises an error.

# %%
with np.errstate(divide="ignore", invalid="ignore"):
    for above in (1.9, 0.0):
        answer = -np.float64(above) / np.float64(0.0)
        print(f"eye {above} m above the plane: t = {answer}, t > 0 is {answer > 0}")
try:
    print(1.9 / 0.0)
except ZeroDivisionError as error:
    print("Python:", error)

# %% [markdown]
# ## 4. An epsilon has a unit
#
# `if abs(d · n) < 1e-6: no hit` cuts the plane off, and where it does depends on n's length.

# %%
for length in (1, 1e-3, 1e-4, 1e-5, 1e-6):
    slope = (d @ (length * n)).reshape(t.shape)
    lost = (t > 0) & (np.abs(slope) < 1e-6)
    print(f"n of length {length:g}: {lost.sum():,} of {(t > 0).sum():,} pixels lost")
assert lost.sum() == (t > 0).sum()

# %% [markdown]
# **Your turn.**
#
# 1. Multiply d by 1000. What changes: t, x, the picture?
# 2. Compute t in float32 (`o.astype(np.float32)` and so on). How many digits are right in the
#    highest row?
# 3. Put the eye 1 µm above the plane. Which pixels see it?
