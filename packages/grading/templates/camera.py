"""Your own camera rays, to be judged by `reftrace judge --subject camera THIS_FILE.py`.

You get n pixels, each with the camera that it belongs to:

    pixels        (n, 2) float64     column and row; pixel (0, 0) is the lowest on the left
    resolutions   (n, 2) float64     how many columns and rows the picture has
    orthographic  (n,) float64       1: an orthographic camera; 0: a perspective one
    lens          (n,) float64       its focal length, in millimetres
    sensor        (n,) float64       its width, in millimetres, of the picture's longer side
    scale         (n,) float64       of an orthographic camera: metres, of the picture's longer side
    shifts        (n, 2) float64     to the right and up, in lengths of the picture's longer side
    matrices      (n, 3, 4) float64  world from camera: the columns are x (right), y (up),
                                     z (backward: a camera looks along -z), and the position

You return the ray through the pixel's centre, x = o + t d, in world space:

    directions  (n, 3)   d, of any length
    origins     (n, 3)   o: the camera's position; of an orthographic camera where the ray leaves
                         the plane through its position, across its view

Pixels are square. Do not change the arrays that you are given.
"""

import numpy as np


def camera_ray(pixels, resolutions, orthographic, lens, sensor, scale, shifts, matrices):
    """Make the ray of each pixel."""
    # right, up, backward, position = np.moveaxis(matrices, 2, 0)
    directions = np.zeros((len(pixels), 3))
    origins = np.zeros((len(pixels), 3))

    # 1. How large is a pixel: one unit in front of a perspective camera, or of an orthographic one?
    # 2. How far is the pixel's centre from the picture's middle, in pixels? The shifts move it.
    # 3. A perspective camera's rays all begin in it; an orthographic one's are parallel.
    #    See np.where for doing one or the other.

    return directions, origins
