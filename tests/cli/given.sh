# What every test of the program begins with. Usage in a test file:
#
#     . "$(dirname "$0")/given.sh"     # $1 is the program; the test runs in an empty folder
#     expect 2 "no such option" fit x --bogus
#     finish
#
# shellcheck shell=bash
set -u
case "$1" in /*) crease=$1 ;; *) crease=$PWD/$1 ;; esac
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0
checks=0

fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}

# expect CODE "part of what is printed, or nothing" ARGUMENTS...: runs the program.
expect() {
    local code=$1 part=$2 got
    shift 2
    checks=$((checks + 1))
    printed=$("$crease" "$@" 2>&1 </dev/null)
    got=$?
    [ "$got" = "$code" ] || fail "crease $*: exit $got instead of $code: $printed"
    case "$printed" in
    *"$part"*) ;;
    *) fail "crease $*: prints '$printed', which lacks '$part'" ;;
    esac
}

# check "what must hold" COMMAND...: the command must succeed.
check() {
    local what=$1
    shift
    checks=$((checks + 1))
    "$@" >check.log 2>&1 || fail "$what: $(tail -n 3 check.log)"
    rm -f check.log
}

# golden NAME ARGUMENTS...: what the program prints must be the text in golden/NAME. With
# CREASE_GOLDEN=write in the environment the text is written instead.
golden() {
    local file=$here/golden/$1
    shift
    checks=$((checks + 1))
    "$crease" "$@" >"$work/golden.out" 2>&1 </dev/null
    echo "exit $?" >>"$work/golden.out"
    if [ "${CREASE_GOLDEN-}" = write ]; then
        cp "$work/golden.out" "$file"
    elif ! diff -u "$file" "$work/golden.out"; then
        fail "crease $*: the output is not that of golden/$(basename "$file")"
    fi
    rm -f "$work/golden.out"
}

finish() {
    echo "$checks checks, $failures failed"
    [ "$failures" = 0 ]
    exit
}
