# SPDX-License-Identifier: BSD-3-Clause
"""Tools for points against numpy."""

import numpy as np
import pytest
from conftest import box

import pcl6d

FAR = np.array([512345.0, 5403210.0, 312.0])


@pytest.fixture(scope="module")
def points():
    return np.random.default_rng(8).random((800, 3)) * 5


def test_kd_tree_finds_what_brute_force_finds(points):
    queries = np.random.default_rng(9).random((100, 3)) * 5
    squares = ((queries[:, None] - points[None]) ** 2).sum(axis=2)
    expected = np.argsort(squares, axis=1)[:, :4]
    distances, rows = pcl6d.KdTree(points).query(queries, 4)
    assert np.array_equal(rows, expected)
    assert np.allclose(distances, np.sqrt(np.take_along_axis(squares, expected, 1)), atol=1e-6)
    assert distances.dtype == np.float64 and rows.dtype == np.int64
    _, near = pcl6d.KdTree(points).query(queries, 4, max_distance=0.2)
    assert np.array_equal(near == -1, np.sort(squares, axis=1)[:, :4] > 0.04)


def test_kd_tree_radius_and_far_points(points):
    tree = pcl6d.KdTree(points + FAR)
    assert len(tree) == 800 and repr(tree) == "KdTree(800 points)"
    distances, rows = tree.query_radius(FAR + 2.5, 1.0)
    true = np.linalg.norm(points - 2.5, axis=1)
    assert np.array_equal(np.sort(rows), np.flatnonzero(true < 1.0))
    assert np.allclose(distances, true[rows], atol=1e-5)


def test_voxel_downsample_is_the_mean_of_each_voxel(points):
    keys = np.floor(points / 0.5).astype(int)
    _, group = np.unique(keys, axis=0, return_inverse=True)
    group = group.ravel()
    means = np.stack([points[group == g].mean(axis=0) for g in range(group.max() + 1)])
    reduced = pcl6d.voxel_downsample(points, 0.5)
    assert reduced.dtype == np.float64 and reduced.shape == means.shape
    order = lambda p: p[np.lexsort(np.round(p, 4).T)]
    assert np.allclose(order(reduced), order(means), atol=1e-5)
    assert pcl6d.voxel_downsample(points.astype(np.float32), 0.5).dtype == np.float32


def test_voxel_downsample_keeps_far_points_in_their_place(points):
    reduced = pcl6d.voxel_downsample(points + FAR, 0.5)
    near = pcl6d.voxel_downsample(points, 0.5)
    assert np.allclose(np.sort(reduced, 0), np.sort(near, 0) + FAR, atol=1e-5)
    chosen = pcl6d.voxel_downsample(points, 0.5, method="random", seed=3)
    assert np.isin(chosen.astype(np.float32), points.astype(np.float32)).all()


def test_normals_look_to_the_viewpoint():
    random = np.random.default_rng(10)
    floor = random.random((500, 3)) * (4, 4, 0)
    for height in (2.0, -2.0):
        normals = pcl6d.estimate_normals(floor, viewpoint=[2, 2, height])
        assert normals.dtype == np.float32
        assert np.allclose(normals, [0, 0, np.sign(height)], atol=1e-5)
    far = pcl6d.estimate_normals(floor + FAR, viewpoint=FAR + [2, 2, 3])
    assert np.allclose(far, [0, 0, 1], atol=1e-3)


@pytest.mark.parametrize("offset", [np.zeros(3), FAR], ids=["near", "far"])
def test_planes_of_a_box(offset):
    random = np.random.default_rng(11)
    points = box((-2, -1.5, -1), (2, 1.5, 1.5), 20000, random)
    points += 0.001 * random.standard_normal(points.shape) + offset
    found = pcl6d.planes(points, viewpoint=offset)
    assert len(found) == 6
    assert [plane.area for plane in found] == sorted((p.area for p in found), reverse=True)
    assert sum(plane.area for plane in found) == pytest.approx(2 * (12 + 10 + 7.5), rel=0.1)
    for plane in found:
        rest = points[plane.indices] @ plane.normal - plane.offset
        assert np.sqrt((rest**2).mean()) == pytest.approx(plane.inlier_rmse, abs=1e-3)
        assert np.abs(plane.hull @ plane.normal - plane.offset).max() < 1e-3
        assert plane.num_inliers == len(plane.indices) > 1000
