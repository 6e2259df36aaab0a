# %% [markdown]
# # Floating point
#
# What floats make of the exercise's formulas. This notebook needs Python alone: `Fraction` computes
# exactly, with integers.

# %%
import math
import random
import struct
from fractions import Fraction


def single(number):
    """Return the float32 that is nearest to a number."""
    return struct.unpack("f", struct.pack("f", number))[0]


# %% [markdown]
# ## 1. A float is a fraction
#
# Every float64 is an integer times a power of two. 0.1 is not one of them, what is stored is its
# neighbour. `Fraction` shows it whole.

# %%
print(Fraction(0.1))
print("0.1 is stored too large by", float(Fraction(0.1) - Fraction(1, 10)))
print("0.1 + 0.2 == 0.3:", 0.1 + 0.2 == 0.3)
print("1/4 + 1/2 == 3/4:", 0.25 + 0.5 == 0.75)

# %% [markdown]
# ## 2. The distance to the next float
#
# It is called *ulp*, unit in the last place, and grows with the number: some 16 decimal digits are
# kept in float64, some 7 in float32. So far from the origin a metre has fewer digits left.

# %%
for metres in (1, 1000, 1_000_000):
    step = math.ulp(float(metres))
    step_in_single = step * 2**29  # float32 has 24 binary digits, float64 has 53
    assert single(metres + step_in_single) != metres == single(metres + step_in_single / 4)
    print(f"at {metres:>9,} m the next float64 is {step:.1e} m away,", end=" ")
    print(f"the next float32 {step_in_single:.1e} m")

# %% [markdown]
# ## 3. A difference of large numbers
#
# A point of the film, beside an eye that is 100 km from the origin. The subtraction is exact: the
# digits were lost before, when the point was stored. That is why a ray's direction is made of the
# camera's axes, d = x right + y up + forward, and never of such a difference.

# %%
eye, offset = 100_000.0, 0.123456789
print("right:", offset)
print("as a difference in float32:", single(single(eye + offset) - single(eye)))
print("as a difference in float64:", (eye + offset) - eye)
assert (eye + offset) - eye != offset

# %% [markdown]
# ## 4. The sum that is not 1
#
# The triangle's weights by the textbook, with whatever numbers are put in.


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
    """Return s1, s2, s3 as printed."""
    n = cross(minus(p3, p1), minus(p2, p1))
    n_s1 = cross(minus(p2, p3), minus(x, p3))
    n_s2 = cross(minus(p1, p2), minus(x, p2))
    n_s3 = cross(minus(p3, p1), minus(x, p1))
    return [dot(n, n_s) / dot(n, n) for n_s in (n_s1, n_s2, n_s3)]


# %% [markdown]
# A thousand triangles, and a point inside each. How often is the sum 1?

# %%
chance = random.Random(1)


def some_point():
    return [chance.uniform(-1, 1) for _ in range(3)]


def inside(corners):
    """Return a point of a triangle, rounded."""
    u, v = sorted((chance.random(), chance.random()))
    shares = (u, v - u, 1 - v)
    return [sum(s * p[k] for s, p in zip(shares, corners, strict=True)) for k in range(3)]


cases = []
for _ in range(1000):
    corners = [some_point() for _ in range(3)]
    cases.append((*corners, inside(corners)))

in_floats = sum(sum(weights(*case)) == 1 for case in cases)
exactly = sum(sum(weights(*([Fraction(c) for c in p] for p in case))) == 1 for case in cases)
print(f"{in_floats} of 1000 in float64, {exactly} of 1000 exactly")
assert exactly == 1000 and 300 < in_floats < 700

# %% [markdown]
# Exactly, it always is, whatever x is: x cancels out. So the condition tests nothing, and in floats
# it throws about half of all hits away.
#
# **Your turn.**
#
# 1. Put a point *outside* the triangle into `weights`, exactly. What is the sum?
# 2. Move all triangles by 1000. How many sums are still 1? What else becomes worse?
# 3. Replace `== 1` by a tolerance. How small can it be, before hits are lost? And after question 2?
