"""A `Comparison` -> pictures and JSON."""
