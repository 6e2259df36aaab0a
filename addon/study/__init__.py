"""Measurements of the tracer itself: what each choice costs, and what it gets wrong."""
