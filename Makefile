# Reference Tracer's chores. `make help` lists them.
#
# Everything runs in the virtual environment .venv, which the first command makes: with Python 3.13
# and bpy 5.2.3, else with Python 3.11 and bpy 5.0.1, else with one that uv fetches. To choose: make PYTHON=python3.11 demo

PYTHON_IN_VENV := .venv/bin/python

# Two workers for two cores, and one more, since the tests in a window mostly wait.
WORKERS := 3
PYTEST := $(PYTHON_IN_VENV) -m pytest
SHARED = -n $(WORKERS) --no-loadscope-reorder
# Bytecode is kept, also where the machine says no: else each of hundreds of processes compiles anew.
export PYTHONDONTWRITEBYTECODE :=
# Workers share the cores: numpy's library starts no threads in each of their hundreds of processes.
check test: export OPENBLAS_NUM_THREADS := 1

.PHONY: help demo check test set-up-tests all-tests test-matrix prove test-browser test-gui test-gpu \
	torture bench docs lessons lesson-tools lint style types extension release clean

help: ## list the commands
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1\t\2/p' Makefile | expand -t 20

demo: .venv/.stamp ## trace a sample scene, have Blender render it, compare: out/demo/page.html
	.venv/bin/reftrace compare sample_scenes/suzanne.blend --trade --out out/demo

check: WORKERS := 2
check: lint ## check the style, run the fast tests that need neither Blender nor a browser: a minute
	$(PYTEST) $(SHARED) --ignore tests/blender -q \
		-m "not blender and not browser and not gui and not slow and not torture"

# What the tests in a browser and in a window need, only root can install, and other Pythons have to
# be there: where that is not possible they are skipped, the run says so and is still a success.
# A whole Blender is set up by the first tests that need it, while others run.
# The types take one core for most of a minute: they are checked beside all else.
test: .venv/.stamp ## run the tests but the long ones, those in a browser and in a window too where that is possible
	@$(MAKE) --no-print-directory --jobs 3 style types all-tests

all-tests: style set-up-tests
	$(PYTEST) $(SHARED) -rs -m "not torture"

set-up-tests: extension
	@if tools/browser.sh check; then tools/browser.sh setup; fi
	@if tools/others.sh check; then tools/others.sh daily; fi

prove: .venv/.stamp ## have Coq read the proofs: 8 minutes on two cores; root installs Coq if it is missing
	tools/coq.sh setup
	$(PYTHON_IN_VENV) tools/prove.py

test-browser: .venv/.stamp ## run the tests of the page in a headless Chromium; root installs it
	tools/browser.sh setup
	$(PYTEST) -m browser

test-gui: extension ## run the tests in a whole Blender 5.2 with a window; needs root
	tools/whole_blender.sh setup
	$(PYTEST) -m gui

# ONLY="4.2 window": the cells whose names begin so.
test-matrix: extension ## run what needs Blender in 4.2, 4.3, 4.5, 5.0, 5.2, numpy 1 and 2: one table
	$(PYTHON_IN_VENV) tools/matrix.py $(ONLY)

# BLENDER=/path/to/blender: that one, with OpenGL and with Vulkan.
test-gpu: extension ## compare all sample scenes with what draws here, a graphics card or software: one table
	$(PYTHON_IN_VENV) tools/gpu.py $(if $(BLENDER),--blender "$(BLENDER)")

# What `make test` samples, at its full length.
torture: extension lesson-tools ## run the long tests, too long for every day: the suites at their full size
	@if tools/others.sh check; then tools/others.sh setup; fi
	$(PYTEST) -m torture

# OPTIONS=--quick: two minutes instead; or any other option of `reftrace bench`.
bench: extension ## measure speed beside embreex, Cycles and others, half an hour: out/bench
	$(PYTHON_IN_VENV) -m pip install --quiet --constraint constraints.txt --no-build-isolation \
		--editable '.[bench]'
	.venv/bin/reftrace bench --out out/bench $(OPTIONS)

# Pictures of the page need a browser, the tutorial's a real window, too; where there can be none,
# they stay as they are.
docs: extension demo ## refresh the documents: run their commands, compute their figures, draw
	@if ! reason=$$(tools/browser.sh check); then \
		echo "NOT TAKEN: pictures of the page, of Blender's window ($$reason)"; \
		$(PYTHON_IN_VENV) tools/make_docs.py --no-browser --no-window; \
	elif tools/browser.sh setup && ! reason=$$(tools/whole_blender.sh check); then \
		echo "NOT TAKEN: the tutorial's pictures of Blender's window ($$reason)"; \
		$(PYTHON_IN_VENV) tools/make_docs.py --no-window; \
	else \
		$(PYTHON_IN_VENV) tools/make_docs.py; \
	fi

# PYODIDE=folder: another distribution of Pyodide, unpacked, than the one that is fetched.
lessons: extension lesson-tools ## build the lesson pack, dist/lessons: needs npm, and Chromium, which root installs
	$(PYTHON_IN_VENV) tools/make_lessons.py $(if $(PYODIDE),--pyodide "$(PYODIDE)")

lesson-tools: .venv/.stamp
	tools/browser.sh setup
	$(PYTHON_IN_VENV) -m pip install --quiet --constraint constraints.txt --no-build-isolation \
		--editable '.[lessons]'

lint: style types ## check the style of all code, its format, and the types that it names

style: .venv/.stamp
	$(PYTHON_IN_VENV) -m ruff check .
	$(PYTHON_IN_VENV) -m ruff format --check .

types: .venv/.stamp
	$(PYTHON_IN_VENV) -m mypy

extension: .venv/.stamp ## build and validate dist/reference_tracer-<version>.zip
	$(PYTHON_IN_VENV) tools/build_extension.py

# ADDRESS=https://...: the project's address, in the place of the placeholder in its files.
release: .venv/.stamp ## write what a user downloads, of the last commit: dist/release
	$(PYTHON_IN_VENV) tools/release.py $(if $(ADDRESS),--address "$(ADDRESS)")

clean: ## remove what was built; keeps .venv and the whole Blender
	rm -rf build dist out wheels *.egg-info .pytest_cache .ruff_cache
	find addon packages tests tools sample_scenes -name __pycache__ -prune -exec rm -rf {} +

.venv/.stamp: pyproject.toml setup.py constraints.txt
	bash tools/venv.sh
