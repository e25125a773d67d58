#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Help, usage errors and exit codes.
. "$(dirname "$0")/given.sh"

golden overview.txt --help
golden filter_help.txt filter --help
golden detect_help.txt detect --help
golden fit_help.txt fit --help
golden compare_help.txt compare --help
golden info_help.txt info -h
golden example_help.txt example --help
golden reproduce_help.txt reproduce --help
golden no_command.txt
golden bad_command.txt paint
golden bad_option.txt fit cloud.ply --colour red

expect 0 "crease " --version
expect 2 "wants a value" fit cloud.ply --seed
expect 2 "takes no value" fit cloud.ply --quiet=yes
expect 2 "whole number from 4 to 256" detect cloud.ply -K 3
expect 2 "whole number from 4 to 256" detect cloud.ply -K 16.5
expect 2 "number from 0 to 100" example panel --noise 101
expect 2 "number from 0 to 100" example panel --noise nan
expect 2 "number from 25 to 256" filter cloud.ply --window 24
expect 2 ".ply .pcd .xyz" filter cloud.ply -o out.step
expect 3 "cloud.ply" filter cloud.ply -o out.ply
expect 2 "no option" detect cloud.ply --tolerance 0.1
expect 2 "number from 0 to 1" detect cloud.ply --false-discovery-rate 1.1
expect 2 "bootstrap, jackknife, variation or gauss-map" detect cloud.ply --detector curvature
expect 2 "creases or score" detect cloud.ply --features none
expect 2 ".brep .ply .obj .csv" detect cloud.ply --creases out.xyz
expect 2 "6x6" fit cloud.ply --net 6
expect 2 "6x6" fit cloud.ply --net 3x6
expect 2 "automatic, part, shell, sheet or averaging" fit cloud.ply --method magic
expect 2 "nine numbers" fit cloud.ply --rotation 1,0,0,0,1,0,0,0
expect 2 "form a rotation" fit cloud.ply --rotation 1,0,0,0,1,0,0,0,2
expect 2 "0 to 18446744073709551615" fit cloud.ply --seed -1
expect 2 "one argument too many" detect a.ply b.ply
expect 2 "the file to read" detect
expect 2 ".ply .pcd .xyz" detect cloud.ply -o out.doc
expect 2 ".step" fit cloud.ply -o out.doc
expect 1 "the folder cannot be written" fit cloud.ply -o nowhere/out.step
expect 3 "cloud.ply" detect cloud.ply
expect 3 "cloud.ply" fit -- cloud.ply

check "the man page names every command" sh -c '"$0" --man | grep -q "SH CREASE fit"' "$crease"
if command -v mandoc >/dev/null; then
    check "the man page has no faults" sh -c '"$0" --man | mandoc -T lint -W warning' "$crease"
fi
for shell in bash zsh fish; do
    check "completion for $shell" sh -c '"$0" --completion "$1" | grep -q mark-threshold' "$crease" "$shell"
    if command -v "$shell" >/dev/null; then
        check "$shell accepts its completion" sh -c '"$0" --completion "$1" | "$1" -n' "$crease" "$shell"
    fi
done
expect 2 "bash, zsh or fish" --completion tcsh
# The page of the options is what the program says; tools/make-options-page renews it.
check "docs/options.md is the program's" sh -c "'$here/../../tools/make-options-page' '$crease' | cmp - '$here/../../docs/options.md'"
finish
