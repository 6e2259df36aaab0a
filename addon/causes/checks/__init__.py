"""The checks that say why pixels differ, a cause or two each; `explain.py` has their order."""
