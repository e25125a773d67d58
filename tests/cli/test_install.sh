#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What `make install` puts in place serves a program that knows nothing of the source tree.
. "$(dirname "$0")/given.sh"
build=$2

check "it installs" cmake --install "$build" --prefix "$work/usr"
check "the program runs" "$work/usr/bin/crease" --version
check "the manual page is there" test -s "$work/usr/share/man/man1/crease.1"
export PKG_CONFIG_PATH=$(dirname "$(find "$work/usr" -name crease.pc)")
lib=$(dirname "$PKG_CONFIG_PATH")
root=$(cd "$here/../.." && pwd)
export LD_LIBRARY_PATH=$lib

# The examples are what a project of a user's own would be.
for static in OFF ON; do
    check "CMake finds it, static: $static" cmake -S "$root/examples/c" -B "cmake-$static" \
        -DCMAKE_PREFIX_PATH="$work/usr" -DSTATIC=$static
    check "the examples build, static: $static" cmake --build "cmake-$static" -j 2
    check "a sheet, static: $static" sh -c "cmake-$static/02_sheet s.step | grep '2 faces, 1 crease of 109.47 degrees'"
done
check "the static one needs no libcrease.so" sh -c '! ldd cmake-ON/02_sheet | grep libcrease'
check "the shared one does" sh -c 'ldd cmake-OFF/02_sheet | grep libcrease.so'
# shellcheck disable=SC2046
check "a program builds by pkg-config" cc "$root/examples/c/04_splines.c" -o shared $(pkg-config --cflags --libs crease)
check "and runs" sh -c './shared m.glb | grep "1.000000 above the edge"'
mkdir static && cp "$lib/libcrease.a" static
# shellcheck disable=SC2046
check "and with the static library" cc "$root/examples/c/04_splines.c" -o alone -Lstatic $(pkg-config --cflags --libs --static crease)
check "and runs" sh -c './alone m.glb | grep "multiplicity 3"'

check "a cloud to try" "$work/usr/bin/crease" example bracket --count 8000 -o bracket.ply
check "creases" cmake-OFF/01_creases bracket.ply creases.csv
check "are written" grep -q region_1 creases.csv
check "a part" sh -c 'cmake-OFF/03_part bracket.ply part.step | grep "closed solid"'
check "is written" test -s part.step
check "what is not there is said" sh -c 'cmake-OFF/01_creases none.ply c.csv 2>&1 | grep "no such file"'
if /usr/bin/python3 -c 'import numpy' 2>/dev/null && [ -e "$lib/libcrease.so" ]; then
    export PYTHONPATH=$root/python CREASE_LIBRARY=$lib/libcrease.so PYTHONDONTWRITEBYTECODE=1
    check "creases from Python" sh -c "/usr/bin/python3 '$root/examples/python/01_creases.py' bracket.ply | grep 'plane 0 and plane'"
    check "a part from Python" sh -c "/usr/bin/python3 '$root/examples/python/02_part.py' python.step | grep 'Part: solid'"
fi

# Only what the headers declare is visible.
nm -D --defined-only "$lib/libcrease.so" | awk '$2 != "A" { sub("@.*", "", $3); print $3 }' | sort >exported
grep -v '^crease_' exported >strange
check "nothing else is exported: $(head -n 3 strange)" test ! -s strange
check "the interface is" grep -qx crease_network_find exported
check "the soname has the version" sh -c "objdump -p '$lib/libcrease.so' | grep -q 'SONAME *libcrease.so.0.1\$'"

check "it goes away" cmake --build "$build" --target uninstall
check "and leaves nothing" sh -c "! find '$work/usr' -type f -o -type l | grep ."
finish
