#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Tells whether the committed page was built from the sources beside it, without node: the page says
the hash of what it was built from. check_bundle.py VIEWER (the folder viewer/)."""

import hashlib
import os
import re
import sys


def sources(viewer):
    names = ["build.mjs", "package-lock.json"]
    names += [f"src/{name}" for name in sorted(os.listdir(os.path.join(viewer, "src")))]
    digest = hashlib.sha256()
    for name in names:
        with open(os.path.join(viewer, name), "rb") as file:
            content = file.read()
        digest.update(f"{name} {len(content)}\n".encode() + content)
    return digest.hexdigest()


def main(viewer):
    with open(os.path.join(viewer, "dist", "viewer.html"), encoding="utf-8") as file:
        found = re.search(r'<meta name="crease-source" content="([0-9a-f]{64})">', file.read())
    if not found or found.group(1) != sources(viewer):
        print("viewer/dist/viewer.html is not built from viewer/src: run `npm run build` in viewer/ and commit it")
        return 1
    print("ok: the page is the one built from its sources")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
