"""The records: one for each function, with the theorem that is about it."""

from .record import BY_HAND, Inputs, Output, Record, computed, outputs, recorded
from .table import FILES, NAMES, RECORDS, WHOLE, every_output

__all__ = [
    "BY_HAND",
    "FILES",
    "NAMES",
    "RECORDS",
    "WHOLE",
    "Inputs",
    "Output",
    "Record",
    "computed",
    "every_output",
    "outputs",
    "recorded",
]
