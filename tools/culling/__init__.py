"""What `draw_culling.py` draws and counts, taken from the tracer's own sweep."""
