"""Shows a picture in a notebook. Beside the notebooks, so that each can import it."""

from reference_tracer.files import png
from reference_tracer.files.images import to_display


class Picture:
    """Linear RGBA (h, w, 4), row 0 at the bottom, which a notebook shows as a PNG."""

    def __init__(self, color):
        self.color = color

    def _repr_png_(self):
        return png.encode(to_display(self.color))
