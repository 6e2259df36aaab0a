"""All records, in the order of `proofs/Recorded.v`."""

from . import bounds, deciding

RECORDS = (*bounds.RECORDS, *deciding.RECORDS)
