// SPDX-License-Identifier: BSD-3-Clause
#include "surfel_trust.h"

namespace pcl6d {

namespace {
constexpr float kSmooth = 1.5f;     // [sigma] rms of neighbours to their plane
constexpr float kLeastSpread = 3.f; // [roughness] or the patch is a line, not a plane
} // namespace

SurfelTrust::SurfelTrust(const PlaneCloud& cloud)
{
  const Surfels& surfels = cloud.surfels();
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    sigma.push_back(static_cast<float>(cloud.noise(surfels.members[surfels.begin[i]])));
    smooth.push_back(surfels.roughness[i] < kSmooth * sigma[i] &&
                     surfels.spread[i] > kLeastSpread * surfels.roughness[i] &&
                     !surfels.normals[i].isZero());
  }
}

} // namespace pcl6d
