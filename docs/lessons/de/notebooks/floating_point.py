# %% [markdown]
# # Gleitkommazahlen
#
# Was Gleitkommazahlen aus den Formeln der Übung machen. Dieses Notebook braucht nur Python:
# `Fraction` rechnet exakt, mit ganzen Zahlen. Zahlen stehen wie im Programm, mit Dezimalpunkt und
# Tausenderkomma.

# %%
import math
import random
import struct
from fractions import Fraction


def single(number):
    """Gibt die nächste Zahl in float32 zurück."""
    return struct.unpack("f", struct.pack("f", number))[0]


# %% [markdown]
# ## 1. Eine Gleitkommazahl ist ein Bruch
#
# Jedes float64 ist eine ganze Zahl mal eine Zweierpotenz. 0.1 gehört nicht dazu, gespeichert wird
# der Nachbar. `Fraction` zeigt ihn ganz.

# %%
print(Fraction(0.1))
print("0.1 wird zu groß gespeichert, um", float(Fraction(0.1) - Fraction(1, 10)))
print("0.1 + 0.2 == 0.3:", 0.1 + 0.2 == 0.3)
print("1/4 + 1/2 == 3/4:", 0.25 + 0.5 == 0.75)

# %% [markdown]
# ## 2. Der Abstand zur nächsten Gleitkommazahl
#
# Er heißt *ulp* (unit in the last place) und wächst mit der Zahl: float64 behält etwa 16
# Dezimalstellen, float32 etwa 7. Weit vom Ursprung bleiben für einen Meter weniger Stellen übrig.

# %%
for metres in (1, 1000, 1_000_000):
    step = math.ulp(float(metres))
    step_in_single = step * 2**29  # float32 hat 24 Binärstellen, float64 53
    assert single(metres + step_in_single) != metres == single(metres + step_in_single / 4)
    print(f"bei {metres:>9,} m ist das nächste float64 {step:.1e} m entfernt,", end=" ")
    print(f"das nächste float32 {step_in_single:.1e} m")

# %% [markdown]
# ## 3. Eine Differenz großer Zahlen
#
# Ein Punkt des Films, neben einem Auge, das 100 km vom Ursprung entfernt ist. Die Subtraktion ist
# exakt: Die Stellen gingen vorher verloren, als der Punkt gespeichert wurde. Darum wird die
# Richtung eines Strahls aus den Achsen der Kamera gebildet, d = x right + y up + forward, und nie
# aus einer solchen Differenz.

# %%
eye, offset = 100_000.0, 0.123456789
print("richtig:", offset)
print("als Differenz in float32:", single(single(eye + offset) - single(eye)))
print("als Differenz in float64:", (eye + offset) - eye)
assert (eye + offset) - eye != offset

# %% [markdown]
# ## 4. Die Summe, die nicht 1 ist
#
# Die Gewichte des Dreiecks nach dem Lehrbuch, mit Zahlen jeder Art.


# %%
def minus(a, b):
    return [p - q for p, q in zip(a, b, strict=True)]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]


def weights(p1, p2, p3, x):
    """Gibt s1, s2, s3 zurück, wie gedruckt."""
    n = cross(minus(p3, p1), minus(p2, p1))
    n_s1 = cross(minus(p2, p3), minus(x, p3))
    n_s2 = cross(minus(p1, p2), minus(x, p2))
    n_s3 = cross(minus(p3, p1), minus(x, p1))
    return [dot(n, n_s) / dot(n, n) for n_s in (n_s1, n_s2, n_s3)]


# %% [markdown]
# Tausend Dreiecke, und in jedem ein Punkt. Wie oft ist die Summe 1?

# %%
chance = random.Random(1)


def some_point():
    return [chance.uniform(-1, 1) for _ in range(3)]


def inside(corners):
    """Gibt einen Punkt eines Dreiecks zurück, gerundet."""
    u, v = sorted((chance.random(), chance.random()))
    shares = (u, v - u, 1 - v)
    return [sum(s * p[k] for s, p in zip(shares, corners, strict=True)) for k in range(3)]


cases = []
for _ in range(1000):
    corners = [some_point() for _ in range(3)]
    cases.append((*corners, inside(corners)))

in_floats = sum(sum(weights(*case)) == 1 for case in cases)
exactly = sum(sum(weights(*([Fraction(c) for c in p] for p in case))) == 1 for case in cases)
print(f"{in_floats} von 1000 in float64, {exactly} von 1000 exakt")
assert exactly == 1000 and 300 < in_floats < 700

# %% [markdown]
# Exakt ist sie es immer, was x auch ist: x hebt sich heraus. Die Bedingung prüft also nichts, und
# in Gleitkommazahlen wirft sie etwa die Hälfte aller Treffer weg.
#
# **Jetzt Sie.**
#
# 1. Setzen Sie einen Punkt *außerhalb* des Dreiecks in `weights` ein, exakt. Was ist die Summe?
# 2. Verschieben Sie alle Dreiecke um 1000. Wie viele Summen sind noch 1? Was wird noch schlechter?
# 3. Ersetzen Sie `== 1` durch eine Toleranz. Wie klein kann sie sein, ehe Treffer verloren gehen?
#    Und nach Frage 2?
