# SPDX-License-Identifier: BSD-3-Clause
"""The pose of one scan relative to another, without an initial pose.

usage: register_two_scans.py TARGET SOURCE
"""

import sys

import pcl6d

target, source = (pcl6d.read_scans(file)[0].points for file in sys.argv[1:3])
result = pcl6d.register(target=target, source=source)
print(result.status)  # unique: one pose fits, and no other
print(result.T_target_source)
sys.exit(0 if result.converged else 3)
