#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What a packager gets: a source archive that is always the same bytes, and a bill of materials.
. "$(dirname "$0")/given.sh"
root=$(cd "$here/../.." && pwd)

if git -C "$root" rev-parse HEAD >/dev/null 2>&1; then
    check "an archive" "$root/tools/make-archive" one
    sleep 1
    check "and another" env TZ=Asia/Tokyo "$root/tools/make-archive" two
    check "are the same bytes" cmp one/crease-*.tar.gz two/crease-*.tar.gz
    check "it has one folder" sh -c '[ "$(tar -tzf one/*.tar.gz | cut -d/ -f1 | sort -u | wc -l)" = 1 ]'
    check "it holds the build" sh -c 'tar -tzf one/*.tar.gz | grep -q "/CMakeLists.txt$"'
fi

check "a bill of materials" sh -c "'$root/tools/make-sbom' '$crease' >bill.json"
check "once more" sh -c "'$root/tools/make-sbom' '$crease' >again.json"
check "is the same" cmp bill.json again.json
cat >look.py <<'P'
import hashlib, json, sys
bill = json.load(open("bill.json"))
names = {package["name"] for package in bill["packages"]}
assert {"crease", "three"} <= names, names
ids = [package["SPDXID"] for package in bill["packages"]]
assert len(set(ids)) == len(ids)
for link in bill["relationships"]:
    assert link["relatedSpdxElement"] in ids
own = bill["packages"][0]
assert own["checksums"][0]["checksumValue"] == hashlib.sha256(open(sys.argv[1], "rb").read()).hexdigest()
assert all(package["versionInfo"] for package in bill["packages"])
P
check "it is complete" python3 look.py "$crease"
check "a file that is not there is said" sh -c "! '$root/tools/make-sbom' none 2>said && grep -q 'no such file' said"
finish
