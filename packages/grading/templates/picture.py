"""Your own pictures, to be judged by `reftrace judge --subject picture THIS_FILE.py`.

You get n scenes: a camera each, and six triangles, in world space. Each picture has 384 pixels.

    resolutions   (n, 2) float64        columns and rows: 24 and 16, or 16 and 24
    orthographic  (n,) float64          1: an orthographic camera; 0: a perspective one
    lens          (n,) float64          its focal length, in millimetres
    sensor        (n,) float64          its width, in millimetres, of the picture's longer side
    scale         (n,) float64          of an orthographic camera: metres, of the longer side
    shifts        (n, 2) float64        to the right and up, in lengths of the longer side
    matrices      (n, 3, 4) float64     world from camera: the columns are x (right), y (up),
                                        z (backward: a camera looks along -z), and the position
    triangles     (n, 6, 3, 3) float64  triangles[k, i] has the corners of object i as its rows

You return

    objects  (n, 384)   which object each pixel's centre shows, 0 to 5, or -1: row by row from the
                        lowest, each from left to right

An object is seen from both sides, and hides what is farther. What lies behind the camera is not
seen. Pixels are square. Do not change the arrays that you are given.
"""

import numpy as np


def picture(resolutions, orthographic, lens, sensor, scale, shifts, matrices, triangles):
    """Make each picture."""
    objects = np.full((len(triangles), 384), -1.0)

    # 1. The ray through each pixel's centre: columns change first, then rows.
    # 2. Test it with each triangle.
    # 3. The nearest hit in front of the camera is what is seen.

    return objects
