#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# --resume: what finished stages found is kept, and taken by the next run, with the same result.
. "$(dirname "$0")/given.sh"

expect 0 "" example bracket --count 3000 -o bracket.ply
expect 0 "" detect bracket.ply -o plain.ply -q
expect 0 "" detect bracket.ply -o first.ply --resume kept
check "a run that keeps its stages gives the same bytes" cmp plain.ply first.ply
check "every stage is there, and nothing else" test "$(echo kept/*)" = "kept/scores.stage kept/surroundings.stage"
expect 0 "scores: taken from kept/scores.stage" detect bracket.ply -o again.ply --resume kept
expect 0 "surroundings: taken from kept/surroundings.stage" detect bracket.ply -o again.ply --resume kept
check "a run that takes them gives the same bytes" cmp plain.ply again.ply

# stages of other points and other options are not taken, damaged ones neither
expect 0 "" detect bracket.ply -o seed.ply --seed 2 -q
expect 0 "surroundings: taken" detect bracket.ply -o again.ply --seed 2 --resume kept
check "another seed has other scores" cmp seed.ply again.ply
expect 0 "" example bracket --count 3000 --noise 0.1 -o other.ply
expect 0 "" detect other.ply -o plain_other.ply -q
expect 0 "wrote again.ply" detect other.ply -o again.ply --resume kept
case "$printed" in *taken*) fail "stages of another cloud were taken" ;; esac
check "another cloud has its own result" cmp plain_other.ply again.ply
for stage in scores surroundings; do
    python3 - kept/$stage.stage <<'END'
import sys
data = bytearray(open(sys.argv[1], "rb").read())
data[len(data) // 2] ^= 1
open(sys.argv[1], "wb").write(data)
END
done
expect 0 "wrote again.ply" detect other.ply -o again.ply --resume kept
case "$printed" in *taken*) fail "a damaged stage was taken" ;; esac
check "damaged stages are found anew" cmp plain_other.ply again.ply
truncate -s 100 kept/scores.stage
expect 0 "surroundings: taken" detect other.ply -o again.ply --resume kept
check "so are stages cut short" cmp plain_other.ply again.ply

# folders that cannot be
echo text >file
expect 1 "is no folder; name a folder" detect other.ply -o again.ply --resume file
expect 1 "cannot be made; name a folder" detect other.ply -o again.ply --resume no/such/folder
finish
