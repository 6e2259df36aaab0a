"""The tracer: a `Scene` and `Settings` in, a `Frame` out, with numpy alone."""
