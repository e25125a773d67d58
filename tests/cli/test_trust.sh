#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Bad input, signals, full disks: one clear sentence, the right exit code, nothing half written.
. "$(dirname "$0")/given.sh"

expect 0 "6146 points" example cube -o cube.ply
leftovers() { find . -name '.*.tmp' -o -name 'out*'; }
nothing_left() { [ -z "$(leftovers)" ]; }

# --- input that is no good: exit 3, the file's name, nothing written
head -c 5000 cube.ply >short.ply
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n1 0 nan\n0 1 0\n' >nan.ply
printf '1 2 3\n4 5\n' >ragged.xyz
printf '0 0 0\n1 1 1\n2 2 2\n3 3 3\n4 4 4\n5 5 5\n6 6 6\n7 7 7\n8 8 8\n9 9 9\n' >line.xyz
for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do echo 1 2 3; done >same.xyz
printf '0 0 0\n1 0 0\n0 1 0\n' >three.xyz
: >empty.xyz
printf '\211PNG\r\n\032\n' >picture.ply
head -c 3000 /dev/urandom >noise.ply
mkdir folder.ply
for file in short.ply nan.ply ragged.xyz empty.xyz picture.ply noise.ply folder.ply absent.ply; do
    for command in detect fit; do
        expect 3 "$file" $command $file -o out.ply
        check "$command $file leaves nothing" nothing_left
    done
    expect 3 "$file" info $file
done
for file in line.xyz same.xyz three.xyz; do
    expect 3 "points" detect $file -o out.ply
    expect 3 "points" fit $file -o out.step
    check "$file leaves nothing" nothing_left
done
expect 0 "2 points" info nan.ply --skip-invalid
expect 3 "line 2" info ragged.xyz

# --- standard input
check "a cloud from a pipe" sh -c '"$0" info - <cube.ply | grep -q "6146 points"' "$crease"

# --- output that cannot be written: exit 1, the old file stays
echo old >out.ply
if [ "$(id -u)" != 0 ]; then
    mkdir locked && chmod 555 locked
    expect 1 "locked" detect cube.ply -o locked/out.ply
fi
(ulimit -f 8 && trap '' XFSZ && "$crease" detect cube.ply -q -o out.ply 2>full.log)
code=$?
[ $code = 1 ] || fail "a full disk gives exit $code instead of 1: $(cat full.log)"
check "a full disk is named" grep -q out.ply full.log
check "a full disk leaves the old file" grep -q old out.ply
check "a full disk leaves no part" sh -c '[ -z "$(find . -name ".*.tmp")" ]'
rm -f out.ply

# --- signals: ended by the signal, nothing half written
expect 0 "" example panel --count 300000 -q -o panel.ply
for signal in INT TERM; do
    for delay in 0.02 0.3 0.8; do
        timeout -s $signal $delay "$crease" detect panel.ply -B 2000 -o out.ply >signal.log 2>&1
        code=$?
        [ $code = 124 ] || fail "SIG$signal after $delay s: exit $code: $(cat signal.log)"
        check "SIG$signal leaves nothing" nothing_left
    done
done

# --- a reader that goes away
check "a closed pipe is no crash" sh -c '"$0" info cube.ply --json | head -c 1 >/dev/null' "$crease"

# --- reports also when it fails
"$crease" detect nan.ply -o out.ply --json >failed.json 2>/dev/null
check "a failure is in the JSON report" python3 -c '
import json
error = json.load(open("failed.json"))["error"]
assert error["kind"] == "input" and "nan.ply" in error["sentence"], error'
finish
