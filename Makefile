# make run   set up what is missing, then close the loop on a simulated strawberry
# make test  set up what is missing, then ruff, mypy and the tests
# make test-all  the same with the slow tests, those of the viewer (rerun, 500 MB), the docs, and the question
#                to pip's resolver whether all this can be installed beside lerobot
# make docs  the documentation as pages, build/site/index.html
# make test-lerobot  loads an exported data set with the real lerobot (gigabytes)
# make test-openpi  openpi's own client against our policy server
# make fuzz  every parser against mutated input: CASES=1000 PARSER=all SEED=0
# make weights  train all weights from nothing into weights/ and measure them; goes on if stopped.
#               PRECISION=no where the processor has no bf16
# Each step of the set-up leaves a stamp in .venv; a second run repeats nothing that is done.

PYTHON ?= $(shell command -v python3.11 || command -v python3)
BIN := .venv/bin
STAMPS := .venv/stamps
PIP := $(BIN)/python -m pip install --disable-pip-version-check --progress-bar off

# the processes that tests start share compiled modules
unexport PYTHONDONTWRITEBYTECODE
# tests run in a process for each core: more threads would wait for each other
test: export OPENBLAS_NUM_THREADS = 1

.PHONY: run test test-all docs test-lerobot test-openpi fuzz weights setup clean
.DELETE_ON_ERROR:

run: setup
	$(BIN)/tacgrasp run --task strawberry

test: setup
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/python -m pytest -n auto --dist loadfile

test-all: test $(STAMPS)/view
	$(BIN)/python -m pytest -m "slow and not hardware and not gpu"
	.venv/view/bin/python -m pytest -m "not hardware and not gpu" tests/tacgrasp/viewer
	scripts/resolve-beside-lerobot $(PYTHON) .venv/resolve
	$(MAKE) docs

docs: setup $(STAMPS)/docs
	$(BIN)/python scripts/command_pages.py docs/commands
	.venv/docs/bin/mkdocs build --strict --site-dir build/site

test-lerobot: setup $(STAMPS)/lerobot
	.venv/lerobot/bin/python tests/lerobot/check.py $(BIN)/python

# openpi's own client against our server, in an environment of its own: it needs numpy below 2
test-openpi: setup
	test -x .venv-openpi/bin/python || $(PYTHON) -m venv .venv-openpi
	.venv-openpi/bin/python -m pip install --quiet openpi-client==0.1.2 typing_extensions "numpy<2"
	$(BIN)/python -m pytest -s tests/tacgrasp/serving/test_openpi_client.py

CASES ?= 1000
PARSER ?= all
SEED ?= 0

fuzz: setup
	$(BIN)/python -m tests.fuzz --cases $(CASES) --parser $(PARSER) --seed $(SEED)

PRECISION ?= bf16

weights: setup
	$(BIN)/tacgrasp data generate --set full --out runs/full --seed 0
	$(BIN)/tacgrasp train clip --data runs/full --out runs/pretrained --steps 700 \
	    --precision $(PRECISION)
	$(BIN)/tacgrasp train cltp --data runs/full --out runs/pretrained --steps 8000 --coarse 0.1 \
	    --precision $(PRECISION)
	$(BIN)/tacgrasp train llm --data runs/full --methods runs/pretrained --out weights --coarse 0.1 \
	    --precision $(PRECISION)
	$(BIN)/tacgrasp eval --data runs/full --weights weights --card

setup: $(STAMPS)/app

# environments of their own, inside .venv: rerun sees the packages beside it, lerobot has its own torch
$(STAMPS)/view: $(STAMPS)/app requirements-view.lock
	scripts/make-venv $(PYTHON) .venv/view
	$(BIN)/python -c 'import sysconfig; print(sysconfig.get_paths()["purelib"])' \
	    > "$$(.venv/view/bin/python -c 'import sysconfig; print(sysconfig.get_paths()["purelib"])')/core.pth"
	.venv/view/bin/python -m pip install --quiet --disable-pip-version-check -r requirements-view.lock
	@touch $@

$(STAMPS)/docs: $(STAMPS)/venv requirements-docs.lock
	scripts/make-venv $(PYTHON) .venv/docs
	.venv/docs/bin/python -m pip install --quiet --disable-pip-version-check -r requirements-docs.lock
	@touch $@

$(STAMPS)/lerobot: $(STAMPS)/venv
	scripts/make-venv $(PYTHON) .venv/lerobot
	.venv/lerobot/bin/python -m pip install --quiet --disable-pip-version-check lerobot==0.4.4
	@touch $@

$(STAMPS)/app: $(STAMPS)/packages pyproject.toml
	$(PIP) --quiet --no-deps --no-build-isolation --editable .
	@touch $@

# torch alone first, exactly: whatever comes after has to fit it, not the other way round
$(STAMPS)/packages: $(STAMPS)/venv $(STAMPS)/system requirements.lock
	$(PIP) "$$(grep '^torch==' requirements.lock)"
	$(PIP) --requirement requirements.lock
	@touch $@

$(STAMPS)/venv:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "expected Python 3.11 or later, got $$($(PYTHON) --version); set PYTHON=..."; exit 1; }
	scripts/make-venv $(PYTHON) .venv
	@mkdir -p $(STAMPS) && touch $@

$(STAMPS)/system: $(STAMPS)/venv scripts/system-libraries
	scripts/system-libraries
	@touch $@

clean:
	rm -rf .venv
