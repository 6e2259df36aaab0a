"""Which faces a camera sees: each with a witness, or a proof that it is hidden."""

from reference_tracer.visible import HIDDEN as HIDDEN
from reference_tracer.visible import SEEN as SEEN
from reference_tracer.visible import UNDECIDED as UNDECIDED
from reference_tracer.visible import Visible as Visible
from reference_tracer.visible import visible as visible
