# SPDX-License-Identifier: BSD-3-Clause
"""Registration and verification against exact truth."""

import dataclasses
import json
import tracemalloc

import numpy as np
import pytest
from conftest import error_of, moved, pose

import pcl6d

OPTIONS = {"icp": dict(max_distance=0.6), "gicp": dict(max_distance=0.6), "ndt": {}}
FAR = np.array([512345.0, 5403210.0, 312.0])


@pytest.mark.parametrize("name", OPTIONS)
def test_finds_the_true_pose(name, pair):
    target, source, truth = pair
    result = getattr(pcl6d, name)(source=source, target=target, **OPTIONS[name])
    assert result.converged and result.status == "ok"
    # icp() pairs single points, 6 cm apart; ndt() has cells of 1 m
    assert error_of(result.T_target_source, truth, source) < 0.05
    assert result.fitness > 0.9 and result.num_inliers > 5000
    assert result.free_directions.shape == (0, 6)


def test_plane_metric_and_guess(pair):
    target, source, truth = pair
    guess = pose(2, 1, 0, yaw=1) @ truth  # only a guess near the truth helps
    bad = pcl6d.icp(source=source, target=target, guess=guess, max_distance=0.3)
    assert error_of(bad.T_target_source, truth, source) > 0.5
    good = pcl6d.icp(
        source=source, target=target, guess=truth, metric="plane", max_distance=0.3
    )
    assert error_of(good.T_target_source, truth, source) < 0.01


def test_a_single_plane_leaves_three_directions_free():
    random = np.random.default_rng(3)
    floor = random.random((3000, 3)) * (8, 6, 0)
    result = pcl6d.icp(source=floor + (0, 0, 0.05), target=floor, metric="plane")
    assert not result.converged and result.status == "rank-deficient"
    assert result.free_directions.shape == (3, 6)  # x, y, yaw: no motion along z
    assert np.abs(result.free_directions[:, 2]).max() < 0.05
    assert abs(result.T_target_source[2, 3] + 0.05) < 1e-3


def test_register_needs_no_guess():
    from conftest import room

    truth = pose(0.8, -0.5, 0, yaw=2.0)
    source = moved(np.linalg.inv(truth), room(30000, 2))
    result = pcl6d.register(source=source, target=room(30000, 1), voxel=0.1)
    assert result.status in ("unique", "ambiguous", "none")
    assert result.converged == (result.status == "unique")
    if result.converged:
        assert error_of(result.T_target_source, truth, source) < 0.05


def test_verify_tells_right_from_wrong(pair):
    target, source, truth = pair
    right = pcl6d.verify(source=source, target=target, T_target_source=truth, voxel=0.15)
    shifted = truth.copy()
    shifted[0, 3] += 0.5
    wrong = pcl6d.verify(source=source, target=target, T_target_source=shifted, voxel=0.15)
    assert right.result != "wrong"
    assert not wrong.consistent
    assert right.probability_wrong < wrong.probability_wrong
    assert right.shift < 0.05


@pytest.mark.parametrize("name", OPTIONS)
def test_national_coordinates_keep_their_digits(name, pair):
    target, source, truth = pair
    call, options = getattr(pcl6d, name), OPTIONS[name]
    near = call(source=source, target=target, **options)
    to_far, from_far = np.eye(4), np.eye(4)
    to_far[:3, 3], from_far[:3, 3] = FAR, -FAR
    far_source = source.astype(np.float64) + FAR
    far = call(source=far_source, target=target.astype(np.float64) + FAR, **options)
    expected = to_far @ near.T_target_source @ from_far
    assert np.abs(moved(far.T_target_source, far_source)
                  - moved(expected, far_source)).max() < 1e-4
    assert far.num_inliers == pytest.approx(near.num_inliers, rel=1e-3)


def test_covariance_moves_with_the_frame_of_the_source(pair):
    target, source, _ = pair
    offset = np.array([2000.0, 3000.0, 10.0])
    near = pcl6d.icp(source=source, target=target, max_distance=0.6)
    far = pcl6d.icp(
        source=source.astype(np.float64) + offset,
        target=target,
        guess=np.block([[np.eye(3), -offset[:, None]], [np.zeros((1, 3)), 1]]),
        max_distance=0.6,
    )

    def parameters(x):  # of the pose of the far rows, from those of the near ones
        T = pose(*x)
        return np.concatenate([T[:3, 3] - T[:3, :3] @ offset, x[3:]])

    R = near.T_target_source[:3, :3]
    x = np.concatenate([near.T_target_source[:3, 3],
                        [np.arctan2(R[2, 1], R[2, 2]), -np.arcsin(R[2, 0]),
                         np.arctan2(R[1, 0], R[0, 0])]])
    steps = 1e-6 * np.eye(6)
    J = np.stack([(parameters(x + d) - parameters(x - d)) / 2e-6 for d in steps], axis=1)
    assert np.allclose(far.covariance, J @ near.covariance @ J.T, rtol=1e-2, atol=1e-12)


def test_results_are_frozen_and_plain(pair):
    target, source, truth = pair
    result = pcl6d.gicp(source=source, target=target, guess=truth)
    with pytest.raises(dataclasses.FrozenInstanceError):
        result.fitness = 1
    with pytest.raises(ValueError):
        result.T_target_source[0, 0] = 2
    assert repr(result).startswith("RegistrationResult(T_target_source=<4x4 float64>, converged=")
    values = json.loads(json.dumps(result.to_dict()))
    assert np.array_equal(values["T_target_source"], result.T_target_source)
    assert set(values) >= {"converged", "status", "num_inliers", "fitness", "inlier_rmse",
                           "covariance", "free_directions"}


def test_numpy_makes_no_copy_of_the_input():
    points = np.random.default_rng(4).random((300000, 3))
    tracemalloc.start()
    try:
        pcl6d.KdTree(points)
        assert tracemalloc.get_traced_memory()[1] < 100000  # bytes; the points are 7.2 MB
    finally:
        tracemalloc.stop()


def test_source_and_target_are_keyword_only(pair):
    target, source, _ = pair
    with pytest.raises(TypeError):
        pcl6d.icp(source, target)
    with pytest.raises(TypeError):
        pcl6d.gicp(source=source, target=target, metric="point")
