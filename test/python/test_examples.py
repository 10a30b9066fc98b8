# SPDX-License-Identifier: BSD-3-Clause
"""The examples of share/examples that take scans from files (map_folder.py: test_maps.py)."""

import pathlib
import re
import subprocess
import sys

import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "share/examples"


def run(name, *files):
    return subprocess.run([sys.executable, FOLDER / name, *files], timeout=60,
                          capture_output=True, text=True)


def test_register_two_scans_prints_the_pose(scan_folder):
    folder, truths = scan_folder
    done = run("register_two_scans.py", folder / "scan000.ply", folder / "scan001.ply")
    assert done.returncode == 0 and done.stdout.startswith("unique\n"), done.stderr
    numbers = re.findall(r"-?\d\.\d+(?:e[+-]\d+)?|-?\d\.", done.stdout)
    pose = np.array(numbers, float).reshape(4, 4)
    assert np.abs(pose - np.linalg.inv(truths[0]) @ truths[1]).max() < 0.02


def test_find_planes_prints_the_largest_first(scan_folder):
    done = run("find_planes.py", scan_folder[0] / "scan000.ply")
    areas = [float(line.split()[0]) for line in done.stdout.splitlines()]
    assert done.returncode == 0 and len(areas) >= 6, done.stderr
    assert areas == sorted(areas, reverse=True) and areas[0] > 40
