"""Your own search for the nearest hit: `reftrace judge --subject nearest THIS_FILE.py`.

You get n rays, each with a scene of its own of five objects. An object is one triangle in a space
of its own: a point p of it is at scale * p + position in the world.

    origins     (n, 3) float64        o, in world space
    directions  (n, 3) float64        d, of any length: it is not 1
    triangles   (n, 5, 3, 3) float64  triangles[k, i] has the corners of object i as its rows
    scales      (n, 5) float64        each object's scale
    positions   (n, 5, 3) float64     each object's position

You return

    t        (n,)   the ray parameter of the nearest hit, x = o + t d; np.inf where there is none
    objects  (n,)   which object that is, 0 to 4; anything where t is np.inf

A hit lies in front of the origin (t > 0), inside a triangle, on either of its two sides. Where two
objects are hit at one t, either is right. Do not change the arrays that you are given.
"""

import numpy as np


def nearest_hit(origins, directions, triangles, scales, positions):
    """Find what each ray hits first."""
    t = np.full(len(origins), np.inf)
    objects = np.zeros(len(origins))

    # 1. Take the ray into the object's space, or the corners into the world. What becomes of t?
    # 2. Test each object's triangle, for i in range(5).
    # 3. Of all hits with t > 0, which is the nearest?

    return t, objects
