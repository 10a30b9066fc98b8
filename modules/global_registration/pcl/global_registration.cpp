// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/global_registration/pcl/global_registration.h>

namespace pcl6d {
PCL6D_DEFINE_PAIR_INSTANCES(GlobalRegistration)
} // namespace pcl6d
