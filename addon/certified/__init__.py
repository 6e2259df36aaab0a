"""The proven tracer.

In reading order: `definition` (the claim), `plain` (the definition with a filter), `ladder` (error
bound, order of depths, integers) with `bounds`, `order`, `exact` and `ties`. Then t and the
barycentrics, `measures` and `quotient`; what stands before the proof, `rounding` and `arithmetic`;
and `reasons`, for the user. `sweep/` finds the same sooner; without it, no truth is lost.
"""
