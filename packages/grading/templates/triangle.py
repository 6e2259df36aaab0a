"""Your own ray/triangle test, to be judged by `reftrace judge THIS_FILE.py`.

You get n rays and n triangles, pair by pair: ray k is to be tested with triangle k only.

    origins     (n, 3) float64      o, in world space
    directions  (n, 3) float64      d, of any length: it is not 1
    triangles   (n, 3, 3) float64   triangles[k] has the corners p1, p2, p3 as its rows

You return

    t             (n,)     the ray parameter of the hit, x = o + t d; np.inf where there is none
    barycentrics  (n, 3)   s1, s2, s3 with x = s1 p1 + s2 p2 + s3 p3; anything where t is np.inf

A hit lies in front of the origin (t > 0), inside the triangle, on either of its two sides. Do not
change the arrays that you are given. A scene may be a millimetre or a kilometre large.
"""

import numpy as np


def intersect(origins, directions, triangles):
    """Test each ray with its own triangle."""
    # p1, p2, p3 = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    t = np.full(len(origins), np.inf)
    barycentrics = np.zeros((len(origins), 3))

    # 1. The triangle's normal: n = (p3 - p1) x (p2 - p1). See np.cross.
    # 2. Where the ray meets its plane: t = -((o - p1) . n) / (d . n), x = o + t d.
    #    For a . b of n pairs of vectors, write (a * b).sum(axis=1).
    # 3. Three normals, of the edge and the point x:
    #    n_s1 = (p2 - p3) x (x - p3),  n_s2 = (p1 - p2) x (x - p2),  n_s3 = (p3 - p1) x (x - p1).
    # 4. The barycentrics: s_i = (n . n_si) / |n|^2. Which corner does each of them weigh?
    # 5. A hit: 0 <= s_i <= 1 for all three, and s1 + s2 + s3 = 1. What do floats make of the last?

    return t, barycentrics
