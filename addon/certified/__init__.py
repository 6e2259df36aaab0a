"""The proof, in reading order: plain, bounds, exact, ties, order, surfaces, contest, settle."""
