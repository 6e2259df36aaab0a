"""The scenarios of numerical stability: `sweeps.py` lists them."""
