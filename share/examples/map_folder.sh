#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Maps a folder of scans: poses, map, picture, and a page for a browser.
# usage: map_folder.sh SCAN_DIR OUT_DIR
set -eu
pcl_slam6d "$1" --output "$2" --report
