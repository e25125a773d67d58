#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The paper's experiment, rebuilt.
. "$(dirname "$0")/given.sh"

expect 0 "study.md" reproduce -o paper --seeds 2
for figure in 1 2 3 4 5; do
    for extension in png svg; do
        check "figure $figure as $extension" test -s paper/figure_$figure.$extension
    done
done
expect 0 "6146 points" info paper/cube.ply
for sample in 17x3 3x17 17x3_roof 3x17_roof; do
    expect 0 "51 points" info paper/sample_$sample.ply
done
check "the study tells the paper's facts" python3 -c '
import json
study = json.load(open("paper/study.json"))
assert study["seeds"] == 2 and len(study["results"]) == 40
def row(method, sample, noise):
    return next(r for r in study["results"] if (r["method"], r["sample"], r["noise"]) == (method, sample, noise))
paper = row("averaging", "17 x 3, roof", 0)
assert paper["sharp"] == 1 and 1 < paper["crease"]["mean"] < 2.5, paper
assert row("averaging", "3 x 17, roof", 0)["sharp"] == 0
for noise in (0, 0.16, 0.32, 0.48, 0.64):
    ours = row("sheet", "17 x 3, roof", noise)
    assert ours["sharp"] == ours["runs"], ours
    assert ours["crease"]["mean"] < (0.3 if noise else 0.02), ours
    assert abs(ours["angle"]["mean"] - 90) < (3 if noise else 0.5), ours'
expect 0 "" reproduce -o again --seeds 2 --quiet --threads 1
check "a second run writes the same bytes" diff -r paper again
expect 2 "-o FOLDER" reproduce
expect 2 "reads nothing" reproduce cloud.ply -o paper
touch file
expect 1 "cannot be made" reproduce -o file/inside
finish
