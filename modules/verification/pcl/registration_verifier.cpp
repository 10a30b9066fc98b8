// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/verification/pcl/registration_verifier.h>

namespace pcl6d {
#define PCL6D_DEFINE_VERIFIER_(Class, PointT) template class Class<PointT, PointT>;
PCL6D_FOR_POINT_TYPES(PCL6D_DEFINE_VERIFIER_, RegistrationVerifier)
#undef PCL6D_DEFINE_VERIFIER_
} // namespace pcl6d
