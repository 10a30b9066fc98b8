# SPDX-License-Identifier: BSD-3-Clause
"""The planes of a scan, largest first. usage: find_planes.py SCAN"""

import sys

import pcl6d

points = pcl6d.read_scans(sys.argv[1])[0].points
for plane in pcl6d.planes(points):
    print(f"{plane.area:.1f} m^2, {plane.num_inliers} points, normal {plane.normal.round(3)}")
