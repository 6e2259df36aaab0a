"""All records, by the file of `proofs/recorded/` that has their expressions."""

from collections.abc import Iterator

from . import (
    bounds,
    boxes,
    camera,
    checker,
    conversions,
    deciding,
    dropping,
    edges,
    film,
    integers,
    keeping,
    pixels,
    quotient,
)
from .record import Output, outputs

FILES = {
    "RecordedBounds": bounds.RECORDS,
    "RecordedDecisions": deciding.RECORDS,
    "RecordedQuotient": quotient.RECORDS,
    "RecordedCamera": camera.RECORDS,
    "RecordedChoices": keeping.RECORDS,
    "RecordedEdges": edges.RECORDS,
    "RecordedPixels": pixels.RECORDS,
    "RecordedFilm": film.RECORDS,
    "RecordedBoxes": boxes.RECORDS,
    "RecordedDropping": dropping.RECORDS,
}
RECORDS = tuple(record for records in FILES.values() for record in records)
# The files of whole functions of integers: what they have, and how they begin.
WHOLE = {
    "RecordedIntegers": (integers.INTEGERS, integers.HEAD),
    "RecordedConversions": (conversions.CONVERSIONS, conversions.HEAD),
    "RecordedChecker": (checker.CHECKER, checker.HEAD),
}
NAMES = (*FILES, *WHOLE)


def every_output() -> Iterator[tuple[str, list[Output]]]:
    """Record everything; yields each file's name and what it has."""
    for file, records in FILES.items():
        yield file, [output for record in records for output in outputs(record)]
    for file, (whole, _) in WHOLE.items():
        yield file, [record.output() for record in whole]
