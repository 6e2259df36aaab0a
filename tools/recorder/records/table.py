"""All records, in the order of `proofs/Recorded.v`."""

from . import bounds, boxes, camera, deciding, edges, film, keeping, pixels, quotient

RECORDS = (
    *bounds.RECORDS,
    *deciding.RECORDS,
    *edges.RECORDS,
    *pixels.RECORDS,
    *film.RECORDS,
    *camera.RECORDS,
    *boxes.RECORDS,
    *keeping.RECORDS,
    *quotient.RECORDS,
)
