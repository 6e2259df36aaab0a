"""Students' own ray/triangle tests, judged against exact arithmetic: `judging.py` begins."""
