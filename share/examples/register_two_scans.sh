#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The pose of one scan relative to another, without an initial pose.
# usage: register_two_scans.sh TARGET SOURCE
set -eu
pcl_slam6d_evaluate place "$1" "$2"
