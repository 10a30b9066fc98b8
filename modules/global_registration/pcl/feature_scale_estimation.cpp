// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/global_registration/pcl/feature_scale_estimation.h>

namespace pcl6d {
PCL6D_DEFINE_INSTANCES(FeatureScaleEstimation)
} // namespace pcl6d
