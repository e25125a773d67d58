# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Properties that hold for any cloud."""

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as make
from hypothesis.extra import numpy as arrays

import crease

SMALL = settings(max_examples=12, deadline=None, derandomize=True,
                 suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture])
COORDINATES = make.floats(-1e6, 1e6, allow_subnormal=False)
CLOUDS = arrays.arrays(np.float64, make.tuples(make.integers(0, 40), make.just(3)),
                       elements=COORDINATES)
ANYTHING = arrays.arrays(np.float64, make.tuples(make.integers(0, 12), make.just(3)),
                         elements=make.floats())


@SMALL
@given(cloud=CLOUDS, extension=make.sampled_from(["ply", "pcd", "xyz", "csv"]))
def test_clouds_survive_files_to_the_bit(tmp_path, cloud, extension):
    path = tmp_path / f"cloud.{extension}"
    crease.write(path, cloud)
    if len(cloud):
        assert crease.read(path).points.tobytes() == cloud.tobytes()


@SMALL
@given(cloud=CLOUDS)
def test_a_small_cloud_is_worked_on_or_refused_with_a_sentence(cloud):
    for work in (lambda: crease.detect(cloud, resamples=4, neighbours=4, threads=1),
                 lambda: crease.filter(cloud, threads=1),
                 lambda: crease.fit(cloud, method="sheet", threads=1)):
        try:
            assert repr(work()).startswith("<crease.")
        except (crease.InputError, crease.Failure) as refusal:
            assert str(refusal)


@SMALL
@given(cloud=ANYTHING)
def test_points_that_are_no_numbers_never_get_in(cloud):
    try:
        assert np.isfinite(crease.Cloud(cloud).points).all()
    except crease.InputError as refusal:
        assert refusal.status == "VALUE" and not (np.abs(cloud) < 1e150).all()


@SMALL
@given(shift=make.tuples(*[make.floats(-100, 100)] * 3), seed=make.integers(0, 2**32 - 1))
def test_an_exact_roof_is_met_wherever_it_stands(shift, seed):
    points = np.random.default_rng(seed).uniform(-1, 1, (120, 3)) * [1, 1, 0]
    points[:, 2] = -np.abs(points[:, 0])
    points = np.round(points * 2**20) / 2**20
    moved = np.round(np.array(shift) * 2**10) / 2**10
    here, there = (crease.fit(cloud, method="sheet", threads=1) for cloud in (points, points + moved))
    assert np.abs(here.deviations).max() < 1e-6 and np.abs(there.deviations).max() < 1e-6
