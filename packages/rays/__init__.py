"""Rays in bulk: read from a file, and what they meet written to one; what they all meet."""
