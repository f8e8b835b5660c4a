# make assess   the example inventory against recorded earthquakes; prints where the report is
# make test     the tests              make test-slow   the longer checks too
# make test-part  today's fortieth of the longer checks, or PART=K/N of them
# make lint     format, style, types   make bench       speed, beside other software
# make lock     renew the lock files   make clean       remove what make has made
# make wheel    a wheel with compiled code, for Linux on x86-64; make CODE=<that wheel> takes it here
# make app      a folder that runs without Python, for this platform
# make interop  exported files read by OpenQuake and pelicun
# make test-web the page in headless Chromium
# make docs     the site, in docs/_build/html, and every command of every page; DOCS_RUN=0: unrun
# make fuzz     COUNT (20,000) damaged files of every kind, and each command killed KILLS (3) times,
#               interrupted, beside a second writer, on a full disk and by a clock that jumps

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
INSTALL := $(BIN)/python scripts/install.py
OUT ?= out/assessment
ARGS ?=
LOCK := requirements.lock
TEST_LOCK := requirements-test.lock

COUNT ?= 20000
KILLS ?= 3
SEED ?= 0

PART ?= $$(date +%j)/40

# bytecode is kept, even where the environment says otherwise: a process compiles it for up to 4 s
export PYTHONDONTWRITEBYTECODE :=

.PHONY: assess docs fuzz test test-slow test-part test-web lint format bench interop wheel app lock clean

assess: $(VENV)/installed
	$(BIN)/shaketable assess $(ARGS) --out $(OUT) --overwrite

# a file stays in one worker, which makes its fixtures once
test: $(VENV)/tested
	$(BIN)/python -m pytest -n auto --dist loadfile -m "not slow and not web"

test-slow: $(VENV)/tested
	$(BIN)/python -m pytest -n auto -m "not web"

test-part: $(VENV)/tested
	$(BIN)/python -m pytest -n auto -m "slow and not web" --part $(PART)

test-web: $(VENV)/tested
	$(BIN)/python -m pytest -n auto -m web

fuzz: $(VENV)/tested
	$(BIN)/python -m tests.fuzz.run --count $(COUNT) --seed $(SEED)
	$(BIN)/python -m tests.fuzz.kills --count $(KILLS) --seed $(SEED)
	$(BIN)/python -m tests.fuzz.troubles --count $(KILLS) --seed $(SEED)

lint: $(VENV)/tested
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy

format: $(VENV)/tested
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

bench: $(VENV)/tested requirements-bench.lock
	$(INSTALL) requirements-bench.lock
	$(BIN)/python -m benchmarks
	$(BIN)/python -m benchmarks.shaking
	$(BIN)/python -m benchmarks.study
	$(BIN)/python -m benchmarks.solids
	$(BIN)/python -m benchmarks.moving_support
	$(BIN)/python -m benchmarks.risk
	$(BIN)/python -m benchmarks.inventory
	$(BIN)/python -m benchmarks.inventory --stub
	$(BIN)/python -m benchmarks.campaigns

interop: $(VENV)/tested
	$(BIN)/python -m benchmarks.interop

app: $(VENV)/installed
	$(BIN)/python -m scripts.build_app

# the environment keeps its pinned versions; the tools of the site come beside them
docs: $(VENV)/tested requirements-docs.lock
	$(INSTALL) requirements-docs.lock
	$(BIN)/python -m sphinx -q -W --keep-going -b html docs docs/_build/html
	test "$(DOCS_RUN)" = 0 || $(BIN)/python docs/run_pages.py

wheel: $(VENV)/installed
	$(BIN)/python -m scripts.compile_wheel

$(VENV)/installed: $(LOCK) pyproject.toml
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "shaketable needs Python 3.11 or newer: make PYTHON=python3.11")'
	$(PYTHON) -m venv $(VENV)
	$(INSTALL) $(LOCK)
	$(BIN)/python -m pip install --quiet --no-deps --no-build-isolation --editable .
	test -z "$(CODE)" || $(BIN)/python -m scripts.take_code $(CODE)
	touch $@

# the tools of the tests, the extras that only they need all of, and the studies with what these need
$(VENV)/tested: $(VENV)/installed $(TEST_LOCK) studies/pyproject.toml
	$(INSTALL) $(TEST_LOCK)
	$(BIN)/python -m pip install --quiet --no-deps --no-build-isolation --editable ./studies
	touch $@

LOCKING = $(BIN)/uv pip compile --quiet --universal --generate-hashes --python-version 3.11 \
	--no-emit-index-url --no-emit-find-links --custom-compile-command "make lock"

lock: $(VENV)/installed
	$(LOCKING) --extra web --extra docx --output-file $(LOCK) pyproject.toml requirements-build.in
	$(LOCKING) --extra test --extra lint --extra cluster --extra scenario --constraints $(LOCK) --output-file $(TEST_LOCK) pyproject.toml
	$(LOCKING) --extra bench --constraints $(TEST_LOCK) --output-file requirements-bench.lock pyproject.toml
	$(LOCKING) --extra docs --constraints $(TEST_LOCK) --output-file requirements-docs.lock pyproject.toml

clean:
	rm -rf $(VENV) out dist build docs/_build docs/gallery_of_examples docs/reference/api docs/reference/commands docs/reference/backreferences docs/library_page .pytest_cache .ruff_cache .mypy_cache .hypothesis
