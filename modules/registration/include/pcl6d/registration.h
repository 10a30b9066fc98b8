// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module registration but its PCL classes, in
 * pcl6d/registration/pcl. ICP and coarse alignment of two scans, minimisers, and covariances of
 * links. */
#include <pcl6d/registration/coarse_estimate.h>
#include <pcl6d/registration/feature_alignment.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/registration/icp_options.h>
#include <pcl6d/registration/linear_minimiser.h>
#include <pcl6d/registration/localizability.h>
#include <pcl6d/registration/minimisers.h>
#include <pcl6d/registration/ndt.h>
#include <pcl6d/registration/overlap_search.h>
#include <pcl6d/registration/pair_sums.h>
#include <pcl6d/registration/plane_minimiser.h>
#include <pcl6d/registration/plane_sums.h>
#include <pcl6d/registration/pose_information.h>
#include <pcl6d/registration/rigid_minimiser.h>
#include <pcl6d/registration/twist.h>
