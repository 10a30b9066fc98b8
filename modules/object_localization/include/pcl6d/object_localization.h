// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module object_localization but its PCL classes, in
 * pcl6d/object_localization/pcl. Objects of known shape in 3D scans, with their poses in six
 * degrees of freedom. */
#include <pcl6d/object_localization/boosting.h>
#include <pcl6d/object_localization/cascade_evaluator.h>
#include <pcl6d/object_localization/cascade_file.h>
#include <pcl6d/object_localization/cascade_training.h>
#include <pcl6d/object_localization/detection_proposals.h>
#include <pcl6d/object_localization/detection_views.h>
#include <pcl6d/object_localization/haar_cascade.h>
#include <pcl6d/object_localization/haar_features.h>
#include <pcl6d/object_localization/integral_image.h>
#include <pcl6d/object_localization/localization_scene.h>
#include <pcl6d/object_localization/localized_object.h>
#include <pcl6d/object_localization/model_store.h>
#include <pcl6d/object_localization/normal_orientation.h>
#include <pcl6d/object_localization/object_detector.h>
#include <pcl6d/object_localization/object_finder.h>
#include <pcl6d/object_localization/object_localizer.h>
#include <pcl6d/object_localization/object_model.h>
#include <pcl6d/object_localization/object_proposals.h>
#include <pcl6d/object_localization/object_symmetry.h>
#include <pcl6d/object_localization/oriented_points.h>
#include <pcl6d/object_localization/pair_features.h>
#include <pcl6d/object_localization/pose_check.h>
#include <pcl6d/object_localization/pose_clusters.h>
#include <pcl6d/object_localization/pose_covariance.h>
#include <pcl6d/object_localization/pose_votes.h>
#include <pcl6d/object_localization/scan_targets.h>
#include <pcl6d/object_localization/scene_surface.h>
#include <pcl6d/object_localization/target_names.h>
#include <pcl6d/object_localization/training_images.h>
#include <pcl6d/object_localization/upright_poses.h>
#include <pcl6d/object_localization/window_gate.h>
