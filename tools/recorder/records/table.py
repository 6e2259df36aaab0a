"""All records, in the order of `proofs/Recorded.v`."""

from . import bounds, deciding, edges, pixels

RECORDS = (*bounds.RECORDS, *deciding.RECORDS, *edges.RECORDS, *pixels.RECORDS)
