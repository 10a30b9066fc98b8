#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The planes of a scan, with labels: floor, ceiling, wall, door.
# usage: find_planes.sh SCAN OUT_DIR
set -eu
pcl_slam6d_planes "$1" --output "$2"
