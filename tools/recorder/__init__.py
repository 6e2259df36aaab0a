"""What the tracer computes, recorded as expressions: the bridge from its code to `proofs/`."""
