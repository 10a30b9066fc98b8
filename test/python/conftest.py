# SPDX-License-Identifier: BSD-3-Clause
"""Simulated rooms with exact truth."""

import signal

import numpy as np
import pytest


def pose(x=0.0, y=0.0, z=0.0, roll=0.0, pitch=0.0, yaw=0.0):
    """4x4 of R = Rz(yaw) Ry(pitch) Rx(roll)."""
    cr, sr = np.cos(roll), np.sin(roll)
    cp, sp = np.cos(pitch), np.sin(pitch)
    cy, sy = np.cos(yaw), np.sin(yaw)
    T = np.eye(4)
    T[:3, :3] = (
        np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
        @ np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
        @ np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    )
    T[:3, 3] = x, y, z
    return T


def moved(T, points):
    return points @ T[:3, :3].T + T[:3, 3]


def box(low, high, count, random):
    """Points on the six faces of a box."""
    low, high = np.asarray(low, float), np.asarray(high, float)
    points = low + random.random((count, 3)) * (high - low)
    face = random.integers(0, 6, count)
    points[np.arange(count), face % 3] = np.where(face < 3, low[face % 3], high[face % 3])
    return points


def room(count, seed):
    """A room of 8 x 6 x 3 m with three boxes, of which no turn is like another."""
    random = np.random.default_rng(seed)
    parts = [
        box((-4, -3, -1), (4, 3, 2), count, random),
        box((2, 1, -1), (3.5, 2.6, 0.7), count // 6, random),
        box((-3.7, -2, -1), (-2.9, 0.5, 0.2), count // 6, random),
        box((1, -2.9, -1), (1.6, -2.2, 1.1), count // 8, random),
    ]
    points = np.concatenate(parts)
    return points + 0.002 * random.standard_normal(points.shape)


def error_of(T, truth, points):
    """Largest distance [m] of points that both poses move."""
    return np.abs(moved(T, points) - moved(truth, points)).max()


@pytest.fixture(scope="session", autouse=True)
def ctrl_c():
    """Shells start commands in the background with SIGINT ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="session")
def pair():
    """target, source (float32) and the true T_target_source."""
    truth = pose(0.3, -0.2, 0.05, 0.01, -0.02, 0.1)
    source = moved(np.linalg.inv(truth), room(6000, 2))
    return room(6000, 1).astype(np.float32), source.astype(np.float32), truth


@pytest.fixture
def scan_folder(tmp_path):
    """Three scans of the room with rough poses, and the true poses."""
    import pcl6d

    folder = tmp_path / "scans"
    folder.mkdir()
    truths = [pose(), pose(0.6, 0.1, 0, yaw=0.1), pose(1.0, -0.4, 0, yaw=-0.15)]
    rough = [pose(), pose(0.55, 0.14, 0, yaw=0.12), pose(1.06, -0.36, 0, yaw=-0.13)]
    rows = []
    for i, (truth, start) in enumerate(zip(truths, rough)):
        points = moved(np.linalg.inv(truth), room(5000, 10 + i)).astype(np.float32)
        pcl6d.write_map(folder / f"scan{i:03}.ply", points)
        rows.append(" ".join(f"{v:.17g}" for v in start[:3].ravel()))
    (folder / "poses.txt").write_text("\n".join(rows) + "\n")
    return folder, np.array(truths)
