// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/object_localization/pcl/object_localization.h>

#include <pcl/impl/pcl_base.hpp>

namespace pcl6d {
PCL6D_DEFINE_INSTANCES(ObjectLocalization)
} // namespace pcl6d
