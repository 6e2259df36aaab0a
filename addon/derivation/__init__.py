"""One ray, step by step, with the scene's own numbers."""
