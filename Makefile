.PHONY: build test
build:
	cmake -S . -B build -DCMAKE_BUILD_TYPE=Release
	cmake --build build -j 2
test: build
	cd build && ctest --output-on-failure
