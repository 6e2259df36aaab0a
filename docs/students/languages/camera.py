"""Right camera rays as a program: reftrace judge --subject camera --run 'python camera.py'."""

import sys


def ray(column, row, columns, rows, orthographic, lens, sensor, scale, shift_x, shift_y, *matrix):
    right, up, back, position = (matrix[k::4] for k in range(4))
    longer = max(columns, rows)
    pixel = (scale if orthographic else sensor / lens) / longer
    x = column + 0.5 - columns / 2 + shift_x * longer
    y = row + 0.5 - rows / 2 + shift_y * longer
    u, v = x * pixel, y * pixel
    across = [u * a + v * b for a, b in zip(right, up, strict=True)]
    if orthographic:
        return [-c for c in back], [e + a for e, a in zip(position, across, strict=True)]
    return [a - c for a, c in zip(across, back, strict=True)], position


for line in sys.stdin:
    direction, origin = ray(*map(float, line.split(",")))
    print(*direction, *origin, sep=",")
