# The front door. Everything else is CMake: see CONTRIBUTING.md.

JOBS ?= $(shell nproc 2>/dev/null || echo 2)
PREFIX ?= /usr/local
# The benchmarks need a Python with numpy and scipy.
PYTHON ?= $(shell for p in python3 /usr/bin/python3; do $$p -c 'import numpy, scipy' 2>/dev/null && echo $$p && break; done || echo python3)

.PHONY: build demo test bench bench-build bench-rivals bench-fits install uninstall dist deb sbom clean

build:
	@tools/install-dependencies build
	@cmake -S . -B build -DCREASE_TESTS=OFF -DCMAKE_INSTALL_PREFIX=$(PREFIX) >/dev/null
	@cmake --build build -j $(JOBS) -- --no-print-directory

demo: build
	@tools/demo build/crease demo

test:
	@tools/install-dependencies test
	@cmake -S . -B build -DCREASE_TESTS=ON >/dev/null
	@cmake --build build -j $(JOBS) -- --no-print-directory
	@cd build && ctest --output-on-failure -j $(JOBS)

# Ours and whatever of the others is installed, in one run: docs/benchmarks.md. BENCH=--full for larger clouds,
# BENCH=--keep to keep the result.
bench: bench-build
	@$(PYTHON) bench/all build-bench build-bench/results $(BENCH)

bench-build:
	@cmake -S . -B build-bench -DCREASE_BENCH=ON -DCREASE_TESTS=OFF >/dev/null
	@cmake --build build-bench -j $(JOBS) -- --no-print-directory

# Measures whatever of the others is installed; docs/rivals.md names the packages.
bench-rivals: bench-build
	@$(PYTHON) bench/rivals build-bench --json build-bench/rivals.json --table build-bench/rivals.md

bench-fits: bench-build
	@$(PYTHON) bench/fits build-bench --table build-bench/fits.md

install: build
	@cmake --install build

uninstall:
	@cmake --build build --target uninstall

# The source archive, the Debian packages and the bill of materials: docs/packaging.md.
dist:
	@tools/make-archive build

deb:
	@tools/install-dependencies deb
	@tools/make-deb build/deb

sbom: build
	@tools/make-sbom build/crease >build/crease.spdx.json
	@echo build/crease.spdx.json

clean:
	rm -rf build demo
