"""All records, by the file of `proofs/recorded/` that has their expressions."""

from collections.abc import Iterator

from . import bounds, boxes, camera, deciding, edges, film, integers, keeping, pixels, quotient
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
}
RECORDS = tuple(record for records in FILES.values() for record in records)
INTEGERS = "RecordedIntegers"  # the file of whole functions of integers
NAMES = (*FILES, INTEGERS)


def every_output() -> Iterator[tuple[str, list[Output]]]:
    """Record everything; yields each file's name and what it has."""
    for file, records in FILES.items():
        yield file, [output for record in records for output in outputs(record)]
    yield INTEGERS, [record.output() for record in integers.INTEGERS]
