// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module run. The folder of a run of pcl_slam6d: written, read
 * and continued. */
#include <pcl6d/run/registered_scans.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/run/run_writer.h>
