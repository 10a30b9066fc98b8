# SPDX-License-Identifier: BSD-3-Clause
"""Maps of many scans, in memory and on disk."""

import json
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest
from conftest import moved, pose

import pcl6d

FAR = np.array([512345.0, 5403210.0, 312.0])


def errors(poses, truths):
    return np.abs(poses - truths).max()


def test_slam_in_memory(scan_folder):
    folder, truths = scan_folder
    slam = pcl6d.Slam6D(voxel=0.1)
    for scan in pcl6d.read_scans(folder):
        slam.add_scan(scan.points, scan.initial_pose, name=scan.name)
    assert [scan.state for scan in slam.result.scans][-1] == "pending"
    result = slam.optimize()
    assert errors(result.poses, truths) < 0.02
    assert [scan.name for scan in result.scans] == ["scan000.ply", "scan001.ply", "scan002.ply"]
    assert result.scans[1].converged and result.scans[1].fitness > 0.5
    assert float(result.parameters["voxel"]) == 0.1
    assert result.verification is not None and result.verification.links
    json.dumps(result.to_dict())


def test_slam_of_national_coordinates(scan_folder):
    folder, truths = scan_folder
    slam = pcl6d.Slam6D(voxel=0.1)
    clouds = []
    for scan in pcl6d.read_scans(folder):
        clouds.append(moved(scan.initial_pose, scan.points.astype(np.float64)) + FAR)
        slam.add_scan(clouds[-1])  # all in one frame, each a little off
    result = slam.optimize()
    starts = [scan.initial_pose for scan in pcl6d.read_scans(folder)]
    for found, truth, start, cloud in zip(result.poses, truths, starts, clouds):
        local = moved(np.linalg.inv(start), cloud - FAR)
        assert np.abs(moved(found, cloud) - FAR - moved(truth, local)).max() < 0.03


def test_map_folder_writes_a_run(scan_folder, tmp_path):
    folder, truths = scan_folder
    run = pcl6d.map_folder(pathlib.Path(folder), tmp_path / "run", voxel=0.1)
    assert run.complete and not run.missing
    assert errors(run.poses, truths) < 0.02
    again = pcl6d.Run.open(tmp_path / "run")
    assert np.array_equal(again.poses, run.poses)
    assert again.verdict == run.verdict and again.options["voxel"] == "0.1"
    tests = again.verification.links
    assert tests and {(test.first, test.second) for test in tests} <= {(0, 1), (0, 2), (1, 2)}
    assert all(test.result in ("good", "weak", "unverified", "wrong") for test in tests)
    points = again.map()
    assert points.points.dtype == np.float32 and points.world.dtype == np.float64
    assert set(np.unique(points.scan)) == {0, 1, 2}
    distances, _ = pcl6d.KdTree(np.concatenate(
        [moved(T, again.scan(i)) for i, T in enumerate(run.poses)])).query(points.world)
    assert distances.max() < 1e-3
    assert again.links()[0].kind == "sequence"
    assert "3 scans" in repr(again)
    json.dumps(again.to_dict())
    with pytest.raises(pcl6d.FileError, match="is not empty"):
        pcl6d.map_folder(folder, tmp_path / "run")
    with pytest.raises(IndexError):
        again.scan(3)
    (tmp_path / "run" / "verification.csv").write_text("from,to\n")
    with pytest.raises(pcl6d.FileError, match="verification.csv"):
        again.verification


def test_map_folder_selects_scans(scan_folder, tmp_path):
    folder, _ = scan_folder
    run = pcl6d.map_folder(folder, tmp_path / "run", voxel=0.1, first=1, last=2)
    assert [scan.index for scan in run.scans] == [1, 2]
    with pytest.raises(pcl6d.BadArgument):
        pcl6d.map_folder(folder, tmp_path / "none", first=7)
    with pytest.raises(pcl6d.BadArgument, match="no option voxels"):
        pcl6d.map_folder(folder, tmp_path / "none", voxels=0.1)


PROGRAM = pathlib.Path(os.environ.get("PCL6D_BIN_DIR", "")) / "pcl_slam6d"


@pytest.mark.skipif(not PROGRAM.is_file(), reason="pcl_slam6d is not built")
def test_map_folder_has_the_poses_of_the_program(scan_folder, tmp_path):
    folder, _ = scan_folder
    subprocess.run([PROGRAM, folder, "--output", tmp_path / "program", "--track", "off",
                    "--moving", "keep", "--no-picture", "--quiet"], check=False, timeout=60)
    pcl6d.map_folder(folder, tmp_path / "python")
    for name in ("trajectory.kitti", "map.pcd", "scans/scan001.pcd", "graph.g2o"):
        assert (tmp_path / "program" / name).read_bytes() == (
            tmp_path / "python" / name).read_bytes(), name


EXAMPLE = pathlib.Path(__file__).parents[2] / "share/examples/map_folder.py"


def test_the_example_maps_and_draws(scan_folder, tmp_path):
    folder, _ = scan_folder
    hidden = tmp_path / "without" / "matplotlib.py"  # which takes long to start
    hidden.parent.mkdir()
    hidden.write_text("raise ImportError")
    paths = os.pathsep.join([str(hidden.parent), os.environ.get("PYTHONPATH", "")])
    done = subprocess.run([sys.executable, EXAMPLE, folder, tmp_path / "run"], timeout=60,
                          env={**os.environ, "PYTHONPATH": paths}, capture_output=True, text=True)
    assert done.returncode == 0 and "all 3 scans registered" in done.stdout, done.stderr
    picture = (tmp_path / "run" / "plot.pgm").read_bytes()
    assert len(picture) == 15 + 600 * 600 and min(picture[15:]) < 128


def test_scans_are_a_sequence(scan_folder):
    folder, _ = scan_folder
    reports = []
    scans = pcl6d.read_scans(folder, progress=lambda *report: reports.append(report))
    assert len(scans) == 3 and len(list(scans)) == 3
    assert reports[-1] == ("reading", 3, 3)
    assert scans[-1].name == "scan002.ply" and len(scans[1:]) == 2
    assert scans.pose_source == "poses.txt" and scans.note == ""
    with pytest.raises(IndexError):
        scans[3]


@pytest.mark.parametrize("suffix", ["pcd", "ply", "las", "xyz"])
def test_write_map_and_read_it_again(suffix, tmp_path):
    points = np.random.default_rng(12).random((50, 3)) * 9
    file = tmp_path / f"map.{suffix}"
    lost = pcl6d.write_map(file, points + FAR, intensity=np.arange(50))
    assert isinstance(lost, list)
    scans = pcl6d.read_scans(file)
    world = moved(scans[0].initial_pose, scans[0].points.astype(np.float64))
    shift = world - points - (FAR if np.abs(world).max() > 1e4 else 0)
    assert np.abs(shift - np.round(shift[0])).max() < 1e-3
    assert "moved by" in scans.note
    if suffix != "xyz":
        assert np.array_equal(scans[0].intensity[:3], [0, 1, 2])
    with pytest.raises(pcl6d.BadArgument, match="intensity has 2 numbers"):
        pcl6d.write_map(file, points, intensity=[1, 2])
    with pytest.raises(pcl6d.BadArgument):
        pcl6d.write_map(tmp_path / "map.unknown", points)


def test_evaluate_trajectory(tmp_path):
    reference = np.stack([pose(x=i, y=0.1 * i * i) for i in range(10)])
    shifted = pose(5, 6, 7, yaw=0.4) @ reference
    found = pcl6d.evaluate_trajectory(estimate=shifted, reference=reference)
    assert found.num_pairs == 10 and found.position.rmse < 1e-9
    assert found.position_without_alignment.rmse > 5
    assert np.allclose(found.alignment, np.linalg.inv(pose(5, 6, 7, yaw=0.4)))
    one_off = reference.copy()
    one_off[4, 2, 3] += 0.5
    found = pcl6d.evaluate_trajectory(
        estimate=(one_off, np.arange(10.0)), reference=(reference, np.arange(10.0) + 0.01))
    assert found.matched_by_time and found.position_without_alignment.max == pytest.approx(0.5)
    rows = tmp_path / "poses.txt"
    rows.write_text("\n".join(" ".join(map(repr, T[:3].ravel().tolist())) for T in reference))
    assert pcl6d.evaluate_trajectory(estimate=rows, reference=str(rows)).position.max < 1e-12
    with pytest.raises(pcl6d.ComputeFailed):
        pcl6d.evaluate_trajectory(
            estimate=(reference, np.arange(10.0)), reference=(reference, np.arange(10.0) + 50))


@pytest.mark.parametrize("offset", [np.zeros(3), FAR], ids=["near", "far"])
def test_evaluate_map(scan_folder, offset):
    folder, truths = scan_folder
    scans = [scan.points for scan in pcl6d.read_scans(folder)]
    truths = truths.copy()
    truths[:, :3, 3] += offset
    bad = truths.copy()
    bad[1, 0, 3] += 0.2
    good, worse = (pcl6d.evaluate_map(scans=scans, poses=poses, voxel=0.15)
                   for poses in (truths, bad))
    assert good.num_pairs == 3 and good.agreement > worse.agreement
    assert 2 * good.thickness < worse.thickness
    assert len(good.scans) == 3 and worse.worst_first[0] == 1
