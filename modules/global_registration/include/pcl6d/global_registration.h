// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module global_registration but its PCL classes, in
 * pcl6d/global_registration/pcl. Place recognition without an initial pose: of two scans, of
 * all scans of a folder, and of a scan in a finished map. */
#include <pcl6d/global_registration/compatible_pairs.h>
#include <pcl6d/global_registration/feature_scale.h>
#include <pcl6d/global_registration/map_localiser.h>
#include <pcl6d/global_registration/pair_memory.h>
#include <pcl6d/global_registration/pair_placer.h>
#include <pcl6d/global_registration/place_by_guesses.h>
#include <pcl6d/global_registration/place_in_map.h>
#include <pcl6d/global_registration/place_search.h>
#include <pcl6d/global_registration/placeable_scan.h>
#include <pcl6d/global_registration/scan_joiner.h>
#include <pcl6d/global_registration/vertical.h>
