# Two commands on a fresh Debian with git, make, a C++ compiler and Python: `make demo`, `make test`.
# Both install what is missing, build once, and do nothing again that is already done.

PYTHON ?= python3
FILE   ?= demo:hair
OUT    ?= out/demo.png
# The wheel, the module and the C++ tests come out of this one build.
BUILD  := build/python
VENV   := .venv

export CMAKE_BUILD_PARALLEL_LEVEL ?= $(shell nproc 2>/dev/null || echo 2)
export CTEST_PARALLEL_LEVEL ?= $(CMAKE_BUILD_PARALLEL_LEVEL)

# Whatever a build reads. Folders too: their time moves when a file goes.
SOURCES := $(shell find CMakeLists.txt pyproject.toml cmake cpp python tests/cpp -name __pycache__ -prune -o -print)

.PHONY: help demo test setup packages lint clean
.DELETE_ON_ERROR:

help:
	@echo "make demo [FILE=path]  render a generated head of hair, or FILE, to $(OUT) and print the pass report"
	@echo "make test              run the C++ tests, then the Python tests"
	@echo "make setup             build and install into $(VENV), no more"
	@echo "make lint              every check of .pre-commit-config.yaml on every file"
	@echo "make clean             remove what was built ($(VENV) stays)"

demo: setup
	@mkdir -p $(dir $(OUT))
	$(VENV)/bin/pyopacity render "$(FILE)" -o "$(OUT)" --print-report

test: setup
	ctest --test-dir $(BUILD) --output-on-failure --no-tests=error
	$(VENV)/bin/python -m pytest -n $(CTEST_PARALLEL_LEVEL)

setup: $(BUILD)/.installed

lint: setup
	$(VENV)/bin/pre-commit run --all-files

clean:
	rm -rf build out

# Asks dpkg only; installs only what is missing. Order-only below: it runs each time, and makes nothing out of date.
packages:
	@scripts/install-packages

$(VENV)/.ready: pyproject.toml scripts/requirements.py | packages
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	    echo "$(PYTHON) is not Python 3.11 or newer." >&2; \
	    echo "  fix: install one, and name it: make PYTHON=python3.11" >&2; exit 1; }
	$(PYTHON) -m venv $(VENV)
	$(VENV)/bin/python scripts/requirements.py > $(VENV)/requirements.txt
	$(VENV)/bin/pip install --quiet --requirement $(VENV)/requirements.txt
	@touch $@

# No isolation: the build tools lie in $(VENV), at a path that stays, so that the next build is incremental.
$(BUILD)/.installed: $(VENV)/.ready $(SOURCES) | packages
	$(VENV)/bin/pip install --no-build-isolation . \
	    --config-settings=build-dir=$(BUILD) \
	    --config-settings=cmake.define.OPACITY_BUILD_TESTS=ON
	@touch $@
