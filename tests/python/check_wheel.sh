#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors
# usage: check_wheel.sh PYTHON SOURCE LIBRARY
# The package installs without network, and serves a script that knows nothing of the source tree.
# Skipped (77) unless pip, setuptools and wheel are there.
set -euo pipefail
python=$1 source=$2
export CREASE_LIBRARY=$3
"$python" -c 'import setuptools, wheel, pip' 2>/dev/null || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/source"
cp -r "$source"/{pyproject.toml,setup.py,VERSION,README.md,LICENSE,python} "$work/source"
"$python" -m pip install -q --disable-pip-version-check --no-build-isolation --no-deps --no-index \
    --target "$work/site" "$work/source"
cd "$work"
unset CREASE_LIBRARY
PYTHONPATH=$work/site "$python" - <<'PYTHON'
from pathlib import Path
import crease
assert Path(crease.__file__).parent.name == "crease" and "site" in crease.__file__
model = crease.fit(crease.example("sample").points)
assert [round(line.angle, 6) for line in model.creases] == [90.0]
model.write("part.obj")
assert Path("part.obj").stat().st_size > 100
assert "Tag: py3-none-" in next(Path("site").glob("crease-*/WHEEL")).read_text()
PYTHON
