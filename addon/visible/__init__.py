"""Which faces a camera sees: each with a witness, or a proof that it is hidden."""

from .found import HIDDEN as HIDDEN
from .found import SEEN as SEEN
from .found import UNDECIDED as UNDECIDED
from .found import Visible as Visible
from .visible import steps as steps
from .visible import visible as visible
