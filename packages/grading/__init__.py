"""What students wrote themselves, judged against exact arithmetic: `judging.py` begins."""
