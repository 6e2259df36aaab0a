"""PLY files that tests write."""

from __future__ import annotations

import numpy as np


def write_ply(path, points, lists, form, index="int"):
    """Write elements of lists, by their names, as a PLY in any of its three forms."""
    names = "".join(
        f"element {name} {len(rows)}\nproperty list int {index} vertex_indices\n"
        for name, rows in lists.items()
    )
    head = f"ply\nformat {form} 1.0\nelement vertex {len(points)}\n"
    head += "".join(f"property float {x}\n" for x in "xyz") + names + "end_header\n"
    rows = [row for some in lists.values() for row in some]
    order = ">" if "big" in form else "<"
    if form == "ascii":
        lines = [*map(list, points), *([len(row), *row] for row in rows)]
        body = "".join(f"{' '.join(map(str, line))}\n" for line in lines).encode()
    else:
        body = np.asarray(points).astype(f"{order}f4").tobytes()
        for row in rows:
            body += np.array([len(row), *row]).astype(f"{order}i4").tobytes()
    path.write_bytes(head.encode() + body)
