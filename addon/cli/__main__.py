"""Runs the command line: `python -m reference_tracer.cli`."""

import sys

from .main import main

sys.exit(main())
