# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Clouds whose truth is known."""

import numpy as np
import pytest

import crease

ANGLE = 110.0  # of the roof, in degrees


def roof(count=1500, noise=0.0, seed=7):
    """Two planes that meet along the y axis at ANGLE, as random points; z is up."""
    random = np.random.default_rng(seed)
    x, y = random.uniform(-1, 1, count), random.uniform(-0.8, 0.8, count)
    slope = 1 / np.tan(np.radians(ANGLE / 2))
    return np.column_stack([x, y, -slope * np.abs(x) + noise * random.standard_normal(count)])


@pytest.fixture(scope="session")
def cube():
    return crease.example("cube")


@pytest.fixture(scope="session")
def points():
    return roof()


@pytest.fixture(scope="session")
def sheet(points):
    return crease.fit(points, method="sheet")


@pytest.fixture(scope="session")
def detection(cube):
    return crease.detect(cube, resamples=8)


@pytest.fixture(scope="session")
def part(cube):
    if not crease.HAS_CAD:
        pytest.skip("built without OpenCASCADE")
    return crease.fit(cube, method="part")
