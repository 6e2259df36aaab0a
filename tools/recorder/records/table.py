"""All records, by the file of `proofs/recorded/` that has their expressions."""

from . import bounds, boxes, camera, deciding, edges, film, keeping, pixels, quotient

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
