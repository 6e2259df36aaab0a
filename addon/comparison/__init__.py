"""The comparison of a traced scene with a picture: the driver and its result."""
