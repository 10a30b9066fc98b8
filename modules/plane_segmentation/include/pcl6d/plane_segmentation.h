// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module plane_segmentation but its PCL classes, in
 * pcl6d/plane_segmentation/pcl. Planes in 3D scans by RANSAC, Hough transform and region
 * growing, with hulls. */
#include <pcl6d/plane_segmentation/consensus_points.h>
#include <pcl6d/plane_segmentation/noise_model.h>
#include <pcl6d/plane_segmentation/plane_cloud.h>
#include <pcl6d/plane_segmentation/plane_consensus.h>
#include <pcl6d/plane_segmentation/plane_finishing.h>
#include <pcl6d/plane_segmentation/plane_hough.h>
#include <pcl6d/plane_segmentation/plane_ransac.h>
#include <pcl6d/plane_segmentation/plane_region_growing.h>
#include <pcl6d/plane_segmentation/plane_segment.h>
#include <pcl6d/plane_segmentation/segment_planes.h>
#include <pcl6d/plane_segmentation/surfels.h>
