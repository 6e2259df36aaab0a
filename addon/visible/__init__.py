"""Which faces a camera sees: each with a witness, or a proof that it is hidden."""

from .visible import HIDDEN as HIDDEN
from .visible import SEEN as SEEN
from .visible import UNDECIDED as UNDECIDED
from .visible import Visible as Visible
from .visible import steps as steps
from .visible import visible as visible
