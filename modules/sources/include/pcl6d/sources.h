// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module sources. Where scans come from: folders, E57 and PTX
 * files, recordings of robots, lists of files. */
#include <pcl6d/sources/bag.h>
#include <pcl6d/sources/bag_source.h>
#include <pcl6d/sources/coordinate_system.h>
#include <pcl6d/sources/e57_poses.h>
#include <pcl6d/sources/e57_source.h>
#include <pcl6d/sources/e57_writer.h>
#include <pcl6d/sources/file_list_source.h>
#include <pcl6d/sources/folder_source.h>
#include <pcl6d/sources/open_source.h>
#include <pcl6d/sources/ptx_source.h>
#include <pcl6d/sources/trajectory_bag.h>
