# The front door. Everything else is CMake: see CONTRIBUTING.md.

JOBS ?= $(shell nproc 2>/dev/null || echo 2)
PREFIX ?= /usr/local

.PHONY: build demo test install clean

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

install: build
	@cmake --install build

clean:
	rm -rf build demo
