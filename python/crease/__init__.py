# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Point clouds in, bicubic B-spline surfaces and CAD models out, sharp edges kept sharp.

    import crease
    model = crease.fit("scan.ply")
    model.write("part.step")
"""

from ._cloud import Cloud, read, write
from ._compare import ComparedFace, Comparison, compare
from ._detect import Corner, Crease, Detection, Region, Snap, detect
from ._deviation import Deviation
from ._errors import Error, Failure, InputError, InputWarning, UsageError
from ._example import example
from ._filter import Filtered, filter
from ._fit import fit
from ._library import HAS_CAD, LIBRARY as _LIBRARY
from ._part import Edge, Face, Part
from ._sheet import Line, Sheet
from ._spline import Curve, Mesh, Surface

__version__: str = _LIBRARY.crease_version().decode()

__all__ = [
    "Cloud", "ComparedFace", "Comparison", "Corner", "Crease", "Curve", "Detection", "Deviation",
    "Edge", "Error", "Face", "Failure", "Filtered", "HAS_CAD", "InputError", "InputWarning", "Line",
    "Mesh", "Part", "Region", "Sheet", "Snap", "Surface", "UsageError", "compare", "detect",
    "example", "filter", "fit", "read", "write",
]
