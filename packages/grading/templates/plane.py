"""Your own ray/plane test, to be judged by `reftrace judge --subject plane THIS_FILE.py`.

You get n rays and n infinite planes, pair by pair: ray k is to be tested with plane k only.

    origins     (n, 3) float64      o, in world space
    directions  (n, 3) float64      d, of any length: it is not 1
    points      (n, 3) float64      p, a point of the plane
    normals     (n, 3) float64      n, its normal, of any length

You return

    t     (n,)     the ray parameter of the hit, x = o + t d; np.inf where there is none
    hits  (n, 3)   x; anything where t is np.inf

A hit lies in front of the origin (t > 0), on either of the plane's two sides. A ray that is
parallel to the plane has none, nor has one that lies in it. Do not change the arrays that you are
given.
"""

import numpy as np


def intersect_plane(origins, directions, points, normals):
    """Test each ray with its own plane."""
    t = np.full(len(origins), np.inf)
    hits = np.zeros((len(origins), 3))

    # 1. A point x lies in the plane if (x - p) . n = 0. Put x = o + t d into this: what is t?
    #    For a . b of n pairs of vectors, write (a * b).sum(axis=1).
    # 2. What becomes of t where d . n = 0, and what is to be returned there?
    # 3. A hit: t > 0.

    return t, hits
