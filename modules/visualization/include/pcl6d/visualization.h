// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module visualization. Pictures of maps, the report of a run,
 * and the live view. */
#include <pcl6d/visualization/before_after_view.h>
#include <pcl6d/visualization/camera.h>
#include <pcl6d/visualization/camera_path.h>
#include <pcl6d/visualization/convergence_map.h>
#include <pcl6d/visualization/convergence_strip.h>
#include <pcl6d/visualization/height_cut.h>
#include <pcl6d/visualization/image.h>
#include <pcl6d/visualization/line_chart.h>
#include <pcl6d/visualization/live_view.h>
#include <pcl6d/visualization/map_cloud.h>
#include <pcl6d/visualization/map_overlays.h>
#include <pcl6d/visualization/map_view.h>
#include <pcl6d/visualization/overlay.h>
#include <pcl6d/visualization/plane_view.h>
#include <pcl6d/visualization/private_display.h>
#include <pcl6d/visualization/report.h>
#include <pcl6d/visualization/run_scenes.h>
#include <pcl6d/visualization/survey_report.h>
#include <pcl6d/visualization/top_view.h>
#include <pcl6d/visualization/top_view_layout.h>
