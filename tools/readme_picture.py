"""Makes the README's picture from a comparison's three: docs/images/comparison.png.

python tools/readme_picture.py [out/demo]; needs Pillow.
"""

import json
import sys
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

PANEL = 480, 270
AROUND = 12, 7  # pixels on each side of the one that is enlarged
ZOOM = 9
BACK, TEXT, FRAME = (24, 26, 30), (235, 235, 235), (255, 190, 60)


def main(folder: Path, out: Path) -> None:
    found = json.loads((folder / "comparison.json").read_text(encoding="utf-8"))
    x, y = found["metrics"]["largest_difference"]["pixel"]
    pixels, version = found["pixels"], found["blender"]["version"]
    titles = {
        "traced": "traced: plain Python and numpy",
        "blender": f"Blender {version}, {found['blender']['source']}",
        "difference": f"{pixels['agree']:,} of {pixels['total']:,} pixels agree",
    }
    inset = (2 * AROUND[0] + 1) * ZOOM, (2 * AROUND[1] + 1) * ZOOM
    gap, head = 12, 34
    size = 3 * PANEL[0] + 4 * gap, head + PANEL[1] + 2 * gap + inset[1] + gap
    sheet = Image.new("RGB", size, BACK)
    draw, font = ImageDraw.Draw(sheet), ImageFont.load_default(17)
    for k, (name, title) in enumerate(titles.items()):
        picture = Image.open(folder / f"{name}.png").convert("RGBA")
        flat = Image.alpha_composite(Image.new("RGBA", picture.size, (*BACK, 255)), picture)
        left, row = gap + k * (PANEL[0] + gap), picture.height - 1 - y
        sheet.paste(flat.resize(PANEL, Image.Resampling.LANCZOS), (left, head))
        draw.text((left, 8), title, TEXT, font)
        middle = left + x * PANEL[0] // picture.width, head + row * PANEL[1] // picture.height
        draw.rectangle([middle[0] - 6, middle[1] - 4, middle[0] + 6, middle[1] + 4], outline=FRAME)
        width, height = 2 * AROUND[0] + 1, 2 * AROUND[1] + 1
        first = (
            min(max(x - AROUND[0], 0), flat.width - width),
            min(max(row - AROUND[1], 0), flat.height - height),
        )
        box = *first, first[0] + width, first[1] + height
        near = flat.crop(box).resize(inset, Image.Resampling.NEAREST)
        corner = left + (PANEL[0] - inset[0]) // 2, head + PANEL[1] + gap
        sheet.paste(near, corner)
        draw.rectangle([*corner, corner[0] + inset[0], corner[1] + inset[1]], outline=FRAME)
    out.parent.mkdir(parents=True, exist_ok=True)
    sheet.save(out, optimize=True)


if __name__ == "__main__":
    project = Path(__file__).resolve().parents[1]
    main(
        Path(sys.argv[1]) if len(sys.argv) > 1 else project / "out/demo",
        project / "docs/images/comparison.png",
    )
