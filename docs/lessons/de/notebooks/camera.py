# %% [markdown]
# # Die Kamera
#
# Vom Pixel zum Strahl, mit beiden Kameras der Übung. Braucht numpy, trimesh und das Paket
# `reference_tracer`, kein Blender. Zahlen stehen wie im Programm, mit Dezimalpunkt und
# Tausenderkomma.

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
# ## 1. Die perspektivische Kamera
#
# Im Kameraraum: Das Auge ist (0, 0, 0), die Achsen sind x, y und −z. So sieht man nur die
# Formeln. α ist der *halbe* senkrechte Öffnungswinkel.

# %%
scene = load_scene(str(SCENES / "exercise_perspective.npz"))
camera = scene.camera
rows, columns = camera.height, camera.width
alpha = math.atan(camera.window.top)
print(f"{columns} x {rows} Pixel, halber Winkel: {math.degrees(alpha):.2f} Grad")


# %%
def direction(i, j):
    """Gibt d des Pixels in Spalte i und Zeile j (0 ist die unterste) zurück, im Kameraraum."""
    pixel = math.tan(alpha) / (rows / 2)
    x = (i - (columns - 1) / 2) * pixel
    y = (j - (rows - 1) / 2) * pixel
    return np.stack(np.broadcast_arrays(x, y, -1.0))


for i, j in ((0, 0), (columns - 1, rows - 1), (columns // 2, rows // 2)):
    d = direction(i, j)
    print(f"Pixel ({i}, {j}): d = {d}, von der Länge {np.linalg.norm(d):.4f}")

# %% [markdown]
# Die Strahlen des Tracers selbst, in den Kameraraum gedreht, sind bis auf Rundung dieselben.

# %%
i, j = np.meshgrid(np.arange(columns), np.arange(rows))  # Zeile für Zeile, von unten
rays = camera_rays(camera, i.ravel() + 0.5, j.ravel() + 0.5)
axes = camera.world_from_camera[:3, :3]
theirs = axes.T @ rays.directions
ours = direction(i, j).reshape(3, -1)
print(f"größter Unterschied: {np.abs(theirs - ours).max():.0e}")
assert np.abs(theirs - ours).max() < 1e-6

# %% [markdown]
# ## 2. Das Bild und das halbe Pixel
#
# Das Halbe in i + ½ verschiebt jede Kante. So viele Pixel ändern sich ohne es:

# %%
frame = render(scene)
half = 0.5 * (camera.window.right - camera.window.left) / columns
moved = render(scene.seen_by(replace(camera, window=camera.window.moved(-half, -half))))
changed = (frame.color != moved.color).any(axis=2)
print(f"{changed.sum():,} von {changed.size:,} Pixeln")
assert 0 < changed.mean() < 0.05
Picture(frame.color)

# %%
Picture(np.where(changed[..., None], np.array((1, 0, 0, 1)), frame.color * (0.3, 0.3, 0.3, 1)))

# %% [markdown]
# ## 3. Der Tangens, falsch gelesen
#
# tan(α / (rows/2)) ist fast dasselbe wie tan(α) / (rows/2), solange α klein ist.

# %%
for degrees in (5, 15.11, 30, 60):
    a = math.radians(degrees)
    factor = math.tan(a / (rows / 2)) / (math.tan(a) / (rows / 2))
    print(f"α = {degrees}°: Die oberste Zeile liegt um {rows / 2 * (1 - factor):.1f} Pixel daneben")

# %% [markdown]
# ## 4. Ein eigenes Netz
#
# trimesh erzeugt oder liest eines. Ohne Kamera wird es ganz ins Bild gesetzt.

# %%
_ = trimesh.creation.icosphere(subdivisions=2).export("mesh.ply")
mesh = load_scene("mesh.ply")
small = replace(mesh.camera, width=240, height=135, region=None)
seen = render(mesh.seen_by(small))
print(f"{mesh.triangle_count} Dreiecke, in {(seen.triangle_index >= 0).sum()} Pixeln zu sehen")
Picture(seen.color)

# %% [markdown]
# **Jetzt Sie.**
#
# 1. Schreiben Sie `origin_and_direction(i, j)` der *orthografischen* Kamera, und vergleichen Sie es
#    mit `camera_rays` von `exercise_orthographic.npz`.
# 2. Normieren Sie d in `direction`. Was wird aus t, und was aus dem Bild?
# 3. Nehmen Sie α für den ganzen Winkel. Um welchen Faktor wird alles kleiner?
