// SPDX-License-Identifier: BSD-3-Clause
// What one_name.sh is for: with the other file of this folder, two things of one name.
namespace pcl6d {
struct MapPlane {
  int support = 0;
};
} // namespace pcl6d
