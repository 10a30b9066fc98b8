// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/plane.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
const char*
toString(PlaneLabel label)
{
  return nameOf(kPlaneLabels, label, "none");
}

void
orientPlane(Plane& plane)
{
  constexpr double kThroughOrigin = 1e-12; // [m]
  bool turned = plane.offset < 0;
  if (std::abs(plane.offset) <= kThroughOrigin) {
    const auto first =
        std::find_if(plane.normal.data(), plane.normal.data() + 3, [](double value) {
          return std::abs(value) > 1e-12;
        });
    turned = first != plane.normal.data() + 3 && *first < 0;
  }
  if (turned) {
    plane.normal = -plane.normal;
    plane.offset = -plane.offset;
    std::reverse(plane.hull.begin(), plane.hull.end());
  }
  plane.normal.array() += 0.0; // no -0
  plane.offset = std::abs(plane.offset);
}

} // namespace pcl6d
