"""What is recorded: a record for each function, with the theorem that is about it."""

from .integers import HEAD as WHOLE_HEAD
from .record import BY_HAND, Inputs, Output, Record, computed, outputs, recorded
from .table import FILES, INTEGERS, NAMES, RECORDS, every_output

__all__ = [
    "BY_HAND",
    "FILES",
    "INTEGERS",
    "NAMES",
    "RECORDS",
    "WHOLE_HEAD",
    "Inputs",
    "Output",
    "Record",
    "computed",
    "every_output",
    "outputs",
    "recorded",
]
