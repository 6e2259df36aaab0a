"""The checks that say why pixels differ, a cause or two each; `causes.py` has their order."""
