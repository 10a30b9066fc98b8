# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C amid the work of each call that takes seconds: the call ends, and so does its work."""

import os
import signal
import threading
import time

import numpy as np
import pytest

import pcl6d
from conftest import moved, pose, room

SECONDS = 2  # from the signal until no work is left; a tenth is usual
T = pose(0.3, -0.2, 0.05, 0.01, -0.02, 0.1)
A = room(200_000, 1).astype(np.float32)
B = moved(np.linalg.inv(T), room(200_000, 2)).astype(np.float32)
SCANS = [A[i::4] for i in range(4)]
POSES = [np.eye(4)] * 4
DRIVE = np.tile(np.eye(4), (20_000, 1, 1))


def query(progress):
    pcl6d.KdTree(A).query(B, 64, progress=progress)


def slam(progress):
    work = pcl6d.Slam6D()
    for scan in SCANS:
        work.add_scan(scan)
    work.optimize(progress=progress)


def map_folder(progress, folder):
    pcl6d.map_folder(folder, folder / "out", progress=progress)


LONG_CALLS = {
    "icp": lambda p: pcl6d.icp(source=B, target=A, max_distance=1, num_threads=1, progress=p),
    "icp prepares planes": lambda p: pcl6d.icp(
        source=B, target=A, metric="plane", neighbours=64, num_threads=1, progress=p),
    "gicp": lambda p: pcl6d.gicp(source=B, target=A, max_distance=1, num_threads=1, progress=p),
    "ndt": lambda p: pcl6d.ndt(source=B, target=A, resolution=0.5, progress=p),
    "register": lambda p: pcl6d.register(source=B, target=A, progress=p),
    "verify": lambda p: pcl6d.verify(source=B, target=A, T_target_source=T, progress=p),
    "KdTree.query": query,
    "estimate_normals": lambda p: pcl6d.estimate_normals(
        A, neighbours=64, num_threads=1, progress=p),
    "planes region-growing": lambda p: pcl6d.planes(A, voxel=0.005, progress=p),
    "planes ransac": lambda p: pcl6d.planes(A, voxel=0.005, method="ransac", progress=p),
    "planes hough": lambda p: pcl6d.planes(A, voxel=0.005, method="hough", progress=p),
    "Slam6D.optimize": slam,
    "evaluate_trajectory": lambda p: pcl6d.evaluate_trajectory(
        estimate=DRIVE, reference=DRIVE, progress=p),
    "evaluate_map": lambda p: pcl6d.evaluate_map(scans=SCANS, poses=POSES, progress=p),
}


def interrupt(call):
    """Sends SIGINT 50 ms behind the first report of the call; returns the seconds from the signal
    until no work of the call is left."""
    timers, sent = [], []

    def send():
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    def start(*_):
        if not timers:
            timers.append(threading.Timer(0.05, send))
            timers[0].start()

    early = False
    with pytest.raises(KeyboardInterrupt):
        call(start)
        early = True  # the signal comes now
        timers[0].join()
        time.sleep(1)
    assert not early, "the call ended before the signal: its input is too small for this test"
    pcl6d._native.wait_for_stopped()
    return time.monotonic() - sent[0]


@pytest.mark.parametrize("name", LONG_CALLS)
def test_ctrl_c_ends_the_work(name):
    assert interrupt(LONG_CALLS[name]) < SECONDS


def test_ctrl_c_ends_map_folder_and_leaves_no_file(tmp_path):
    for i, scan in enumerate(SCANS):
        pcl6d.write_map(tmp_path / f"scan{i:03}.ply", scan)
    before = sorted(tmp_path.iterdir())
    assert interrupt(lambda p: map_folder(p, tmp_path)) < SECONDS
    assert sorted(tmp_path.iterdir()) == before


def test_a_call_after_a_stopped_one_gives_the_same_bits():
    def call(progress):
        return pcl6d.gicp(source=B[::20], target=A[::20], max_distance=0.5, progress=progress)

    expected = call(None)
    interrupt(LONG_CALLS["gicp"])
    assert np.array_equal(call(None).T_target_source, expected.T_target_source)
