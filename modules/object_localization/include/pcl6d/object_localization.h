// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module object_localization but its PCL classes, in
 * pcl6d/object_localization/pcl. Objects of known shape in 3D scans, with their poses in six
 * degrees of freedom. */
#include <pcl6d/object_localization/localization_scene.h>
#include <pcl6d/object_localization/localized_object.h>
#include <pcl6d/object_localization/model_store.h>
#include <pcl6d/object_localization/object_localizer.h>
#include <pcl6d/object_localization/object_model.h>
#include <pcl6d/object_localization/object_proposals.h>
#include <pcl6d/object_localization/object_symmetry.h>
#include <pcl6d/object_localization/oriented_points.h>
#include <pcl6d/object_localization/pair_features.h>
#include <pcl6d/object_localization/pose_covariance.h>
