"""The certified picture, sooner; held equal to `plain.py` to the bit by a test."""
