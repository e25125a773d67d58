#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every rank reads its own share of a file larger than --memory: the same files for any number of them.
. "$(dirname "$0")/given_ranks.sh"

# expect_same N "what" ARGUMENTS...: what $one has been compared with.
expect_same() {
    local n=$1 what=$2
    shift 2
    rm -f many.ply many.csv
    expect_ranks "$n" 0 "wrote many.ply" detect "$@" -o many.ply --creases many.csv -t 1
    same "$what, $n ranks: points" one.ply many.ply
    same "$what, $n ranks: creases" one.csv many.csv
}

expect 0 "" example bracket --count 40000 -o bracket.ply
expect 0 "" detect bracket.ply -o one.ply --creases one.csv --memory 60M -t 1
expect_same 1 "a bracket" bracket.ply --memory 60M
for n in 2 3 5 8; do
    expect_same "$n" "a bracket" bracket.ply --memory 60M
    check "every rank but 0 has a share" grep -q "worked on in $((n - 1)) parts" <<<"$printed"
done

# sums over all points are whole numbers: the report is the same, too
expect 0 "" detect bracket.ply -o one.ply --memory 60M -t 1 --json
printf '%s' "$printed" | grep '"rms"\|"chi"\|"points"' >one.says
expect_ranks 4 0 "" detect bracket.ply -o many.ply --memory 60M -t 1 --json
printf '%s' "$printed" | grep '"rms"\|"chi"\|"points"' >many.says
check "the report tells of regions" test -s one.says
same "the report" one.says many.says

# features by score are held against scores around them, those of others among these
expect 0 "" detect bracket.ply -o one.ply --creases one.csv --memory 60M --features score -K 9 -d jackknife -s 7
expect_same 4 "scores" bracket.ply --memory 60M --features score -K 9 -d jackknife -s 7

# points that are left out have no number
python3 - bracket.ply invalid.ply <<'END'
import struct, sys
bytes_ = bytearray(open(sys.argv[1], "rb").read())
first = bytes_.index(b"end_header\n") + 11
size = (len(bytes_) - first) // 40000
for row in (0, 1, 13333, 13334, 26666, 39999):
    bytes_[first + size * row:first + size * row + 8] = struct.pack("<d", float("nan"))
open(sys.argv[2], "wb").write(bytes_)
END
expect 0 "" detect invalid.ply -o one.ply --creases one.csv --memory 60M --skip-invalid
expect_same 4 "points left out" invalid.ply --memory 60M --skip-invalid
expect 3 "" detect invalid.ply -o none.ply --memory 60M
one=$(printf '%s' "$printed" | grep '^crease: ')
expect_ranks 4 3 "$one" detect invalid.ply -o none.ply --memory 60M
check "an error leaves no file" test ! -e none.ply
check "it is told once" test "$(printf '%s' "$printed" | grep -c 'point 1')" = 1

# what cannot be written is said by rank 0, and the others end
expect_ranks 4 1 "cannot be written" detect bracket.ply -o nowhere/none.ply --memory 60M

# a sheet: the normal equations have one order
expect 0 "" example panel --count 60000 -o panel.ply
expect 0 "" fit panel.ply --net 20x24 --memory 60M -t 1 -o one.stl --report one.json
for n in 2 3 8; do
    rm -f many.stl
    expect_ranks "$n" 0 "wrote many.stl" fit panel.ply --net 20x24 --memory 60M -t 1 -o many.stl --report many.json
    same "a sheet, $n ranks" one.stl many.stl
    grep '"rms"\|"p95"\|"max"\|"mean"' one.json >one.says
    grep '"rms"\|"p95"\|"max"\|"mean"' many.json >many.says
    check "the report tells of deviations" test -s one.says
    same "its report, $n ranks" one.says many.says
done

# a rank that does not see the file
if unshare -m true 2>/dev/null; then
    mkdir seen
    cp bracket.ply seen
    cat >blind <<END
#!/bin/sh
[ "\$OMPI_COMM_WORLD_RANK" = 2 ] && exec unshare -m sh -c 'mount -t tmpfs none $PWD/seen && exec "\$0" "\$@"' "$mpi" "\$@"
exec "$mpi" "\$@"
END
    chmod +x blind
    mpi=$PWD/blind expect_ranks 3 3 "rank 2, which reads a share of the file itself" detect seen/bracket.ply -o none.ply --memory 60M
    check "an unseen file leaves none" test ! -e none.ply
    cp panel.ply seen
    mpi=$PWD/blind expect_ranks 3 3 "rank 2, which reads a share of the file itself" fit seen/panel.ply --net 20x24 --memory 60M -o none.stl
    check "nor has a sheet one" test ! -e none.stl
fi
finish
