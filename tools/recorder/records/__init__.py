"""What is recorded: a record for each function, with the theorem that is about it."""

from .record import BY_HAND, Inputs, Output, Record, computed, outputs, recorded
from .table import FILES, RECORDS

__all__ = [
    "BY_HAND",
    "FILES",
    "RECORDS",
    "Inputs",
    "Output",
    "Record",
    "computed",
    "outputs",
    "recorded",
]
