#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# --memory: clouds larger than it, part by part; what each point's neighbours tell is the same bytes, and the limit is kept.
. "$(dirname "$0")/given.sh"

# columns.py FILE NAME...: the bytes of some columns of a binary PLY file
cat >columns.py <<'END'
import struct, sys
types = {"float": "f", "double": "d", "uchar": "B", "int": "i"}
with open(sys.argv[1], "rb") as file:
    form, names, count = "<", [], 0
    for line in iter(file.readline, b"end_header\n"):
        words = line.decode().split()
        count = int(words[2]) if words[0] == "element" else count
        if words[0] == "property":
            form += types[words[1]]
            names.append(words[2])
    rows = list(struct.iter_unpack(form, file.read()))
assert len(rows) == count, (len(rows), count)
for name in sys.argv[2:]:
    print([row[names.index(name)] for row in rows])
END
same_columns() { # FILE FILE NAME...
    local a=$1 b=$2
    shift 2
    cmp <(python3 columns.py "$a" "$@") <(python3 columns.py "$b" "$@")
}
leftovers() { find . -name '.*crease*' -o -name 'out*'; }

# --- a scan with outliers, larger than the limit: the same scores, nearly the same labels
expect 0 "40000 points" example bracket --count 40000 -o scan.ply
expect 0 "" detect scan.ply -d jackknife -o whole.ply --report whole.json -q
expect 0 "then labelled by them" detect scan.ply -d jackknife --memory 50M -o parts.ply --creases lines.ply --report parts.json
check "scores are the same bytes" same_columns whole.ply parts.ply x y z variance
check "in parts, within the limit, labelled as the whole" python3 -c '
import json, os
whole, parts = json.load(open("whole.json")), json.load(open("parts.json"))
assert parts["parts"] > 1 and 5000 < parts["sampled"] < 20000 and parts["cloud"]["points"] == 40000, parts["sampled"]
assert parts["peak_memory_mb"] * 1.048576 <= 50, parts["peak_memory_mb"]
assert abs(parts["features"] - whole["features"]) < 0.1 * whole["features"], parts["features"]
assert abs(parts["spacing"] - whole["spacing"]) < 0.03 * whole["spacing"], parts["spacing"]
count = sum(region["points"] for region in parts["regions"]["each"]) + parts["regions"]["outliers"]
assert count == 40000, count
assert parts["creases"] and os.path.getsize("lines.ply") > 1000'
expect 0 "score and feature are its own" detect scan.ply -d jackknife --features score --memory 50M -o parts.ply
expect 0 "" detect scan.ply -d jackknife --features score -o whole.ply -q
check "features by score are the same bytes" same_columns whole.ply parts.ply variance feature
check "nothing is left" test -z "$(leftovers)"

# --- a cloud that fits: the bytes of without the option
expect 0 "" example bracket --count 4000 -o small.ply
expect 0 "" detect small.ply -d jackknife -o whole.ply -q
expect 0 "" detect small.ply -d jackknife -o parts.ply --memory 4G
check "a cloud that fits gives the same bytes" cmp whole.ply parts.ply

# --- other fields, normals, points that are none, heaps of equal points, big-endian numbers, faces behind; LAS
python3 - <<'END'
import math, random, struct
random.seed(3)
rows = []
for i in range(29000):
    x, y = random.random(), random.random()
    rows.append((x, y, abs(x - 0.5) + random.gauss(0, 1e-3), 0.6, 0.0, 0.8, i % 200, i * 0.5))
rows += [(0.25, 0.25, 0.25, 1.0, 0.0, 0.0, 7, 1.5)] * 1000
rows[4321] = (math.nan,) + rows[4321][1:]
head = ("ply\nformat binary_%s_endian 1.0\ncomment rows\nelement vertex  30000 \n"
        "property double x\nproperty double y\nproperty double z\nproperty float nx\nproperty float ny\n"
        "property float nz\nproperty uchar red\nproperty double time\n"
        "element face 1\nproperty list uchar int vertex_index\nend_header\n")
for name, mark in (("little", "<"), ("big", ">")):
    with open(name + ".ply", "wb") as out:
        out.write((head % name).encode())
        for row in rows:
            out.write(struct.pack(mark + "3d3fBd", *row))
        out.write(struct.pack(mark + "B3i", 3, 0, 1, 2))
header = bytearray(375)
header[0:4], header[24], header[25], header[104] = b"LASF", 1, 4, 0
struct.pack_into("<HI", header, 94, 375, 375)
struct.pack_into("<HI", header, 105, 20, 30000)
struct.pack_into("<6d", header, 131, 1e-4, 1e-4, 1e-4, 0, 0, 0)
struct.pack_into("<Q", header, 247, 30000)
with open("scan.las", "wb") as out:
    out.write(header)
    for i, row in enumerate(rows):
        x, y, z = (int(1e4 * value) if math.isfinite(value) else 0 for value in row[:3])
        out.write(struct.pack("<3iHBBBBH", x, y, z, i % 500, 0, i % 32, 0, 0, 0))
END
for order in little big; do
    expect 0 "left out" detect $order.ply --skip-invalid -d jackknife -o whole.ply
    expect 0 "29999 points" detect $order.ply --skip-invalid -d jackknife -o parts.ply --memory 50M
    check "other columns and scores are the same, $order-endian" \
        same_columns whole.ply parts.ply x y z nx ny nz red time variance
done
expect 3 ": x of point 4322 is not a number" detect little.ply -o parts.ply --memory 50M
first=$("$crease" detect little.ply -o whole.ply -q 2>&1)
[ "$printed" = "$first" ] || fail "in parts the sentence is '$printed', whole '$first'"
expect 0 "" detect scan.las -d jackknife -o whole.ply -q
expect 0 "worked on in" detect scan.las -d jackknife -o parts.ply --memory 50M
check "LAS: scores are the same" same_columns whole.ply parts.ply x y z intensity classification variance

# --- rows of text
python3 - <<'END'
import random
random.seed(4)
rows = [(random.random(), random.random(), i % 256) for i in range(30000)]
rows = [(x, y, abs(x - 0.5) + random.gauss(0, 1e-3), red) for x, y, red in rows]
with open("scan.csv", "w") as out:
    print("# rows\nx,y,z,red", file=out)
    for row in rows:
        print("%.17g,%.17g,%.17g,%d" % row, file=out)
with open("text.ply", "w") as out:
    print("ply\nformat ascii 1.0\nelement vertex 30000\nproperty double x\nproperty double y\n"
          "property double z\nproperty uchar red\nend_header", file=out)
    for row in rows:
        print("%.17g %.17g %.17g %d" % row, file=out)
END
expect 0 "" detect scan.csv -d jackknife -o whole.ply -q
for file in scan.csv text.ply; do
    expect 0 "worked on in" detect $file -d jackknife -o parts.ply --memory 50M
    check "$file: columns and scores are the same" same_columns whole.ply parts.ply x y z red variance
done

# --- fit takes a sample
expect 0 "fitted to a sample of" fit scan.ply --method averaging --memory 50M -o net.json

# --- what cannot be
rm -f parts.ply
expect 2 "one PLY file alone" detect scan.ply --memory 50M -o parts.ply -o two.ply
expect 2 "one PLY file alone" detect scan.ply --memory 50M -o parts.ply -o page.html
expect 2 "name the PLY file" detect scan.ply --memory 50M --report r.json
expect 2 "end it in .ply" detect scan.ply --memory 50M -o parts.csv
expect 2 "at least 50M" detect scan.ply --memory 1M -o parts.ply
expect 2 "at least 50M" detect scan.ply --memory 5X -o parts.ply
expect 3 "no such file" detect none.ply --memory 50M -o parts.ply
python3 -c '
with open("scan.obj", "w") as out:
    for i in range(300000):
        print("v", i % 777, i // 777, "0", " " * 200, file=out)'
expect 1 "more than --memory allows" detect scan.obj --memory 50M -o parts.ply
head -c 100000 little.ply >short.ply
expect 3 "get the whole file" detect short.ply --memory 50M -o parts.ply
expect 1 "name another folder" detect scan.ply --memory 50M --scratch /no/such -o parts.ply
if [ "$(id -u)" != 0 ]; then
    mkdir locked && chmod 555 locked
    expect 1 "name another folder" detect scan.ply --memory 50M --scratch locked -o parts.ply
fi
check "a failure leaves no file" test ! -e parts.ply

# --- a full disk; ended midway: the old file stays, nothing is left of the scratch files
echo old >out.ply
(ulimit -f 800 && trap '' XFSZ && "$crease" detect scan.ply --memory 50M -q -o out.ply 2>full.log)
code=$?
[ $code = 1 ] || fail "a full disk gives exit $code instead of 1: $(cat full.log)"
check "a full disk is named" grep -q "scratch file" full.log
for signal in TERM KILL; do
    timeout -s $signal 1 "$crease" detect scan.ply --memory 50M -B 5000 -o out.ply >signal.log 2>&1
done
check "the old file stays" grep -q old out.ply
rm out.ply
check "nothing is left" test -z "$(leftovers)"
finish
