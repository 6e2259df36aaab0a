"""Dask's workers trace pictures and find rows of studies, to the bit as one process does."""
