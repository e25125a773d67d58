# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors
"""usage: 01_creases.py CLOUD

Finds the sharp edges of a cloud and prints them, the longest first.
"""
import sys

import crease

found = crease.detect(sys.argv[1])
print(found)
for edge in sorted(found.creases, key=lambda edge: -edge.length):
    a, b = edge.regions
    print(f"{found.regions[a].type} {a} and {found.regions[b].type} {b}: {edge.length:.4g} long, "
          f"{edge.angle:.1f} degrees")
