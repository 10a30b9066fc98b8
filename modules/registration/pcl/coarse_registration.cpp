// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/registration/pcl/feature_alignment.h>
#include <pcl6d/registration/pcl/overlap_alignment.h>

namespace pcl6d {
PCL6D_DEFINE_PAIR_INSTANCES(FeatureAlignment)
PCL6D_DEFINE_PAIR_INSTANCES(OverlapAlignment)
} // namespace pcl6d
