# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors
"""usage: 02_part.py PART.step

Turns the simulated scan of a bracket into a solid, and says which faces the points lie on worst.
"""
import sys

import crease

part = crease.fit(crease.example("bracket"), method="part")
print(part)
for face in sorted(part.faces, key=lambda face: -face.deviation.rms)[:3]:
    print(f"{face.points} points, rms {face.deviation.rms:.3g}")
part.write(sys.argv[1])
