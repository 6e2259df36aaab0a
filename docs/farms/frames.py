"""Render frames with Blender: each is whole or absent, and one that is there is not done again.

blender -b FILE -E REFERENCE_TRACER -o DIR/#### -F PNG --python-exit-code 1 -P frames.py -- 1-250
"""

import re
import sys
import uuid
from pathlib import Path

import bpy

scene, named, failed = bpy.context.scene, sys.argv[-1], []
valid = re.fullmatch(r"(-?\d+(--?\d+)?(,|$))+", named)
ranges = re.findall(r"(-?\d+)(?:-(-?\d+))?", named) if valid else []
frames = [n for first, last in ranges for n in range(int(first), int(last or first) + 1)]
places = {n: Path(bpy.path.abspath(scene.render.frame_path(frame=n))) for n in frames}
print(*(f"{place} is there already" for place in places.values() if place.exists()), sep="\n")
for frame, place in places.items():
    if not place.exists():
        scene.frame_start = scene.frame_end = frame
        scene.render.filepath = str(place.with_name(f".unfinished-{uuid.uuid4().hex}-####"))
        aside = Path(scene.render.frame_path(frame=frame))
        try:
            bpy.ops.render.render(animation=True)
            aside.replace(place)
        except (OSError, RuntimeError) as error:
            aside.unlink(missing_ok=True)
            failed.append(f"frame {frame}: {error}")
sys.exit("\n".join(failed) or (not frames and f"'{named}' names no frames: end with -- 1-9,17"))
