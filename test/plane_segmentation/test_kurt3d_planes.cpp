// SPDX-License-Identifier: BSD-3-Clause
// The dominant planes of a recorded scan, listed by hand in test/data.
#include "support/data_folder.h"
#include "support/folders.h"

#include <pcl6d/filters/pcl/range_gate.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace {
constexpr double kMaxAngle = M_PI / 180; // [rad]
constexpr double kMaxDistance = 0.03;    // [m]
constexpr double kNear = 0.3;            // [m] from the middle to the next point
constexpr double kNoReturn = 32.7,
                 kSelf = 0.15; // [m] ranges that are none, as its README tells

Eigen::Vector3d
toVector(const nlohmann::json& numbers)
{
  return {numbers.at(0).get<double>(),
          numbers.at(1).get<double>(),
          numbers.at(2).get<double>()};
}

bool
hasPointNear(const pcl6d::PlaneSegment& segment,
             const pcl6d::Points& points,
             const Eigen::Vector3d& place)
{
  return std::any_of(
      segment.points.begin(), segment.points.end(), [&](std::uint32_t i) {
        return (points[i].cast<double>() - place).norm() < kNear;
      });
}

class Kurt3dPlanes : public testing::TestWithParam<pcl6d::PlaneMethod> {};

TEST_P(Kurt3dPlanes, AreFound)
{
  PCL6D_DATA_OR_SKIP(folder, "kurt3d");
  const pcl6d::Points points =
      pcl6d::gateByRange(pcl6d::ScanFolder(folder).read(1).points, kSelf, kNoReturn);
  const auto found = pcl6d::segmentPlanes(pcl6d::PlaneCloud(points), GetParam());
  std::ifstream file(PCL6D_SOURCE_DIR "/test/data/kurt3d_planes.json");
  const auto listed = nlohmann::json::parse(file).at("planes");
  ASSERT_GE(listed.size(), 6u);
  for (const auto& truth : listed) {
    const Eigen::Vector3d normal = toVector(truth.at("normal"));
    const Eigen::Vector3d middle = toVector(truth.at("middle"));
    const auto matches = [&](const pcl6d::PlaneSegment& segment) {
      const pcl6d::Plane& plane = segment.plane;
      return plane.normal.cross(normal).norm() < std::sin(kMaxAngle) &&
             std::abs(plane.normal.dot(middle) - plane.offset) < kMaxDistance &&
             hasPointNear(segment, points, middle);
    };
    EXPECT_TRUE(std::any_of(found.planes.begin(), found.planes.end(), matches))
        << truth.at("name");
  }
}

INSTANTIATE_TEST_SUITE_P(Methods,
                         Kurt3dPlanes,
                         testing::Values(pcl6d::PlaneMethod::kRegionGrowing,
                                         pcl6d::PlaneMethod::kRansac,
                                         pcl6d::PlaneMethod::kHough),
                         [](const auto& method) {
                           std::string name = pcl6d::toString(method.param);
                           name.erase(std::remove(name.begin(), name.end(), '-'),
                                      name.end());
                           return name;
                         });
} // namespace
