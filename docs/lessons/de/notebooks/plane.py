# %% [markdown]
# # Die Ebene
#
# t = −((o − p) · n) / (d · n), für alle Strahlen eines Bildes auf einmal. Braucht numpy und das
# Paket `reference_tracer`, kein Blender. Zahlen stehen wie im Programm, mit Dezimalpunkt und
# Tausenderkomma.

# %%
from importlib.resources import files

import numpy as np
from picture import Picture
from reference_tracer import camera_rays, load_scene, render

scene = load_scene(str(files("reference_tracer_grading") / "scenes/exercise_plane.npz"))
camera, plane = scene.camera, scene.planes[0]
p, n = plane.point, plane.normal
print("ein Punkt der Ebene:", p, "ihre Normale:", n)

# %% [markdown]
# ## 1. Eine Formel, alle Strahlen

# %%
j, i = np.divmod(np.arange(camera.width * camera.height), camera.width)  # von unten an
rays = camera_rays(camera, i + 0.5, j + 0.5)
o, d = rays.origins.T, rays.directions.T  # (n, 3) oder (1, 3)
with np.errstate(divide="ignore"):
    t = -((o - p) @ n) / (d @ n)
t = t.reshape(camera.height, camera.width)
print("vor dem Auge:", (t > 0).sum(), "von", t.size, "Pixeln")

# %% [markdown]
# Die Antwort des Tracers, wo nichts vor der Ebene steht:

# %%
frame = render(scene)
on_plane = (frame.instance_index >= 0) & (frame.triangle_index < 0)
worst = (np.abs(t - frame.t)[on_plane] / frame.t[on_plane]).max()
print(f"{on_plane.sum():,} Pixel sehen die Ebene; t ist höchstens {worst:.1e} anders, relativ")
assert worst < 1e-9
Picture(frame.color)

# %% [markdown]
# ## 2. Der Horizont
#
# Die Tiefe der höchsten Zeilen, die die Ebene sehen. Ein Pixel ist dort ein weiter Weg.

# %%
row_numbers = np.flatnonzero(on_plane.any(axis=1))
depth = np.array([np.median(t[row][on_plane[row]]) for row in row_numbers])
for row, one in list(zip(row_numbers, depth, strict=True))[-4:]:
    print(f"Zeile {row}: {one:.0f} m")
steepness = 1 / depth  # proportional zu d · n, nimmt also gleichmäßig ab
below = steepness[-1] / (steepness[-2] - steepness[-1])
print(f"die Mitte der höchsten Zeile liegt {below:.2f} Pixel unter dem Horizont")
assert 1.8 < below < 1.9

# %% [markdown]
# ## 3. Parallele Strahlen
#
# d · n = 0. numpy dividiert und sagt inf oder NaN; Python selbst meldet einen Fehler.

# %%
with np.errstate(divide="ignore", invalid="ignore"):
    for above in (1.9, 0.0):
        answer = -np.float64(above) / np.float64(0.0)
        print(f"Auge {above} m über der Ebene: t = {answer}, t > 0 ist {answer > 0}")
try:
    print(1.9 / 0.0)
except ZeroDivisionError as error:
    print("Python:", error)

# %% [markdown]
# ## 4. Ein Epsilon hat eine Einheit
#
# `if abs(d · n) < 1e-6: kein Treffer` schneidet die Ebene ab; wo, hängt von der Länge von n ab.

# %%
for length in (1, 1e-3, 1e-4, 1e-5, 1e-6):
    slope = (d @ (length * n)).reshape(t.shape)
    lost = (t > 0) & (np.abs(slope) < 1e-6)
    print(f"n von der Länge {length:g}: {lost.sum():,} von {(t > 0).sum():,} Pixeln verloren")
assert lost.sum() == (t > 0).sum()

# %% [markdown]
# **Jetzt Sie.**
#
# 1. Multiplizieren Sie d mit 1000. Was ändert sich: t, x, das Bild?
# 2. Berechnen Sie t in float32 (`o.astype(np.float32)` und so weiter). Wie viele Stellen sind in
#    der höchsten Zeile richtig?
# 3. Setzen Sie das Auge 1 µm über die Ebene. Welche Pixel sehen sie?
