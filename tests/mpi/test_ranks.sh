#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Any number of ranks writes what one process writes.
. "$(dirname "$0")/given_ranks.sh"

expect 0 "" example bracket --count 1500 -o bracket.ply
expect 0 "" detect bracket.ply -o one.ply --creases one.csv -t 1
for n in 1 2 3 8; do
    expect_ranks "$n" 0 "wrote many.ply" detect bracket.ply -o many.ply --creases many.csv -t 1
    same "detect, $n ranks: points" one.ply many.ply
    same "detect, $n ranks: creases" one.csv many.csv
    rm -f many.ply many.csv
done

# other options travel with the request
expect 0 "" detect bracket.ply -o one.ply --features score -K 9 -B 31 -s 7 --sigma 0.05 -t 1
expect_ranks 3 0 "" detect bracket.ply -o many.ply --features score -K 9 -B 31 -s 7 --sigma 0.05 -t 2
same "options of the scores" one.ply many.ply

# a sheet of equal distances, where ties decide; a part; a cloud of hardly more points than ranks
expect 0 "" example cube -o cube.ply
expect 0 "" detect cube.ply -o one.ply -d jackknife -q
expect_ranks 4 0 "" detect cube.ply -o many.ply -d jackknife -q -t 1
same "equal distances" one.ply many.ply
if [ "$3" = CAD ]; then
    mkdir many one
    expect 0 "" fit cube.ply -o one/cube.step --points one/cube.ply -q
    expect_ranks 2 0 "" fit cube.ply -o many/cube.step --points many/cube.ply -q -t 1
    same "fit" one/cube.step many/cube.step
    same "fit: points" one/cube.ply many/cube.ply
fi
awk 'BEGIN { for (i = 0; i < 20; i++) print i, i * i % 7, i * i * i % 5 }' >few.xyz
expect 0 "" detect few.xyz -K 4 -o one.ply -q
expect_ranks 8 0 "" detect few.xyz -K 4 -o many.ply -q -t 1
same "few points on 8 ranks" one.ply many.ply

# what is wrong is said once, with the exit code of one process
expect_ranks 3 3 "there is no such file" detect none.ply -o many.ply
expect_ranks 3 2 "no option '--bogus'" detect --bogus
awk 'BEGIN { for (i = 0; i < 50; i++) print i, 0, 0 }' >line.xyz
rm -f many.ply
expect_ranks 3 3 "lie on a line" detect line.xyz -o many.ply
check "a failure is told once" test "$(printf %s "$printed" | grep -c 'lie on a line')" = 1
check "a failure leaves no file" test ! -e many.ply
finish
