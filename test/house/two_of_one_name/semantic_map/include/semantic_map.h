// SPDX-License-Identifier: BSD-3-Clause
namespace PCL6D_EXPORTS pcl6d {
struct MapPlane {
  double offset = 0;
};
} // namespace pcl6d
