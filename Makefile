# The front door. Everything else is CMake: see CONTRIBUTING.md.

JOBS ?= $(shell nproc 2>/dev/null || echo 2)
PREFIX ?= /usr/local

.PHONY: build demo test bench-rivals bench-fits install uninstall dist deb sbom clean

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

# Measures whatever of the others is installed; docs/rivals.md names the packages.
bench-rivals:
	@cmake -S . -B build-bench -DCREASE_BENCH=ON -DCREASE_TESTS=OFF >/dev/null
	@cmake --build build-bench -j $(JOBS) -- --no-print-directory
	@bench/rivals build-bench --json build-bench/rivals.json --table build-bench/rivals.md

bench-fits:
	@cmake -S . -B build-bench -DCREASE_BENCH=ON -DCREASE_TESTS=OFF >/dev/null
	@cmake --build build-bench -j $(JOBS) -- --no-print-directory
	@bench/fits build-bench --table build-bench/fits.md

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
