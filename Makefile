# What a newcomer needs is `make demo` and `make test`; `make help` lists the rest.
# Everything is installed into .venv, made by PYTHON (3.11 or newer).

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip install --quiet --disable-pip-version-check

.PHONY: help demo test lint types docs pictures bench dist clean

help: ## list the targets
	@grep -E '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 12

demo: $(VENV)/.installed ## make a world, let a robot map it, write pictures to demo/
	$(BIN)/topomap demo -o demo

test: $(VENV)/.developer ## the whole suite, on all cores
	$(BIN)/python -m pytest --numprocesses auto --quiet

lint: $(VENV)/.developer ## formatting and lint
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .

types: $(VENV)/.developer ## static types, strict
	$(BIN)/mypy

docs: $(VENV)/.developer ## the documentation, into site/
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --strict

pictures: $(VENV)/.developer ## draw the committed pictures anew; needs chromium
	$(BIN)/python docs/figures.py docs/pictures
	$(BIN)/python docs/screenshot.py docs/pictures

bench: $(VENV)/.developer ## benchmarks, as ratios to a named rival
	$(BIN)/python -m pytest -o addopts= --import-mode=importlib --benchmark-only tests/benchmarks

dist: $(VENV)/.developer ## wheel and sdist, checked, and the wheel tried in a bare environment
	rm -rf build dist
	$(BIN)/python -m build >dist.log || { cat dist.log; exit 1; }
	$(BIN)/twine check --strict dist/*
	$(BIN)/check-wheel-contents dist/*.whl
	bash tests/installed.sh dist/*.whl $(abspath $(BIN))/python
	rm -rf build dist.log

clean: ## remove all that these targets made, .venv too
	rm -rf $(VENV) demo site results build dist *.egg-info .benchmarks
	rm -rf .hypothesis .mypy_cache .pytest_cache .ruff_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# One stamp file for each thing installed, made anew when pyproject.toml changes.
$(BIN)/python:
	@$(PYTHON) -c 'import sys; sys.version_info >= (3, 11) or sys.exit("topomap needs Python 3.11 or newer, and $(PYTHON) is %d.%d: name another one, as in make PYTHON=python3.12" % sys.version_info[:2])'
	$(PYTHON) -m venv $(VENV)

$(VENV)/.installed: pyproject.toml | $(BIN)/python
	$(PIP) --editable .
	@touch $@

$(VENV)/.developer: pyproject.toml | $(BIN)/python
	$(PIP) --editable '.[dev,docs]'
	@touch $(VENV)/.installed $@
