# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""What the stages find, against what is known of the clouds."""

import gc

import numpy as np
import pytest

import crease
from conftest import ANGLE, roof


def test_the_cube_has_six_planes_twelve_creases_and_eight_corners(detection):
    assert [region.type for region in detection.regions] == ["plane"] * 6
    assert len(detection.creases) == 12 and len(detection.corners) == 8
    assert all(abs(crease_.angle - 90) < 1e-6 for crease_ in detection.creases)
    assert all(corner.valence == 3 for corner in detection.corners)


def test_features_are_the_points_on_the_edges_of_the_cube(detection, cube):
    on_faces = np.isclose(cube.points, 0) | np.isclose(cube.points, 1)
    assert detection.feature.dtype == bool
    assert detection.feature[on_faces.sum(axis=1) >= 2].all()
    assert detection.cloud.fields["region"].dtype == np.int32
    assert list(detection.cloud.fields) == ["variance", "feature", "region"]


def test_features_may_come_from_the_score(cube):
    found = crease.detect(cube, features="score", detector="jackknife", neighbours=12)
    assert 0 < found.feature.sum() < len(cube) and found.variance.max() > 0.1


def test_the_sheet_finds_the_crease_of_the_roof(sheet, points):
    assert len(sheet.faces) == 2 and len(sheet.creases) == 1
    line = sheet.creases[0]
    assert line.angle == pytest.approx(ANGLE, abs=1e-6)
    assert np.abs(line.curve.sample(20)[:, [0, 2]]).max() < 1e-9
    assert sheet.deviation.rms < 1e-9 and len(sheet.deviations) == len(points)
    assert np.allclose(sheet.projected, points, atol=1e-9)


def area(mesh):
    a, b, c = (mesh.vertices[mesh.triangles[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def test_a_sheet_ends_where_the_points_do_unless_told_not_to(tmp_path):
    x, y = (axis.ravel() for axis in np.meshgrid(np.linspace(0, 2, 41), np.linspace(0, 1, 21)))
    beside = np.hypot(x - 1.5, y - 0.5) > 0.25
    points = np.column_stack([x, y, -np.abs(x - 1)])[beside]
    sheet = crease.fit(points, method="sheet")
    assert sorted(len(loops) for loops in sheet.loops) == [1, 2]
    middle = [face for face in sheet.loops if len(face) == 2][0][1][0].sample(5)
    assert np.ptp(middle[:, 0]) > 0.1 and not middle[:, 2].any()
    whole = crease.fit(points, method="sheet", no_trim=True)
    assert whole.loops is None
    assert area(whole.mesh) == pytest.approx(8 ** 0.5, rel=1e-6)
    assert area(sheet.mesh) == pytest.approx(area(whole.mesh) - 2 ** 0.5 * np.pi / 16, rel=0.02)
    assert len(sheet.faces) == 2 and np.array_equal(sheet.surface.control_points,
                                                    whole.surface.control_points)
    for name in ("sheet.step", "sheet.obj", "sheet.png", "sheet.html"):
        sheet.write(tmp_path / name)
        assert (tmp_path / name).stat().st_size > 0
    with pytest.raises(crease.UsageError, match="no_trim"):
        crease.fit(points, method="part", no_trim=True)


def test_the_sheet_is_local_in_its_frame(sheet):
    assert np.allclose(sheet.rotation @ sheet.rotation.T, np.eye(3))
    assert np.linalg.det(sheet.rotation) == pytest.approx(1)


def test_a_surface_is_evaluated_as_its_control_points_say(sheet):
    face = sheet.faces[0]
    (u0, u1), (v0, v1) = face.domain
    assert np.allclose(face([u0, u1], [v0, v1]), face.control_points[[0, -1], [0, -1]])
    step = 1e-6 * (u1 - u0)
    slope = (face(u0 + step, v0) - face(u0, v0)) / step
    assert np.allclose(face(u0, v0, derivative=(1, 0)), slope, rtol=1e-3, atol=1e-6)
    assert np.linalg.norm(face.normal((u0 + u1) / 2, v0)) == pytest.approx(1)
    assert np.abs(face.project(face([u0, u1], v0))["distance"]).max() < 1e-9


def test_options_reach_the_library():
    points = roof(noise=0.01)
    quadric = crease.fit(points, method="sheet", order=3, net=(6, 5), most_creases=0,
                         rotation=np.eye(3))
    assert quadric.surface.order == (3, 3) and not quadric.creases
    assert np.array_equal(quadric.rotation, np.eye(3))
    paper = crease.fit(points, method="averaging", net=(7, 8), neighbours=10, orientation="none")
    assert paper.variance.max() > 0 and paper.method == "averaging"


def test_the_part_of_the_cube_is_a_solid(part):
    assert (part.state, part.message) == ("solid", "")
    assert part.volume == pytest.approx(1)
    assert part.solids == 1
    assert len(part.faces) == 6 and len(part.creases) == 12
    assert all(face.region.type == "plane" and face.area == pytest.approx(1) for face in part.faces)
    assert part.deviation.max < 1e-9 and set(part.face) == set(range(6))
    assert np.ptp(part.mesh.vertices, axis=0) == pytest.approx([1, 1, 1])


def test_the_sides_of_the_cube_are_snapped_unless_told_not_to(part, cube):
    assert [snap.to for snap in part.snapped] == ["parallel"] * 3 + ["perpendicular"] * 3
    assert sorted(sum((snap.regions for snap in part.snapped[:3]), ())) == list(range(6))
    assert all(region.direction_error > 0 and region.place_error > 0 for region in part.regions)
    assert crease.fit(cube, method="part", no_snap=True).snapped == []


def test_automatic_is_a_sheet_where_no_surface_lies_over_another(points, cube):
    assert isinstance(crease.fit(points), crease.Sheet)
    assert isinstance(crease.fit(cube, net=(7, 7)), crease.Sheet)
    if crease.HAS_CAD:
        assert isinstance(crease.fit(cube), crease.Part)


def test_faces_are_as_asked_for(tmp_path, part, cube):
    splines = crease.fit(cube, method="part", faces="bspline", sigma=1e-6)
    for model, word in ((part, "PLANE"), (splines, "B_SPLINE_SURFACE")):
        model.write(tmp_path / "model.step")
        assert word in (tmp_path / "model.step").read_text()


def test_a_model_is_written_and_compared(tmp_path, part, sheet, points, cube):
    for model, cloud in ((part, cube), (sheet, points)):
        model.write(tmp_path / "model.step")
        for compared in (crease.compare(tmp_path / "model.step", cloud.points
                                        if cloud is cube else cloud),
                         crease.compare(model, cloud)):
            assert compared.deviation.max < 1e-6
            assert len(compared.faces) == len(model.faces)
            assert sum(face.points for face in compared.faces) == len(cloud)


def test_a_shifted_cloud_is_as_far_from_the_part_as_it_was_shifted(part, cube):
    top = cube.points[cube.points[:, 2] == 1] + [0, 0, 0.25]
    assert np.allclose(crease.compare(part, top).deviations, 0.25)


def test_everything_is_written_by_extension(tmp_path, sheet, detection, part):
    for model in (sheet, part):
        for name in ("m.brep", "m.obj", "m.png", "m.html"):
            model.write(tmp_path / name)
        model.write_creases(tmp_path / "creases.ply")
        model.write_points(tmp_path / "projected.ply")
        assert "deviation" in crease.read(tmp_path / "projected.ply").fields
    detection.write(tmp_path / "d.ply")
    detection.write_creases(tmp_path / "creases.step")
    detection.figure(tmp_path / "d.png", width=300, height=200, colour_by="variance")
    assert crease.read(tmp_path / "d.ply").fields["feature"].sum() == detection.feature.sum()
    assert (tmp_path / "d.png").read_bytes()[16:24] == (300).to_bytes(4, "big") + bytes([0, 0, 0, 200])


def test_examples_are_those_of_the_program():
    sizes = [len(crease.example(name)) for name in ("cube", "sample")]
    assert sizes == [6146, 51]
    assert [len(crease.example(name, count=500)) for name in ("panel", "bracket")] == [500, 500]
    assert not np.array_equal(*(crease.example("sample", noise=0.5, seed=seed).points
                                for seed in (1, 2)))
    for wrong in ({"name": "ball"}, {"name": "cube", "noise": 0.1}, {"name": "sample", "count": 9}):
        with pytest.raises(crease.UsageError):
            crease.example(**wrong)


def test_the_filter_takes_noise_off_and_marks_outliers():
    points = roof(noise=0.01)
    points[:5, 2] += 0.5
    filtered = crease.filter(points)
    assert filtered.noise_after < filtered.noise_before
    assert filtered.outliers[:5].all() and filtered.outliers.sum() < 20
    without = crease.filter(points, remove_outliers=True, window=40, passes=2)
    assert len(without.points) == len(points) - without.outliers.sum()


def test_arrays_and_curves_outlive_what_they_came_from(points):
    sheet = crease.fit(points, method="sheet")
    face, deviations, net = sheet.faces[0], sheet.deviations, sheet.surface.control_points
    before = [face.control_points.copy(), deviations.copy(), net.copy()]
    found = crease.detect(roof(800), resamples=4)
    curve, labels = found.creases[0].curve, found.region
    samples, kept = curve.sample(5), labels.copy()
    del sheet, found
    gc.collect()
    for _ in range(5):
        crease.fit(points[:400], method="sheet")
    after = [face.control_points, deviations, net]
    assert all(np.array_equal(one, other) for one, other in zip(before, after))
    assert np.array_equal(curve.sample(5), samples) and np.array_equal(labels, kept)


@pytest.mark.parametrize("threads", [2, 5])
def test_the_result_does_not_depend_on_the_number_of_threads(threads, sheet, detection, points, cube):
    again = crease.fit(points, method="sheet", threads=threads)
    assert again.deviations.tobytes() == sheet.deviations.tobytes()
    assert again.surface.control_points.tobytes() == sheet.surface.control_points.tobytes()
    found = crease.detect(cube, resamples=8, threads=threads)
    assert found.variance.tobytes() == detection.variance.tobytes()
    assert found.region.tobytes() == detection.region.tobytes()


def test_a_seed_decides_the_random_draws(points):
    first, second, again = (crease.detect(points, seed=seed).variance for seed in (1, 2, 1))
    assert first.tobytes() == again.tobytes() != second.tobytes()


def test_everything_is_shown_in_notebooks(detection, sheet, part, cube):
    filtered = crease.filter(roof(300))
    for seen in (cube, detection, sheet, part, filtered, crease.compare(part, cube)):
        frame = seen._repr_html_()
        assert frame.startswith("<iframe srcdoc=") and frame.endswith("</iframe>")
        assert frame.count('"') == 6 and repr(seen).startswith("<crease.")


def test_notebooks_get_thinned_clouds(monkeypatch, cube):
    monkeypatch.setattr("crease._seen.MOST_POINTS_IN_NOTEBOOK", 100)
    assert len(cube._thinned(100)) <= 100 < len(cube)
    assert len(cube._repr_html_()) < 1.5e6
