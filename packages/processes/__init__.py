"""Runs programs of others within limits: students' own, renderers, exporters."""
