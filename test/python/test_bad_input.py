# SPDX-License-Identifier: BSD-3-Clause
"""Every function refuses what it cannot take, in one line, and takes arrays of any layout."""

import pathlib
import shutil
import subprocess
import sys

import numpy as np
import pytest

import pcl6d

GOOD = np.random.default_rng(5).random((400, 3)) * 4
POSE = np.eye(4)

FUNCTIONS = {
    "icp source": lambda p: pcl6d.icp(source=p, target=GOOD),
    "icp target": lambda p: pcl6d.icp(source=GOOD, target=p),
    "gicp": lambda p: pcl6d.gicp(source=p, target=GOOD),
    "ndt": lambda p: pcl6d.ndt(source=p, target=GOOD),
    "register": lambda p: pcl6d.register(source=p, target=GOOD),
    "verify": lambda p: pcl6d.verify(source=p, target=GOOD, T_target_source=POSE),
    "KdTree": lambda p: pcl6d.KdTree(p),
    "KdTree.query": lambda p: pcl6d.KdTree(GOOD).query(p),
    "voxel_downsample": lambda p: pcl6d.voxel_downsample(p, 0.5),
    "estimate_normals": lambda p: pcl6d.estimate_normals(p),
    "planes": lambda p: pcl6d.planes(p),
    "Slam6D.add_scan": lambda p: pcl6d.Slam6D().add_scan(p),
    "evaluate_map": lambda p: pcl6d.evaluate_map(scans=[p, GOOD], poses=[POSE, POSE]),
    "evaluate_map reference": lambda p: pcl6d.evaluate_map(
        scans=[GOOD, GOOD], poses=[POSE, POSE], reference=p),
    "write_map": lambda p: pcl6d.write_map("/nonexistent/map.ply", p),
}
WRONG = {
    "a list": (GOOD.tolist(), "is a list, but must be a numpy array"),
    "None": (None, "is a NoneType"),
    "text": ("points", "is a str"),
    "two columns": (GOOD[:, :2], r"has shape \(400, 2\), but must have \(N, 3\)"),
    "four columns": (np.ones((4, 4)), r"has shape \(4, 4\)"),
    "one dimension": (GOOD[0], r"has shape \(3,\)"),
    "three dimensions": (GOOD[None], r"has shape \(1, 400, 3\)"),
    "no dimension": (np.array(1.0), r"has shape \(\)"),
    "integers": (GOOD.astype(int), "has dtype int64, but must have float32 or float64"),
    "complex": (GOOD.astype(complex), "has dtype complex128"),
    "objects": (GOOD.astype(object), "has dtype object"),
    "half": (GOOD.astype(np.float16), "has dtype float16"),
    "long double": (GOOD.astype(np.longdouble), "has dtype"),
    "other byte order": (GOOD.astype(">f8"), "has dtype >f8"),
    "masked": (np.ma.masked_less(GOOD, 1), "is a masked array"),
    "records": (np.zeros(5, dtype=[("x", "f4"), ("y", "f4"), ("z", "f4")]), "has shape"),
}


@pytest.mark.parametrize("wrong", WRONG)
@pytest.mark.parametrize("name", FUNCTIONS)
def test_wrong_arrays_are_refused(name, wrong):
    value, message = WRONG[wrong]
    if name == "evaluate_map reference" and value is None:
        pytest.skip("None: no reference")
    with pytest.raises(pcl6d.BadArgument, match=message) as error:
        FUNCTIONS[name](value)
    assert isinstance(error.value, ValueError) and "\n" not in str(error.value)


NEED_POINTS = ["icp source", "icp target", "gicp", "ndt", "register", "verify",
               "Slam6D.add_scan", "evaluate_map"]


@pytest.mark.parametrize("name", NEED_POINTS)
@pytest.mark.parametrize("rows", [np.empty((0, 3)), np.full((9, 3), np.nan), GOOD[:2],
                                  np.full((9, 3), 1e300)], ids=["0", "nan", "2", "1e300"])
def test_too_few_finite_points_are_refused(name, rows):
    with pytest.raises(pcl6d.BadArgument, match="finite points in"):
        FUNCTIONS[name](rows)


def test_tools_take_empty_and_nan_rows():
    for rows in (np.empty((0, 3), np.float32), np.full((9, 3), np.nan)):
        assert pcl6d.voxel_downsample(rows, 1.0).shape == (0, 3)
        assert not pcl6d.estimate_normals(rows).any()
        assert pcl6d.planes(rows) == ()
        tree = pcl6d.KdTree(rows)
        distances, indices = tree.query(GOOD[:2], 3)
        assert len(tree) == 0 and (indices == -1).all() and np.isinf(distances).all()


def layouts(points):
    wide = np.full((2 * len(points), 7), np.nan, points.dtype)
    wide[::2, 1:7:2] = points
    readonly = points.copy()
    readonly.setflags(write=False)
    record = np.zeros(len(points), dtype=np.dtype([("t", "u1"), ("xyz", points.dtype, 3)]))
    record["xyz"] = points
    return {
        "Fortran": np.asfortranarray(points),
        "negative strides": points[::-1, ::-1].copy()[::-1, ::-1],
        "every second row and column": wide[::2, 1:7:2],
        "read-only": readonly,
        "not aligned": record["xyz"],
        "transposed": np.ascontiguousarray(points.T).T,
        "subclass": points.copy().view(np.matrix),
    }


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_any_layout_gives_the_same_result(dtype):
    points = GOOD.astype(dtype)
    expected = pcl6d.icp(source=points, target=GOOD, max_distance=1)
    reduced = pcl6d.voxel_downsample(points, 0.5)
    for name, array in layouts(points).items():
        result = pcl6d.icp(source=array, target=GOOD, max_distance=1)
        assert np.array_equal(result.T_target_source, expected.T_target_source), name
        assert np.array_equal(pcl6d.voxel_downsample(array, 0.5), reduced), name


def test_rows_of_stride_zero_are_points_at_one_place():
    rows = np.broadcast_to(GOOD[0], (50, 3))
    assert pcl6d.voxel_downsample(rows, 0.5).shape == (1, 3)
    assert len(pcl6d.KdTree(rows)) == 50


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if name != "write_map"])
def test_the_array_of_the_caller_is_not_changed(name):
    points = GOOD.copy()
    points[7] = np.nan
    before = points.copy()
    FUNCTIONS[name](points)
    assert np.array_equal(points, before, equal_nan=True)


def test_poses_of_any_layout_are_the_same_pose():
    guess = np.eye(4)
    guess[:3, 3] = 0.25, 0.5, -0.125  # exact in float32
    expected = pcl6d.icp(source=GOOD, target=GOOD, guess=guess, max_distance=1)
    readonly = guess.copy()
    readonly.setflags(write=False)
    for value in (guess.tolist(), np.asfortranarray(guess), guess.astype(np.float32), readonly,
                  np.pad(guess, 2)[2:6, 2:6], guess.astype(">f8")):
        result = pcl6d.icp(source=GOOD, target=GOOD, guess=value, max_distance=1)
        assert np.array_equal(result.T_target_source, expected.T_target_source)


def test_infinite_rows_are_left_out_like_nan_rows():
    points = np.concatenate([GOOD, [[np.inf, 0, 0], [0, -np.inf, 1], [np.nan, 0, 0]]])
    expected = pcl6d.icp(source=GOOD, target=GOOD, max_distance=1)
    result = pcl6d.icp(source=points, target=points, max_distance=1)
    assert np.array_equal(result.T_target_source, expected.T_target_source)
    assert len(pcl6d.KdTree(points)) == len(GOOD)


def test_nan_rows_keep_the_rows_of_results():
    points = GOOD.copy()
    points[::3] = np.nan
    _, rows = pcl6d.KdTree(points).query(GOOD[1::3])
    assert np.array_equal(rows[:, 0], np.arange(1, 400, 3))
    normals = pcl6d.estimate_normals(points)
    assert normals.shape == (400, 3) and not normals[::3].any() and normals[1].any()


BAD_POSES = {
    "shape": (np.eye(3), r"has shape \(3, 3\), but must have \(4, 4\)"),
    "scaled": (2 * np.eye(4), "is no rigid motion"),
    "mirrored": (np.diag([1.0, 1, -1, 1]), "is no rigid motion"),
    "nan": (np.full((4, 4), np.nan), "is no rigid motion"),
    "text": ("identity", "must be a 4x4 array"),
    "complex": (np.eye(4) * 1j, "must be a 4x4 array"),
}


@pytest.mark.parametrize("name", BAD_POSES)
def test_bad_poses_are_refused(name):
    value, message = BAD_POSES[name]
    for call in (lambda: pcl6d.icp(source=GOOD, target=GOOD, guess=value),
                 lambda: pcl6d.verify(source=GOOD, target=GOOD, T_target_source=value),
                 lambda: pcl6d.Slam6D().add_scan(GOOD, value)):
        with pytest.raises(pcl6d.BadArgument, match=message):
            call()


@pytest.mark.parametrize("call, message", [
    (lambda: pcl6d.icp(source=GOOD, target=GOOD, max_distance=-1), "max_distance = -1"),
    (lambda: pcl6d.icp(source=GOOD, target=GOOD, max_distance="far"), "must be a number"),
    (lambda: pcl6d.icp(source=GOOD, target=GOOD, metric="best"), "point"),
    (lambda: pcl6d.icp(source=GOOD, target=GOOD, max_iterations=True), "whole number"),
    (lambda: pcl6d.icp(source=GOOD, target=GOOD, num_threads=-1), "num_threads = -1"),
    (lambda: pcl6d.icp(source=GOOD, target=GOOD, progress=3), "not callable"),
    (lambda: pcl6d.gicp(source=GOOD, target=GOOD, neighbours=2), "neighbours"),
    (lambda: pcl6d.ndt(source=GOOD, target=GOOD, resolution=0), "resolution"),
    (lambda: pcl6d.Slam6D(voxels=1), "no option voxels"),
    (lambda: pcl6d.Slam6D(voxel=0), "voxel = 0"),
    (lambda: pcl6d.Slam6D(metric="best"), "best"),
    (lambda: pcl6d.Slam6D(voxel="small"), "voxel = 'small'"),
    (lambda: pcl6d.voxel_downsample(GOOD, float("nan")), "voxel"),
    (lambda: pcl6d.KdTree(GOOD).query_radius([1, 2], 1), "three numbers"),
    (lambda: pcl6d.KdTree(GOOD).query_radius([1, 2, 3], -1), "radius"),
    (lambda: pcl6d.KdTree(GOOD).query_radius([1, 2, 3], "near"), "radius = 'near'"),
    (lambda: pcl6d.KdTree(GOOD).query(GOOD, 0), "k = 0"),
    (lambda: pcl6d.KdTree(GOOD).query(GOOD, 1.5), "k = 1.5"),
    (lambda: pcl6d.KdTree(GOOD, num_threads=-1), "num_threads = -1"),
    (lambda: pcl6d.Slam6D().add_scan(GOOD, name=3), "name = 3"),
    (lambda: pcl6d.evaluate_map(scans=3, poses=[POSE]), "scans is a int"),
    (lambda: pcl6d.evaluate_map(scans=np.array(3.0), poses=[POSE]), "scans"),
    (lambda: pcl6d.write_map("map.ply", GOOD, intensity=np.array(3.0)), "intensity = array"),
    (lambda: pcl6d.Run.open(3), "os.PathLike"),
    (lambda: pcl6d.planes(GOOD, method="guess"), "guess"),
    (lambda: pcl6d.planes(GOOD, viewpoint=[np.inf, 0, 0]), "viewpoint must be finite"),
    (lambda: pcl6d.evaluate_map(scans=[GOOD], poses=[POSE, POSE]), "poses has 2 poses"),
    (lambda: pcl6d.evaluate_trajectory(estimate=np.empty((0, 4, 4)), reference=[POSE]), ""),
    (lambda: pcl6d.read_scans(3), "os.PathLike"),
    (lambda: pcl6d.read_scans(""), "is empty"),
    (lambda: pcl6d.read_scans("a\0b"), "zero byte"),
])
def test_bad_options_are_refused(call, message):
    with pytest.raises(pcl6d.BadArgument, match=message):
        call()


def test_what_is_missing_on_disk(tmp_path):
    none = tmp_path / "none"
    for call in (lambda: pcl6d.read_scans(none),
                 lambda: pcl6d.Run.open(none),
                 lambda: pcl6d.map_folder(none, tmp_path / "out"),
                 lambda: pcl6d.evaluate_trajectory(estimate=none, reference=none),
                 lambda: pcl6d.write_map(none / "map.ply", GOOD)):
        with pytest.raises(pcl6d.FileError, match="none") as error:
            call()
        assert isinstance(error.value, OSError) and "\n" not in str(error.value)
    assert not (tmp_path / "out").exists()


def test_errors_are_those_of_python():
    assert issubclass(pcl6d.BadArgument, ValueError)
    assert issubclass(pcl6d.ComputeFailed, RuntimeError)
    assert issubclass(pcl6d.FileError, OSError)
    slam = pcl6d.Slam6D(max_range=0.001)
    with pytest.raises(pcl6d.ComputeFailed):
        slam.add_scan(GOOD)
        slam.optimize()


def test_a_package_that_cannot_be_loaded_tells_what_to_install(tmp_path):
    package = tmp_path / "pcl6d"
    package.mkdir()
    for source in pathlib.Path(pcl6d.__file__).parent.glob("*.py"):
        shutil.copy(source, package)  # without the extension
    done = subprocess.run([sys.executable, "-c", "import pcl6d"], timeout=60,
                          env={"PYTHONPATH": str(tmp_path)}, capture_output=True, text=True)
    last = done.stderr.strip().splitlines()[-1]
    assert done.returncode == 1
    assert last.startswith("ImportError: pcl6d: the extension module cannot be loaded: ")
    assert "_native" in last and "apt --fix-broken install" in last
