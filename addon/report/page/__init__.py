"""A `Comparison` -> one HTML file that opens offline and says why each pixel differs.

`page.html`, `page.css` and the scripts here are the page; `content.py` gathers what it shows, and
`document.py` joins the two into one file. What the embedded JSON holds is in `page.schema.json`.
"""

from .document import NAME, write
from .extras import Extras, extras

__all__ = ["NAME", "Extras", "extras", "write"]
