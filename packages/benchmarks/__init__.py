"""The benchmark: certified beside the plain test and beside other ray tracers, in one run."""
