# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Clouds: what goes in comes out, nothing is copied on the way out."""

import gc

import numpy as np
import pytest

import crease

XYZ = np.array([[0.0, 0.25, 1.5], [1, 2, 3], [-4, 5, -6]])


@pytest.mark.parametrize("extension", ["ply", "pcd", "xyz", "csv"])
def test_what_is_written_is_read_back(tmp_path, extension):
    path = tmp_path / f"cloud.{extension}"
    crease.write(path, XYZ, fields={"deviation": [0.5, 1.5, -2.5]})
    cloud = crease.read(path)
    assert np.array_equal(cloud.points, XYZ)
    assert np.array_equal(cloud.fields["deviation"], [0.5, 1.5, -2.5])


@pytest.mark.parametrize("dtype", ["int8", "uint8", "int16", "uint16", "int32", "uint32", "float32",
                                   "float64"])
def test_fields_keep_their_type(tmp_path, dtype):
    values = np.array([1, 2, 100], dtype=dtype)
    crease.write(tmp_path / "cloud.ply", XYZ, normals=XYZ / 10, fields={"value": values})
    cloud = crease.read(tmp_path / "cloud.ply")
    assert cloud.fields["value"].dtype == dtype
    assert np.array_equal(cloud.fields["value"], values)
    assert np.array_equal(cloud.normals, XYZ / 10)


@pytest.mark.parametrize("values, dtype", [([True, False, True], "uint8"),
                                           (np.array([1, -2, 3], "int64"), "int32"),
                                           (np.array([1, 2, 3], ">f4"), "float32")])
def test_fields_of_other_types_are_kept_where_nothing_is_lost(values, dtype):
    field = crease.Cloud(XYZ, fields={"value": values}).fields["value"]
    assert field.dtype == dtype and np.array_equal(field, values)


@pytest.mark.parametrize("values", [np.array([2**40, 1, 1]), ["a", "b", "c"], [1j, 0, 0], [1, 2]])
def test_fields_that_would_not_be_kept_are_refused(values):
    with pytest.raises(crease.UsageError, match="value"):
        crease.Cloud(XYZ, fields={"value": values})


def test_single_precision_is_written_as_such(tmp_path):
    for dtype in ("float32", "float64"):
        crease.write(tmp_path / f"{dtype}.ply", XYZ.astype(dtype))
    sizes = [(tmp_path / f"{dtype}.ply").read_bytes().count(b"property double")
             for dtype in ("float32", "float64")]
    assert sizes == [0, 3]


def test_arrays_outlive_the_cloud():
    cloud = crease.Cloud(XYZ, fields={"value": [1.0, 2.0, 3.0]})
    points, value = cloud.points, cloud.fields["value"][1:]
    del cloud
    gc.collect()
    noise = [crease.Cloud(np.full((3, 3), number)) for number in range(200)]
    assert np.array_equal(points, XYZ) and np.array_equal(value, [2.0, 3.0]) and noise


def test_arrays_are_not_copied_and_cannot_be_written_to():
    cloud = crease.Cloud(XYZ)
    assert np.shares_memory(cloud.points, cloud.points)
    assert np.shares_memory(np.asarray(cloud), cloud.points)
    with pytest.raises(ValueError, match="read-only"):
        cloud.points[0, 0] = 1


def test_the_cloud_does_not_see_later_changes_of_its_input():
    mine = XYZ.copy()
    cloud = crease.Cloud(mine)
    mine[:] = 0
    assert np.array_equal(cloud.points, XYZ)


@pytest.mark.parametrize("values", [XYZ.tolist(), XYZ.astype("float32"), XYZ[:, ::-1][:, ::-1],
                                    np.asfortranarray(XYZ), XYZ.astype(">f8")])
def test_every_layout_of_an_array_is_taken(values):
    assert np.array_equal(crease.Cloud(values).points, XYZ)


@pytest.mark.parametrize("values", [[1, 2, 3], [[1, 2]], "abc".split(), [[1, 2, 3j]], None, 5])
def test_what_is_no_cloud_is_refused(values):
    with pytest.raises(crease.UsageError, match="points"):
        crease.Cloud(values)


def test_fields_are_added_and_replaced():
    cloud = crease.Cloud(XYZ, fields={"a": [1, 2, 3]}).with_fields(a=[4.0, 5.0, 6.0], b=[7, 8, 9])
    assert list(cloud.fields) == ["a", "b"]
    assert np.array_equal(cloud.fields["a"], [4, 5, 6])


def test_invalid_points_are_left_out_on_demand_with_a_warning(tmp_path):
    (tmp_path / "holes.xyz").write_text("0 0 0\nnan 0 0\n1 1 1\n")
    with pytest.raises(crease.InputError, match="line 2"):
        crease.read(tmp_path / "holes.xyz")
    with pytest.warns(crease.InputWarning, match="1"):
        assert len(crease.read(tmp_path / "holes.xyz", skip_invalid=True)) == 2


def test_points_are_drawn_on_a_mesh_or_its_vertices_taken(tmp_path):
    mesh = tmp_path / "square.obj"
    mesh.write_text("v 0 0 5\nv 1 0 5\nv 1 1 5\nv 0 1 5\nf 1 2 3 4\n")
    assert len(crease.read(mesh, mesh_points=0)) == 4
    drawn = crease.read(mesh, mesh_points=500)
    assert 400 < len(drawn) < 600 and np.allclose(drawn.points[:, 2], 5, atol=1e-12)
    with pytest.warns(crease.InputWarning, match="4 vertices"):
        assert len(crease.read(mesh)) > 9000


def test_an_empty_cloud_is_a_cloud():
    cloud = crease.Cloud(np.empty((0, 3)), fields={"value": []})
    assert len(cloud) == 0 and cloud.points.shape == (0, 3) and len(cloud.fields["value"]) == 0
