#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The main job: detect, fit, info on the example clouds.
. "$(dirname "$0")/given.sh"

expect 0 "6146 points" example cube -o cube.ply
expect 0 "51 points" example sample -o sample.ply
expect 0 "3000 points" example panel --count 3000 -o panel.ply
expect 2 "no example" example teapot -o teapot.ply
expect 2 "takes neither" example cube --noise 1 -o cube2.ply

# --- a mesh
printf 'OFF\n8 6 0\n%s\n' "0 0 0
3 0 0
3 2 0
0 2 0
0 0 1
3 0 1
3 2 1
0 2 1
4 0 3 2 1
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7" >box.off
expect 0 "8 vertices alone do not tell its shape" fit box.off -o box.step
expect 0 "area 22, volume 6" info box.step
expect 0 "box.off: 8 points" info box.off --mesh-points 0
expect 0 "12 triangles" detect box.off -o box.ply
sed '$s/7$/8/' box.off >wrong.off
expect 3 "wrong.off: a face has vertex 8, counted from 0, of 8" info wrong.off

# --- filter
golden filter_panel.txt filter panel.ply -o filtered.ply -o filtered.csv -o filtered.png \
    -o filtered.html --report filtered.json
expect 0 "field outlier: 0 to 1" info filtered.ply
expect 0 "left out" filter panel.ply --remove-outliers -o rest.ply -o rest.svg --report rest.json
expect 0 "moved by 0 (rms)" filter panel.ply --passes 0 -o still.ply
expect 0 "noise 0.01 before" filter panel.ply --sigma 0.01 -o known.ply
check "outliers are marked or left out, and counted" python3 -c '
import json
count = json.load(open("filtered.json"))["outliers"]
rows = open("filtered.csv").read().split("\n")[1:]
assert sum(int(float(r.split(",")[-1])) for r in rows if r) == count > 0
rest = json.load(open("rest.json"))
assert rest["outliers"] == count and 0 < rest["noise_after"] < 0.5 * rest["noise_before"], rest'
expect 0 "$((3000 - $(grep -c ',1$' filtered.csv))) points" info rest.ply
expect 0 "11, left out" filter panel.ply --remove-outliers --passes 0 -o clean.ply
expect 0 "creases: 1," detect clean.ply -o clean_edges.ply

# --- detect
golden detect_cube.txt detect cube.ply -o edge.ply -o edge.csv -o edge.png -o edge.html \
    --creases edges.ply --report edge.json
golden detect_panel.txt detect panel.ply --creases panel.csv
expect 0 "field feature: 0 to 1" info edge.ply
expect 0 "field region: 0 to 5" info edge.ply
check "every point comes back in its order" python3 -c '
rows = [line.split(",") for line in open("edge.csv").read().split("\n")[1:] if line]
assert len(rows) == 6146
for r in rows:
    x, y, z, feature = float(r[0]), float(r[1]), float(r[2]), int(float(r[-2]))
    on = sum(min(v, 1 - v) < 1e-9 for v in (x, y, z)) >= 2
    far = sum(min(v, 1 - v) < 0.1 for v in (x, y, z)) == 1
    assert not on or feature == 1, r
    assert not far or feature == 0, r'
check "the report tells the twelve edges of the cube" python3 -c '
import json
r = json.load(open("edge.json"))
assert r["regions"]["count"] == r["regions"]["planes"] == 6 and r["regions"]["outliers"] == 0
assert len(r["creases"]) == 12 and len(r["corners"]) == 8
for c in r["creases"]:
    assert abs(c["angle"] - 90) < 0.01 and abs(c["length"] - 1) < 0.001 and not c["closed"], c
    assert 0 < c["position_error"] < 0.01 and 0 < c["angle_error"] < 1, c
    assert all(0 <= k < 8 for k in c["corners"]), c
for c in r["corners"]:
    assert c["valence"] == 3 and all(min(abs(v), abs(v - 1)) < 0.001 for v in c["position"]), c
assert abs(r["spacing"] * 32 - 1) < 0.05 and {"scores", "regions", "creases"} <= set(r["seconds"])'
check "the creases share their corners" python3 -c '
data = open("edges.ply", "rb").read()
head, body = data.split(b"end_header\n", 1)
count = {w[1]: int(w[2]) for w in (l.split() for l in head.decode().split("\n")) if w[:1] == ["element"]}
import struct
edges = struct.unpack_from("<%dI" % (2 * count["edge"]), body, 28 * count["vertex"])
degrees = [edges.count(v) for v in range(count["vertex"])]
assert degrees.count(3) == 8 and set(degrees) <= {2, 3}, degrees'

# --- creases as the curves that they are: edges that share their corners, except in IGES
for file in c.step c.stp c.brep; do
    expect 0 "wrote $file" detect cube.ply --creases $file
    expect 0 "edges: 12, vertices: 8" info $file
    expect 0 "12 on no face" info $file
done
expect 0 "wrote c.igs" detect cube.ply --creases c.igs
expect 0 "edges: 12, vertices: 24" info c.igs
expect 0 "no crease to write: none.step" detect panel.ply --sigma 0.2 --creases none.step
check "a file without creases is not written" test ! -e none.step
expect 0 "600 points" example panel --count 600 -o few.ply
expect 0 "wrote l.step" fit few.ply --creases l.step
expect 0 "edges: 1, vertices: 2" info l.step

# --- a cloud beside a model
expect 0 "faces: 2" fit sample.ply -o roof.step --points roof.csv
expect 0 "2 faces, 0 of them without a point" compare roof.step roof.csv -o dev.ply -o dev.png -o dev.html \
    --report dev.json
check "points on the model have no deviation, and every face has its own" python3 -c '
import json
r = json.load(open("dev.json"))
assert r["deviation"]["max"] < 1e-6, r["deviation"]
assert len(r["faces"]) == 2 and sum(f["points"] for f in r["faces"]) == 51
assert all(f["points"] > 15 and f["area"] > 0 for f in r["faces"])'
expect 0 "field deviation" info dev.ply
expect 0 "field face: 0 to 1" info dev.ply
for file in dev.png dev.html; do check "$file is there" test -s $file; done
expect 2 "the CAD model, then the cloud" compare roof.step
expect 3 "no such file" compare none.step roof.csv
expect 3 "this is no CAD file" compare roof.csv roof.csv
expect 2 "one argument too many" compare roof.step roof.csv roof.csv
expect 2 "one argument too many" info roof.step roof.csv

# --- other detectors, and features by score
for detector in jackknife variation gauss-map; do
    expect 0 "creases: 1," detect panel.ply --detector $detector -o $detector.ply
    expect 0 "features by their score" detect cube.ply --detector $detector --features score -o $detector.csv
    check "$detector: the cube's edges are features, the faces' middles are not" python3 -c '
import sys
rows = [line.split(",") for line in open(sys.argv[1]).read().split("\n")[1:] if line]
for r in rows:
    x, y, z, feature = float(r[0]), float(r[1]), float(r[2]), int(float(r[-2]))
    away = sorted(min(v, 1 - v) for v in (x, y, z))
    assert away[1] > 1e-9 or away[2] < 0.1 or feature == 1, r
    assert away[1] < 0.1 or feature == 0, r' $detector.csv
done
check "creases do not depend on the detector" sh -c '
    "$0" detect panel.ply -q -d variation --creases a.csv && "$0" detect panel.ply -q --creases b.csv && cmp a.csv b.csv' "$crease"

# --- a known noise is taken as it is: with a large one the panel's edge drowns
expect 0 "noise 0.008" detect panel.ply --sigma 0.008 -o known.ply
case "$printed" in *"creases: 1,"*) ;; *) fail "with the noise that it has the crease is lost: $printed" ;; esac
expect 0 "creases: none" detect panel.ply --sigma 0.2 -o none.ply -o none.png -o none.html
expect 2 "number from 0" detect panel.ply --sigma -1 -o known.ply

# --- fit, sheet
expect 0 "faces: 2, creases: 1" fit sample.ply -o s.step -o s.igs -o s.brep -o s.obj -o s.stl -o s.ply \
    -o s.glb -o s.png -o s.svg -o s.pdf -o s.html --creases s_creases.ply --points s_on.ply --report s.json
for file in s.step s.igs s.brep; do
    expect 0 "2 B-spline" info $file
    expect 0 ", valid" info $file
    expect 0 "1 sharp" info $file
done
expect 0 "51 points" info s_on.ply
check "the report is whole" python3 -c '
import json
r = json.load(open("s.json"))
assert r["program"] == "crease" and r["cloud"]["points"] == 51 and r["face_count"] == 2
assert abs(r["creases"][0]["angle"] - 90) < 0.5, r["creases"]
assert r["deviation"]["rms"] < 1e-3 / 32
assert r["options"]["seed"] == "1" and r["method"] == "sheet" and r["options"]["method"] == "automatic"
u = r["surface"]["u"]["knots"]
assert max(u.count(k) for k in u[4:-4]) == 3, u
assert r["seconds"]["total"] > 0'

expect 0 "creases: 0" fit sample.ply --most-creases 0 -o smooth.png -o smooth.html
expect 0 "no room for a crease" fit sample.ply --net 6x6 -o small.step
expect 0 "creases: 1" fit sample.ply --net 7x4 -o small.step

# --- fit, sheet: it ends where the points do
awk 'BEGIN { for (i = 0; i <= 40; i++) for (j = 0; j <= 20; j++) { x = i / 20; y = j / 20
    if ((x - 1.5) ^ 2 + (y - 0.5) ^ 2 > 0.06) print x, y, x < 1 ? x - 1 : 1 - x } }' >holed.xyz
expect 0 "holes inside faces: 1" fit holed.xyz --method sheet -o t.step -o t.igs -o t.obj -o t.png -o t.html --report t.json
expect 0 "faces: 2, edges: 8, vertices: 7" info t.step
expect 0 "7 free, 1 sharp" info t.step
expect 0 ", valid" info t.igs
check "the report has the sheet and its loops in u and v" python3 -c '
import json
r = json.load(open("t.json"))
assert r["face_count"] == len(r["trim"]["faces"]) == 2 and len(r["trim"]["edges"]) == 8
used = [abs(e) for f in r["trim"]["faces"] for l in f["loops"] for e in l]
assert sorted(used) == sorted(list(range(1, 9)) + [e for e in used if used.count(e) == 2][:1]), used
for face in r["trim"]["faces"]:
    for loop in face["loops"]:
        ends = [r["trim"]["edges"][abs(e) - 1]["control_points"][::1 if e > 0 else -1] for e in loop]
        for i, points in enumerate(ends):
            assert max(abs(a - b) for a, b in zip(points[-1], ends[(i + 1) % len(ends)][0])) < 1e-9, loop'
expect 0 "faces: 2, creases: 1" fit holed.xyz --method sheet --no-trim -o t.step --report t.json
expect 0 "faces: 2, edges: 7, vertices: 6" info t.step
check "nothing was cut off" python3 -c '
import json
assert "trim" not in json.load(open("t.json"))'

# --- fit, part: what lies over itself is closed to a solid
expect 0 "a closed, valid solid, volume 1" fit cube.ply -o p.step -o p.igs -o p.brep -o p.obj -o p.stl -o p.ply \
    -o p.glb -o p.png -o p.svg -o p.html --creases p_creases.ply --points p_on.ply --report p.json
for file in p.obj p.stl p.ply p.glb p.png p.svg p.html p_creases.ply; do
    check "$file is there" test -s $file
done
for file in p.step p.brep; do
    expect 0 "solids: 1, shells: 1 (1 closed), faces: 6, edges: 12, vertices: 8" info $file
    expect 0 "0 free, 12 sharp" info $file
    expect 0 "volume 1," info $file
done
expect 0 "faces: 6" info p.igs
check "the report tells six planes and twelve right angles" python3 -c '
import json
r = json.load(open("p.json"))
assert r["method"] == "part" and r["part"]["state"] == "solid" and abs(r["part"]["volume"] - 1) < 1e-6
assert len(r["faces"]) == 6 and len(r["edges"]) == 12
for f in r["faces"]:
    assert f["type"] == "plane" and abs(f["area"] - 1) < 1e-6 and f["points"] > 900 and f["max"] < 1e-6, f
    assert len(f["normal"]) == len(f["place"]) == 3
    assert 0 < f["place_error"] < 0.01 and 0 < f["normal_error"] < 1, f
for e in r["edges"]:
    assert abs(e["length"] - 1) < 1e-6 and abs(e["angle"] - 90) < 1e-4 and not e["smooth"], e
assert {"regions", "creases", "part", "write"} <= set(r["seconds"])'
expect 0 "field deviation: " info p_on.ply
expect 0 "field face: 0 to 5" info p_on.ply
expect 0 "faces: 6" fit cube.ply --faces bspline -o pb.step
expect 0 "6 B-spline, 0 plane, 0 other" info pb.step
expect 0 "solids: 1," info pb.step
expect 0 "lie one over another, and the sheet passes between them: take --method part" \
    fit cube.ply --method sheet -o forced.step
expect 2 "analytic or bspline" fit cube.ply --faces round
expect 0 "noise 0.003" fit cube.ply --sigma 0.003 -o known.step
expect 0 "3 parallel, 3 perpendicular, 0 coaxial, 0 equal radii" fit cube.ply -o sn.step --report sn.json
expect 0 "closed, valid solid" fit cube.ply --no-snap -o sf.step --report sf.json
check "the report lists what was snapped, by region" python3 -c '
import json
on, off = json.load(open("sn.json")), json.load(open("sf.json"))
assert off["snapped"] == []
kinds = [s["to"] for s in on["snapped"]]
assert kinds == ["parallel"] * 3 + ["perpendicular"] * 3, kinds
assert sorted(r for s in on["snapped"][:3] for r in s["regions"]) == list(range(6))'
expect 0 "30000 points" example bracket -o bracket.ply
expect 0 "11 faces: 8 planes, 3 cylinders" fit bracket.ply -o bracket.step
expect 0 "solids: 1, shells: 1 (1 closed), faces: 11" info bracket.step
expect 0 "11 faces, 0 of them without a point" compare bracket.step bracket.ply
# a sparse scan: a way of building that fills the large hole must not win (volume 73 700 then)
expect 0 "8000 points" example bracket --count 8000 -o sparse.ply
expect 0 "a closed, valid solid, volume 67" fit sparse.ply -o sparse.step

# --- fit, shell: what ends at a border stays open
awk 'BEGIN { srand(5); for (face = 0; face < 3; face++) for (i = 0; i < 900; i++) {
    a = (i % 30 + rand()) / 30; b = (int(i / 30) + rand()) / 30
    print face == 0 ? 0 : a, face == 1 ? 0 : face == 0 ? a : b, face == 2 ? 0 : b } }' >corner.xyz
expect 0 "an open shell of 3 faces with 6 free edges" fit corner.xyz --method shell -o corner.step \
    --creases corner_creases.csv --points corner_on.ply --report corner.json -o corner.obj -o corner.html
expect 0 "solids: 0, shells: 1 (0 closed), faces: 3" info corner.step
expect 0 "field face: 0 to 2" info corner_on.ply
check "the report tells three sharp edges and six free ones" python3 -c '
import json
r = json.load(open("corner.json"))
assert r["method"] == "shell" and r["part"]["state"] == "shell"
free = [e for e in r["edges"] if len(e["faces"]) == 1]
assert len(free) == 6 and len(r["edges"]) == 9
assert all(abs(e["angle"] - 90) < 1e-4 for e in r["edges"] if e not in free)
assert abs(sum(f["area"] for f in r["faces"]) - 3) < 0.06'
expect 0 "faces: 3" fit corner.xyz --method shell --faces bspline -o corner.brep
expect 0 "3 B-spline, 0 plane" info corner.brep

# what is asked for as a part and ends at a border says why it is none
awk 'BEGIN { srand(7); for (i = 0; i < 4000; i++) { a = 4.7 * rand(); print cos(a), sin(a), rand() } }' >arc.xyz
expect 0 "points
an open shell of 1 face with 4 free edges, no solid: 1 of 1 face has no closed border
1 face: 1 cylinder; 4 edges, 0 of them sharp" fit arc.xyz --method part -o arc.step

# --- fit, the paper's algorithm: rows 3 and 4 are repeated, a flat-topped ridge
expect 0 "control points" fit sample.ply --method averaging -o a.step --report a.json
check "the paper repeats two rows of its net" python3 -c '
import json
r = json.load(open("a.json"))
net = r["surface"]["control_points"]
assert sorted((len(net), len(net[0]))) == [6, 10], (len(net), len(net[0]))'
expect 0 ", valid" info a.step
expect 0 "6 x 6" fit sample.ply --method averaging --row-threshold 6 -o b.step
expect 0 "8 x 8" fit sample.ply --method averaging --net 8x8 --row-threshold 8 -o b.step

# --- the same bytes for any number of threads, and for a second run
for threads in 1 2 4; do
    mkdir $threads
    expect 0 "" detect panel.ply -q -t $threads -o $threads/d.ply
    expect 0 "" filter panel.ply -q -t $threads -o $threads/c.ply
    expect 0 "" fit few.ply -q -t $threads -o $threads/f.step -o $threads/f.obj -o $threads/f.html -o $threads/f.png
done
for file in c.ply d.ply f.step f.obj f.html f.png; do
    check "$file is the same for 1 and 2 threads" cmp 1/$file 2/$file
    check "$file is the same for 1 and 4 threads" cmp 1/$file 4/$file
done
check "another seed draws other resamples" sh -c '! cmp -s 1/d.ply other.ply'

# --- numbers are read and written with a point, whatever the locale
check "a locale with commas changes nothing" sh -c '
    LC_ALL=de_DE.UTF-8 "$0" fit sample.ply -q -o de.obj && "$0" fit sample.ply -q -o c.obj && cmp de.obj c.obj' "$crease"
expect 0 "" fit sample.ply --quiet -o q.step
[ -z "$printed" ] || fail "--quiet prints $printed"
finish
