# SPDX-License-Identifier: BSD-3-Clause
"""Long calls: other threads run, progress is told, Ctrl-C stops them, a fork is survived."""

import os
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest

import pcl6d

POINTS = np.random.default_rng(6).random((500, 3)) * 4
POSE = np.eye(4)


def endless(progress):
    """ICP is not at rest before its limit has shrunk, which takes years here."""
    pcl6d.icp(source=POINTS, target=POINTS, max_distance_start=4, max_distance=1,
              distance_decay=1 - 1e-15, max_iterations=2**31 - 1, progress=progress)


def slam(progress):
    work = pcl6d.Slam6D(voxel=0.2)
    for _ in range(2):
        work.add_scan(POINTS)
    work.optimize(progress=progress)


def long_calls(folder, run):
    return {
        "icp": lambda p: pcl6d.icp(source=POINTS, target=POINTS, progress=p),
        "gicp": lambda p: pcl6d.gicp(source=POINTS, target=POINTS, progress=p),
        "ndt": lambda p: pcl6d.ndt(source=POINTS, target=POINTS, progress=p),
        "register": lambda p: pcl6d.register(source=POINTS, target=POINTS, progress=p),
        "verify": lambda p: pcl6d.verify(
            source=POINTS, target=POINTS, T_target_source=POSE, progress=p),
        "KdTree": lambda p: pcl6d.KdTree(POINTS, progress=p),
        "KdTree.query": lambda p: pcl6d.KdTree(POINTS).query(POINTS, progress=p),
        "voxel_downsample": lambda p: pcl6d.voxel_downsample(POINTS, 0.5, progress=p),
        "estimate_normals": lambda p: pcl6d.estimate_normals(POINTS, progress=p),
        "planes": lambda p: pcl6d.planes(POINTS, progress=p),
        "Slam6D.add_scan": lambda p: pcl6d.Slam6D().add_scan(POINTS, progress=p),
        "Slam6D.optimize": slam,
        "map_folder": lambda p: pcl6d.map_folder(folder, run + "2", voxel=0.1, progress=p),
        "read_scans": lambda p: pcl6d.read_scans(folder, progress=p),
        "Scans": lambda p: list(pcl6d.read_scans(folder, progress=p)),
        "Run.map": lambda p: pcl6d.Run.open(run).map(progress=p),
        "Run.scan": lambda p: pcl6d.Run.open(run).scan(0, progress=p),
        "write_map": lambda p: pcl6d.write_map(run + ".ply", POINTS, progress=p),
        "evaluate_trajectory": lambda p: pcl6d.evaluate_trajectory(
            estimate=[POSE] * 3, reference=[POSE] * 3, progress=p),
        "evaluate_map": lambda p: pcl6d.evaluate_map(
            scans=[POINTS, POINTS], poses=[POSE, POSE], progress=p),
    }


@pytest.fixture
def calls(scan_folder, tmp_path):
    run = str(tmp_path / "run")
    pcl6d.map_folder(scan_folder[0], run, voxel=0.1)
    return long_calls(scan_folder[0], run)


def test_ctrl_c_and_progress_of_every_long_call(calls, tmp_path):
    for name, call in calls.items():
        reports = []

        def interrupt(stage, done, total):
            reports.append((stage, done, total))
            os.kill(os.getpid(), signal.SIGINT)

        with pytest.raises(KeyboardInterrupt):
            call(interrupt)
        stage, done, total = reports[0]
        assert isinstance(stage, str) and 0 <= done <= total or total == 0, name
    left = sorted(p.name for p in tmp_path.iterdir())
    assert left == ["run", "run.ply", "scans"] or left == ["run", "scans"]  # no run2, no parts


def test_an_exception_of_progress_stops_the_call(calls):
    for name, call in calls.items():
        def fail(*_):
            raise ZeroDivisionError(name)

        with pytest.raises(ZeroDivisionError, match=name):
            call(fail)


def test_ctrl_c_stops_work_that_has_no_end():
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        endless(None)
    timer.join()


def test_other_threads_run_meanwhile():
    class Enough(Exception):
        pass

    seen = threading.Event()
    threading.Timer(0.2, seen.set).start()

    def stop(*_):
        if seen.is_set():
            raise Enough

    with pytest.raises(Enough):
        endless(stop)


def test_two_threads_at_once(pair):
    target, source, _ = pair
    alone = pcl6d.gicp(source=source, target=target, max_distance=0.6)
    tree = pcl6d.KdTree(target)
    rows = tree.query(source, 4)[1]
    results, errors = [], []

    def work():
        try:
            for _ in range(3):
                found = pcl6d.gicp(source=source, target=target, max_distance=0.6)
                assert np.array_equal(found.T_target_source, alone.T_target_source)
                assert np.array_equal(tree.query(source, 4)[1], rows)
            results.append(True)
        except BaseException as error:
            errors.append(error)

    threads = [threading.Thread(target=work) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not errors and len(results) == 2


def test_two_threads_read_the_same_scans_and_the_same_run(scan_folder, tmp_path):
    scans = pcl6d.read_scans(scan_folder[0])
    run = pcl6d.map_folder(scan_folder[0], tmp_path / "run", voxel=0.1)
    expected = [scan.points for scan in pcl6d.read_scans(scan_folder[0])]
    world = run.map().world
    errors = []

    def work():
        try:
            for _ in range(5):
                for i in range(3):
                    assert np.array_equal(scans[i].points, expected[i])
                assert np.array_equal(run.map().world, world)
                assert len(run.scan(1)) > 0
        except BaseException as error:
            errors.append(error)

    threads = [threading.Thread(target=work) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not errors


def test_a_slam_takes_one_call_at_a_time(pair):
    work = pcl6d.Slam6D(voxel=0.1)
    work.add_scan(pair[0])
    work.add_scan(pair[1])

    def look(*_):
        with pytest.raises(pcl6d.BadArgument, match="is busy with another call"):
            work.add_scan(pair[0])
        with pytest.raises(pcl6d.BadArgument, match="is busy with another call"):
            work.result
        raise LookupError

    with pytest.raises(LookupError):
        work.optimize(progress=look)
    result = work.optimize()  # goes on
    assert [scan.converged for scan in result.scans] == [True, True]


FORK = """
import os, sys
import numpy as np
import pcl6d
points = np.random.default_rng(1).random((5000, 3)) * 4
def work():
    return pcl6d.icp(source=points + 0.01, target=points, num_threads=2).T_target_source
before = work()
child = os.fork()
same = np.array_equal(work(), before)
if child == 0:
    sys.exit(0 if same else 1)  # with all handlers of the end
_, status = os.waitpid(child, 0)
sys.exit(0 if same and status == 0 else 1)
"""


def test_a_fork_has_threads_of_its_own():
    assert subprocess.run([sys.executable, "-c", FORK], timeout=60).returncode == 0


FORK_AMID = """
import os, sys, threading
import numpy as np
import pcl6d
points = np.random.default_rng(1).random((5000, 3)) * 4
def work():
    return pcl6d.icp(source=points + 0.01, target=points, num_threads=2).T_target_source
before = work()
began = threading.Event()
def busy():
    pcl6d.icp(source=points, target=points, max_distance_start=4, max_distance=1,
              distance_decay=1 - 1e-9, max_iterations=300, progress=lambda *_: began.set())
thread = threading.Thread(target=busy)
thread.start()
began.wait()
child = os.fork()  # amid a call of the other thread
same = np.array_equal(work(), before)
if child == 0:
    sys.exit(0 if same else 1)
thread.join()
_, status = os.waitpid(child, 0)
sys.exit(0 if same and status == 0 else 1)
"""


def test_a_fork_amid_a_call_of_another_thread():
    assert subprocess.run([sys.executable, "-c", FORK_AMID], timeout=60).returncode == 0


LEFT_BEHIND = """
import os, signal
import numpy as np
import pcl6d
points = np.random.default_rng(1).random((60000, 3)) * 40
def interrupt(*_):
    os.kill(os.getpid(), signal.SIGINT)
try:
    pcl6d.planes(points, progress=interrupt)
except KeyboardInterrupt:
    print("stopped")
"""


def test_the_interpreter_ends_in_order_behind_stopped_work():
    done = subprocess.run([sys.executable, "-c", LEFT_BEHIND], timeout=60,
                          capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout == "stopped\n" and done.stderr == ""
