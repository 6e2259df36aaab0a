"""What is recorded: a record for each function, with the theorem that is about it."""

from .record import Inputs, Output, Record, computed, outputs, recorded
from .table import RECORDS

__all__ = ["RECORDS", "Inputs", "Output", "Record", "computed", "outputs", "recorded"]
