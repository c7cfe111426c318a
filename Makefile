# `make serve` runs the service, `make test` the tests; `make` alone lists everything.

HOST ?= 127.0.0.1
PORT ?= 8000
MINUTES ?= 60
DATA ?= ../shared/data
CASES ?= 10000
RULE_SETS ?= mdvrptw,sdvrptw,pcvrptw,vrpmtw,ovrp,vrpb,vrpspd

BIN := .venv/bin
INSTALL := $(BIN)/python .ci/install.py
# On all cores, by `tests/conftest.py`; who is idle takes over what others have left. Threads of PyTorch's own would wait for
# each other in vain. Tests of the engine find CMake there.
PYTEST := PATH="$(CURDIR)/$(BIN):$$PATH" OMP_NUM_THREADS=1 $(BIN)/pytest --numprocesses auto --dist worksteal
# What users don't run; `.ci/run` does, and what is marked `thorough`.
STUDIES := tests/benchmarks tests/app/test_api_fuzz.py tests/test_contributing.py
URL := http://$(HOST):$(PORT)
# Modules are kept compiled whatever the environment says: each start loads hundreds of them.
export PYTHONDONTWRITEBYTECODE =

.DEFAULT_GOAL := help
.NOTPARALLEL:
.PHONY: help engine guide serve plan test test-quick test-studies prepared lint train bench bench-quick bench-rules latency study study-quick screenshots fuzz settings clean

help: ## List what can be made
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-11s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

engine: .venv/tools ## Compile what of the engine changed
	@$(BIN)/python engine/backend.py

guide: app/console/built_guide ## Build what changed of the guide, which the service shows at /guide

serve: .venv/serving engine guide ## Run the service (PORT=8000, HOST=127.0.0.1)
	@echo "Starting. Open $(URL) for the console, $(URL)/guide for help, $(URL)/docs for the API or, in another terminal and in this folder, run"
	@echo
	@echo "  curl -H 'Content-Type: application/json' --data-binary @examples/table1.json $(URL)/plan"
	@echo
	@exec $(BIN)/tandem serve --host $(HOST) --port $(PORT)

plan: .venv/serving engine ## Plan examples/table1.json, write plan.json and check it
	@$(BIN)/tandem plan examples/table1.json --output plan.json
	@$(BIN)/tandem check examples/table1.json plan.json
	@echo "The plan is in plan.json."

test: prepared .venv/testing engine guide ## Install what the tests need and run most of them
	$(PYTEST) -m "not thorough" $(STUDIES:%=--ignore=%)

test-studies: prepared .venv/testing engine guide ## Run the rest of them: rare views, variants, benchmarks, generated requests
	$(PYTEST) -m thorough $(STUDIES:%=--ignore=%)
	$(PYTEST) $(STUDIES)

test-quick: .venv/testing engine guide ## Run many tests in under a minute, without browser, database and services
	$(PYTEST) -m "not slow and not thorough"

prepared:
	@.ci/prepare

lint: .venv/linting engine ## Check style and types
	$(BIN)/ruff check
	$(BIN)/mypy
	.ci/lint-engine
	.ci/lint-console

train: .venv/testing engine ## Train a policy in runs/attention, from where it stopped (MINUTES=60)
	OMP_NUM_THREADS=1 $(BIN)/python -m training.train --folder runs/attention --policy attention \
		--baseline shared --sizes 0 20 500 50 7000 100 --size-mix 1.0 --num-rollouts 16 \
		--learning-rate 0.0005 --minutes $(MINUTES)

bench: .venv/benching engine ## Run other solvers and Tandem side by side (DATA=../shared/data; hours)
	$(BIN)/python -m benchmarks.peers.versus --data $(DATA) --output runs/bench/versus.csv
	$(BIN)/python -m benchmarks.quality.drones --data $(DATA) --output runs/bench/drones.csv
	$(BIN)/python -m benchmarks.peers.report --results runs/bench/versus.csv

bench-quick: .venv/benching engine ## The same on a few instances, in five minutes
	$(BIN)/python -m benchmarks.peers.versus --data $(DATA) --quick --output runs/bench/quick.csv
	$(BIN)/python -m benchmarks.peers.report --results runs/bench/quick.csv --output runs/bench/quick.md

bench-rules: .venv/benching engine ## Tandem and PyVRP where instances have rules that few solvers know
	$(BIN)/python -m benchmarks.peers.rule_sets --data $(DATA)
	$(BIN)/python -m benchmarks.peers.versus --data $(DATA) --sets $(RULE_SETS) --solvers tandem,pyvrp \
		--output runs/bench/rule-sets.csv
	$(BIN)/python -m benchmarks.peers.report --results runs/bench/rule-sets.csv --part rule-sets

latency: .venv/benching engine ## Measure how long plans take, phase by phase
	$(BIN)/python -m benchmarks.speed.latency

study: .venv/serving engine ## Make the paper's study again, docs/develop/study.md (20 minutes on 2 cores)
	$(BIN)/python -m benchmarks.study

study-quick: .venv/serving engine ## The same with few cases, build/study.md
	$(BIN)/python -m benchmarks.study --quick

screenshots: .venv/testing engine ## Make the pictures of the console in docs/screenshots, with Chromium
	$(BIN)/python -m tests.console.screenshots

fuzz: .venv/testing engine ## Send generated requests to the whole API (CASES=10000), wild problems, all seeds of random tests
	$(BIN)/python -m benchmarks.fuzz.api --cases $(CASES)
	$(BIN)/python -m benchmarks.fuzz.problems
	$(BIN)/python -m benchmarks.fuzz.mixed --problems 1000
	$(BIN)/python -m benchmarks.fuzz.crowds --problems 500
	$(BIN)/python -m benchmarks.fuzz.vroom
	$(BIN)/python -m benchmarks.fuzz.remedies
	$(BIN)/python -m benchmarks.fuzz.replans
	$(BIN)/python -m benchmarks.fuzz.flights
	$(BIN)/python -m benchmarks.load.leavers
	EVERY_SEED=1 $(PYTEST) $$(grep -rlE 'tests.(seeds|model.search.optima) import' tests)

settings: .venv/serving engine ## Write docs/operate/settings.md
	$(BIN)/tandem settings > docs/operate/settings.md

clean: ## Remove caches, compiled code and plan.json; keep .venv and training runs
	rm -rf build dist *.egg-info model/engine/libtandem.* app/console/built_guide plan.json .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find app model training benchmarks examples tests -name __pycache__ -prune -exec rm -rf {} +

app/console/built_guide: zensical.toml $(shell find docs) | .venv/guiding
	@$(BIN)/python engine/backend.py guide
	@touch $@

.venv/serving: pyproject.toml .venv/tools
	@echo "Installing Tandem into .venv."
	@$(INSTALL) --no-build-isolation --editable .
	@touch $@

# What is no Python for this version stays as it is.
.venv/testing: pyproject.toml .venv/tools
	@echo "Installing Tandem and all that its tests need into .venv; PyTorch is large."
	@$(INSTALL) --no-build-isolation --editable '.[test,train]'
	@$(BIN)/python -m compileall -qq -j 0 .venv/lib || true
	@$(BIN)/python -m tests.app.maps.roads.wheels
	@touch $@ .venv/serving

.venv/linting: pyproject.toml .venv/testing
	@echo "Installing what checks style and types into .venv."
	@$(INSTALL) --no-build-isolation --editable '.[lint]'
	@touch $@ .venv/serving .venv/testing

.venv/benching: pyproject.toml .venv/tools
	@echo "Installing Tandem and its benchmarks into .venv."
	@$(INSTALL) --no-build-isolation --editable '.[bench]'
	@touch $@ .venv/serving

.venv/guiding: engine/backend.py | .venv/tools
	@$(INSTALL) $$($(BIN)/python engine/backend.py guidance)
	@touch $@

# What is installed once builds faster than what is got anew for each build.
.venv/tools: pyproject.toml engine/backend.py | .venv/created
	@.ci/compiler
	@$(INSTALL) $$($(BIN)/python engine/backend.py requires)
	@touch $@

.venv/created:
	@python=$$(.ci/find-python) && "$$python" -m venv .venv
	@touch $@
