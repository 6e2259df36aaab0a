# %% [markdown]
# # Das Dreieck
#
# Der Test der Übung, aufgeschrieben wie gedruckt, und seine beiden Druckfehler. Braucht numpy und
# das Paket `reference_tracer`, kein Blender. Zahlen stehen wie im Programm, mit Dezimalpunkt und
# Tausenderkomma.

# %%
from dataclasses import replace
from importlib.resources import files

import numpy as np
from picture import Picture
from reference_tracer import camera_rays, load_scene, render

scene = load_scene(str(files("reference_tracer_grading") / "scenes/exercise_triangle.npz"))
camera = replace(scene.camera, width=320, height=180, region=None)  # jedes zweite Pixel
scene = scene.seen_by(camera)

# %% [markdown]
# ## 1. Wie gedruckt


# %%
def dot(a, b):
    return (a * b).sum(axis=-1)


def weights(p1, p2, p3, x):
    """Gibt s1, s2, s3 zurück, wie gedruckt, (3, n)."""
    n = np.cross(p3 - p1, p2 - p1)
    n_s1 = np.cross(p2 - p3, x - p3)
    n_s2 = np.cross(p1 - p2, x - p2)
    n_s3 = np.cross(p3 - p1, x - p1)
    return np.stack([dot(n, n_s) / dot(n, n) for n_s in (n_s1, n_s2, n_s3)])


def intersect(o, d, p1, p2, p3, sum_is_1):
    """Testet n Strahlen mit einem Dreieck; gibt t zurück, inf ohne Treffer."""
    n = np.cross(p3 - p1, p2 - p1)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = -dot(o - p1, n) / dot(d, n)
        s = weights(p1, p2, p3, o + t[:, None] * d)
        hit = (s >= 0).all(axis=0) & (s <= 1).all(axis=0) & (t > 0)
        if sum_is_1:
            hit &= s.sum(axis=0) == 1
    return np.where(hit, t, np.inf)


# %% [markdown]
# ## 2. Das nächste aller Dreiecke

# %%
j, i = np.divmod(np.arange(camera.width * camera.height), camera.width)
rays = camera_rays(camera, i + 0.5, j + 0.5)
o, d = rays.origins.T, rays.directions.T

triangles = []  # (Ecken, Farbe)
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
# ## 3. Wie viele Pixel gehen verloren?
#
# `render` beweist, was jedes Pixel sieht.

# %%
frame = render(scene)
proven = frame.t
sees = np.isfinite(proven)
lost = sees & (literal != proven) & ~np.isclose(literal, proven, rtol=1e-9)
wrong = ~np.isclose(np.where(sees, repaired, 0), np.where(sees, proven, 0), rtol=1e-9)
print(f"mit s1 + s2 + s3 == 1: {lost.sum():,} von {sees.sum():,} Pixeln gehen verloren")
print(f"ohne: {wrong.sum()}")
assert 0.2 < lost.sum() / sees.sum() < 0.7 and not wrong.any()

# %% [markdown]
# ## 4. Erster Druckfehler: Was gewichtet s₂?
#
# Setzen Sie für x jede Ecke ein. s sollte (1, 0, 0), (0, 1, 0), (0, 0, 1) sein.

# %%
p1, p2, p3 = np.array(((0, 0, 0), (4, 0, 0), (0, 3, 0)), float)
for name, corner in (("p1", p1), ("p2", p2), ("p3", p3)):
    print(f"x = {name}: s1, s2, s3 = {weights(p1, p2, p3, corner)}")
assert weights(p1, p2, p3, p2).tolist() == [0, 0, 1]

# %% [markdown]
# *Fundamentals of Computer Graphics*, 2.7.2, hat dieselben drei Produkte für ein Dreieck a b c und
# einen Punkt p, wobei α die Ecke a gewichtet, β die Ecke b und γ die Ecke c:
#
#     n   = (b − a) × (c − a)      n_a = (c − b) × (p − b)
#     n_b = (a − c) × (p − c)      n_c = (b − a) × (p − a)
#
# Mit a = p1, **b = p3, c = p2** sind es die der Übung. Also gewichtet β, ihr s₂, p3.

# %%
a, b, c, p = p1, p3, p2, np.array((1, 1, 0), float)
assert (np.cross(b - a, c - a) == np.cross(p3 - p1, p2 - p1)).all()
assert (np.cross(c - b, p - b) == np.cross(p2 - p3, p - p3)).all()  # n_a ist n_s1
assert (np.cross(a - c, p - c) == np.cross(p1 - p2, p - p2)).all()  # n_b ist n_s2
assert (np.cross(b - a, p - a) == np.cross(p3 - p1, p - p1)).all()  # n_c ist n_s3

# %% [markdown]
# **Jetzt Sie.**
#
# 1. Geben Sie den Ecken die Farben Rot, Grün und Blau, und färben Sie jedes Pixel nach seinen
#    Gewichten. Tun Sie es auch wie gedruckt.
# 2. Vertauschen Sie p2 und p3 jedes Dreiecks. Was ändert sich?
# 3. Behalten Sie nur Dreiecke mit d · n > 0. Welche Dreiecke der Szene verschwinden?
# 4. Lassen Sie Ihren eigenen Test bewerten: `reftrace judge --template mine.py` schreibt eine Datei
#    zum Anfangen.
