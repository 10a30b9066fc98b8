// SPDX-License-Identifier: BSD-3-Clause
// The whole of book 6.4 on a part of the simulated campus, whose truth is known.
#include "support/constants.h"

#include <pcl6d/benchmarking/map_justification.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/localisation/levelling.h>
#include <pcl6d/localisation/segment_cut.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/simulation/scene_truth.h>
#include <pcl6d/simulation/simulator.h>

#include <gtest/gtest.h>

using pcl6d::test::kDegree;

using namespace pcl6d;

namespace {

/** The first 250 m of the drive through the campus, localised. */
class Campus {
public:
  static constexpr std::size_t kScans = 80;

  Campus() : simulator_(scene(), options())
  {
    std::vector<Plane> planes =
        scenePlanes(simulator_.scene().scene(), simulator_.sceneFromWorld());
    for (auto& plane : planes)
      plane.inliers = 1;
    R_map_world = levelOfPlanes(planes);
    map.emplace(wallsOf(planes, R_map_world));
    MonteCarloLocalisation filter(*map, truth(0));
    for (std::size_t i = 0; i < kScans; ++i) {
      const Points points = scan(i).points;
      levels.push_back(levelByWalls(points).R_level_source);
      Eigen::Vector3d motion(0, 0, 0);
      if (i > 0)
        motion = planarMotion(simulator_.odometry().poses[i - 1].inverse() *
                                  simulator_.odometry().poses[i],
                              levels[i - 1],
                              levels[i]);
      estimates.push_back(filter.addScan(motion, virtualScan(points, levels[i])));
    }
  }

  /** \return x, y, yaw */
  Eigen::Vector3d
  truth(std::size_t i) const
  {
    const Eigen::Isometry3d& T = simulator_.truth().poses[i];
    const Eigen::Vector3d place = R_map_world * T.translation();
    return {place.x(), place.y(), eulerFromRotation(R_map_world * T.linear()).yaw};
  }

  JustificationScan
  scan(std::size_t i) const
  {
    JustificationScan scan{toPoints(simulator_.scan(i)),
                           i < levels.size() ? levels[i] : Eigen::Matrix3d::Identity()};
    return scan;
  }

  Eigen::Matrix3d R_map_world;
  std::optional<SegmentMap> map;
  std::vector<Eigen::Matrix3d> levels;
  std::vector<MclEstimate> estimates;

private:
  static const SimulationScene&
  scene()
  {
    static const SimulationScene scene = builtInScene("campus");
    return scene;
  }

  static SimulationOptions
  options()
  {
    SimulationOptions options;
    options.num_scans = 300;
    const ScannerPreset preset = scannerByName("rotating");
    options.scanner = preset.scanner;
    options.range = preset.range;
    options.range.max_range = scene().max_range;
    return options;
  }
  Simulator simulator_;
};

const Campus&
campus()
{
  static const Campus campus;
  return campus;
}
} // namespace

TEST(LocalisationOnCampus, IsRightWhereItIsTrusted)
{
  std::size_t trusted = 0;
  double sum_sq = 0, yaw_sum_sq = 0;
  for (std::size_t i = 0; i < Campus::kScans; ++i) {
    if (!campus().estimates[i].trusted())
      continue;
    ++trusted;
    const Eigen::Vector3d error = campus().estimates[i].pose - campus().truth(i);
    sum_sq += error.head<2>().squaredNorm();
    yaw_sum_sq += wrapAngle(error.z()) * wrapAngle(error.z());
  }
  EXPECT_GE(trusted, Campus::kScans - 4);
  const double rms = std::sqrt(sum_sq / static_cast<double>(trusted));
  const double yaw_rms = std::sqrt(yaw_sum_sq / static_cast<double>(trusted));
  EXPECT_LT(rms, 0.1); // [m] what a reference must keep (book 6.4.2)
  EXPECT_LT(yaw_rms, 0.5 * kDegree);
  RecordProperty("rms_mm", static_cast<int>(1000 * rms));
  RecordProperty("yaw_mdeg", static_cast<int>(1000 * yaw_rms / kDegree));
}

TEST(LocalisationOnCampus, IsJustifiedByIcpAgainstTheExtrudedMap)
{
  std::vector<MclEstimate> some(campus().estimates.begin(),
                                campus().estimates.begin() + 6);
  some[3].doubt = MclDoubt::kSpread;
  std::vector<std::size_t> asked;
  const auto rows = justifyByIcp(*campus().map, some, [&](std::size_t i) {
    asked.push_back(i);
    return campus().scan(i);
  });
  EXPECT_EQ(asked, (std::vector<std::size_t>{0, 1, 2, 4, 5}))
      << "trusted ones, in order";
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].method, "map");
  EXPECT_EQ(rows[1].method, "metascan + map");
  EXPECT_EQ(rows[2].method, "map, no ground");
  for (const auto& row : rows) {
    EXPECT_EQ(row.position.count + row.failed, 5u) << row.method;
    EXPECT_LT(row.position.rms, 0.3)
        << row.method; // the book's sigma on recorded scans
    EXPECT_LT(row.yaw.rms, 1.24 * kDegree) << row.method;
  }
  EXPECT_TRUE(justifyByIcp(
                  *campus().map,
                  some,
                  [](std::size_t) { return JustificationScan(); },
                  {},
                  [](std::size_t, std::size_t) { return false; })
                  .empty());
}

TEST(Extruded, IsAGridOverEverySegment)
{
  const SegmentMap map({{{1, 2}, {2, 2}}});
  const Points points = extruded(map, {});
  EXPECT_EQ(points.size(), 5u * 41u);
  for (const auto& p : points) {
    EXPECT_EQ(p.y(), 2);
    EXPECT_TRUE(p.x() >= 1 && p.x() <= 2 && p.z() >= 0 && p.z() <= 10);
    EXPECT_EQ(std::remainder(p.x(), 0.25F), 0);
    EXPECT_EQ(std::remainder(p.z(), 0.25F), 0);
  }
  for (const auto& spoil : std::vector<void (*)(JustificationOptions&)>{
           [](auto& o) { o.high = o.low; },
           [](auto& o) { o.spacing = 0; },
           [](auto& o) { o.voxel = -1; },
           [](auto& o) { o.metascan = 0; },
           [](auto& o) { o.icp.max_distance = 0; }}) {
    JustificationOptions options;
    spoil(options);
    EXPECT_THROW(extruded(map, options), BadArgument);
  }
}
