"""Records the tracer's computations as expressions: the bridge from its code to `proofs/`."""
