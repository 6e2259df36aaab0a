"""Checks certified pictures: `verify.py` is the checker, and needs numpy alone."""
