# Everything a developer types. `make` lists the targets; the first one that needs the environment
# builds it in .venv from requirements.lock, with uv where it is installed and with pip elsewhere.
#
#   make test PYTEST_ARGS="-n 0 -x -k spring"     arguments for pytest
#   make test PYTHON=python3.13                   the interpreter to build .venv with
#   make test-newest SAMPLE=--sample              one file of tests a room
#   make test-slow SAMPLE=--sample                one of eight slow tests, others after each change
#   make lock LOCK_ARGS=--upgrade                 newer versions of everything

VENV := .venv
BIN := $(VENV)/bin
LOCK := requirements.lock
READY := $(VENV)/.ready

PYTHON ?=
SAMPLE ?=
PYTEST_ARGS ?= -n auto --maxprocesses 8 --dist loadfile
LOCK_ARGS ?=

RECENT := import sys; sys.exit(sys.version_info < (3, 11))
export NO_MKDOCS_2_WARNING := 1
unexport PYTHONDONTWRITEBYTECODE # each process would compile the sources and rewrite the tests anew, for ten seconds

UV := $(shell command -v uv 2>/dev/null)

.DELETE_ON_ERROR:
.PHONY: help qvm paper ship test test-slow test-newest test-lowest test-uv test-today test-machines \
	lint format types contracts docs wheel check ready lock lock-newest clean

help: ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## /\1	/p' $(MAKEFILE_LIST) | while IFS='	' read -r target what; do \
		printf '  make %-12s %s\n' "$$target" "$$what"; done

qvm: $(READY) ## the quarter vehicle: compile, simulate and train it in a minute or so
	$(BIN)/python -m examples.qvm

paper: $(READY) ## the quarter vehicle with the whole training of the paper
	$(BIN)/python -m examples.qvm --paper

ship: $(READY) ## the quarter vehicle, trained and written as FMU, C, ONNX, StableHLO and Modelica, run in other tools
	$(BIN)/python -m examples.qvm.ship

# Tests compile many small programs that run once: XLA's optimizations take longer than they save. It aborts at an option
# that it does not know, so the newest version gets those that all of them have. Trainings in LONG run long enough to gain.
QUICK := --xla_backend_optimization_level=0 --xla_llvm_disable_expensive_passes=true
QUICKER := $(QUICK) --xla_cpu_use_fusion_emitters=false --xla_cpu_parallel_codegen_split_count=1
LONG := tests/examples
test: export XLA_FLAGS ?= $(QUICKER)
test: $(READY) ## all tests but the slow ones
	$(BIN)/python -m pytest $(PYTEST_ARGS)

test-slow: $(READY) ## the slow tests, but that of the wheel, which `make wheel` runs
	XLA_FLAGS="$${XLA_FLAGS-$(QUICKER)}" $(BIN)/python -m pytest $(PYTEST_ARGS) $(SAMPLE) -m "slow and not machines" \
		$(LONG:%=--ignore=%) --ignore=tests/test_packaging.py
	$(BIN)/python -m pytest $(PYTEST_ARGS) $(SAMPLE) -m "slow and not machines" $(LONG)

# Separate environments, made by .ci/dependencies.py each time they are used.
test-newest test-uv test-today: export XLA_FLAGS ?= $(QUICK)
test-lowest: export XLA_FLAGS ?= $(QUICKER)
test-newest: $(READY) ## the tests with .ci/newest.lock, on the newest Python that is found
	$(BIN)/python .ci/dependencies.py newest $(SAMPLE)

test-lowest: $(READY) ## the tests with .ci/lowest.lock, the oldest that pyproject.toml admits, on Python 3.11
	$(BIN)/python .ci/dependencies.py lowest $(SAMPLE)

test-uv: $(READY) ## the README's examples by `uv run`, which reads no lock
	$(BIN)/python .ci/dependencies.py uv

test-today: $(READY) ## the tests with the newest dependencies of today: it shows what is to come and stops nothing
	$(BIN)/python .ci/dependencies.py today

test-machines: $(READY) ## trainings, pages and examples as other machines do them: MACHINES="seed-1 AVX2" for some
	$(BIN)/python .ci/machines.py $(MACHINES)
	XLA_FLAGS="$${XLA_FLAGS-$(QUICKER)}" $(BIN)/python -m pytest $(PYTEST_ARGS) -m machines --ignore=tests/examples

lint: $(READY) ## ruff: rules and format
	$(BIN)/python -m ruff check .
	$(BIN)/python -m ruff format --check .

format: $(READY) ## ruff: mend what can be mended
	$(BIN)/python -m ruff check --fix .
	$(BIN)/python -m ruff format .

types: $(READY) ## pyright: strict for the kernel
	$(BIN)/python -m pyright

contracts: $(READY) ## import-linter: which module may import which
	$(BIN)/lint-imports --no-logo

docs: $(READY) ## the documentation, into site/
	$(BIN)/python -m mkdocs build --strict --quiet

wheel: $(READY) ## sdist and wheel, into dist/, and a check of what they hold
	rm -rf build dist
	$(BIN)/python -m build --quiet --no-isolation
	$(BIN)/python -m zipfile --list dist/*.whl
	$(BIN)/python -m pytest tests/test_packaging.py -m "slow or not slow"

check: lint contracts types docs test test-slow ## everything but the wheel

ready: ## before you stop: .ci/run in a fresh clone of HEAD, with ../shared beside it
	@fresh=$$(mktemp -d) && trap 'rm -rf "$$fresh"' EXIT && \
	git clone --quiet --no-hardlinks . "$$fresh/acausal" && \
	if [ -d ../shared ]; then cp -R ../shared "$$fresh/shared"; fi && \
	git --no-pager log -1 --format='.ci/run of %h %s' && \
	env -u MAKEFLAGS -u MAKELEVEL "$$fresh/acausal/.ci/run"

lock: $(READY) ## requirements.lock from pyproject.toml
	$(BIN)/python -m uv pip compile pyproject.toml --quiet --output-file $(LOCK) \
		--extra dev --extra docs --extra bench \
		--universal --python-version 3.11 --fork-strategy fewest \
		--generate-hashes --no-header --no-emit-index-url $(LOCK_ARGS)

lock-newest: $(READY) ## .ci/newest.lock and .ci/lowest.lock: what CI tests beside requirements.lock
	$(BIN)/python .ci/dependencies.py lock

clean: ## everything that was built, except .venv
	rm -rf build dist site *.egg-info .pytest_cache .ruff_cache .import_linter_cache .hypothesis
	find . -path ./$(VENV) -prune -o -name __pycache__ -prune -exec rm -rf {} +

# A working .venv is kept and brought up to date; one that no longer runs is made anew.
$(READY): $(LOCK) pyproject.toml
	@set -eu; \
	if ! $(BIN)/python -c '$(RECENT)' 2>/dev/null; then \
		rm -rf $(VENV); \
		if [ -n "$(UV)" ]; then \
			"$(UV)" venv --quiet --python '$(or $(PYTHON),>=3.11)' $(VENV); \
		else \
			found=; \
			for python in $(or $(PYTHON),python3 python3.14 python3.13 python3.12 python3.11); do \
				if "$$python" -c '$(RECENT)' 2>/dev/null; then found=$$python; break; fi; \
			done; \
			if [ -z "$$found" ]; then \
				echo "acausal needs Python 3.11 or newer: install it, or name it (make PYTHON=/path/to/python3)." >&2; \
				exit 1; \
			fi; \
			if ! "$$found" -c 'import ensurepip, venv' 2>/dev/null; then \
				echo "$$found cannot make virtual environments: install its venv module (Debian: python3-venv)." >&2; \
				exit 1; \
			fi; \
			"$$found" -m venv $(VENV); \
		fi; \
	fi; \
	if [ -n "$(UV)" ]; then \
		"$(UV)" pip install --quiet --compile-bytecode --python $(BIN)/python --require-hashes -r $(LOCK); \
		"$(UV)" pip install --quiet --python $(BIN)/python --no-deps --no-build-isolation -e .; \
	else \
		$(BIN)/python -m pip --version >/dev/null 2>&1 || $(BIN)/python -m ensurepip >/dev/null; \
		$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r $(LOCK); \
		$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e .; \
	fi; \
	touch $(READY)
