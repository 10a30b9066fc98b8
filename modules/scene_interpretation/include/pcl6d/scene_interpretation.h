// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module scene_interpretation but its PCL classes, in
 * pcl6d/scene_interpretation/pcl. Labels of planes (floor, wall, door, or your own rules), and
 * models with exact angles. */
#include <pcl6d/scene_interpretation/interpretation.h>
#include <pcl6d/scene_interpretation/label_rules.h>
#include <pcl6d/scene_interpretation/labelled_files.h>
#include <pcl6d/scene_interpretation/model_refinement.h>
#include <pcl6d/scene_interpretation/plane_finder.h>
#include <pcl6d/scene_interpretation/relations.h>
#include <pcl6d/scene_interpretation/scene_cloud.h>
#include <pcl6d/scene_interpretation/scene_plane.h>
