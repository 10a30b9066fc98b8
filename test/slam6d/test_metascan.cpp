// SPDX-License-Identifier: BSD-3-Clause
#include "matching/metascan.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/common/voxel_key.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <map>
#include <set>

using namespace pcl6d; // NOLINT: the whole API of ICP
using slam6d::Metascan;
using test::kInfinity;

namespace {
constexpr double kFine = 1e-4;      ///< [m] a voxel in which no two points meet
constexpr double kExtent = 4;       ///< [m] edge of the cube of a scan's points
constexpr std::size_t kPoints = 40; ///< of a scan

/** Scans at random poses with random normals, and the metascan over them. */
struct Scans {
  explicit Scans(double voxel,
                 int max_scans,
                 const Eigen::Vector3d& where = Eigen::Vector3d::Zero())
  : max_scans(max_scans), metascan(voxel, max_scans, options()), where(where)
  {}

  static IcpModel::Options
  options()
  {
    IcpModel::Options options;
    options.num_threads = 1;
    return options;
  }

  void
  add()
  {
    const Points points = test::randomCube(random, kPoints, kExtent);
    Normals normals;
    for (std::size_t i = 0; i < points.size(); ++i)
      normals.push_back(test::randomRotation(random, 2).col(0).cast<float>().eval());
    models.emplace_back(points, normals, options());
    Eigen::Isometry3d pose = test::randomPose(random, 5, 3);
    pose.translation() += where;
    add(models.back(), pose);
  }

  void
  add(const IcpModel& model, const Eigen::Isometry3d& pose)
  {
    poses.push_back(pose);
    members.push_back(&model);
    metascan.add(model, pose);
  }

  /** \return the first of the last scans that count */
  std::size_t
  begin() const
  {
    const std::size_t last = max_scans > 0 ? max_scans : members.size();
    return members.size() - std::min(members.size(), last);
  }

  /** \return the distance [m] of the nearest point of the last scans, looking at each */
  double
  nearest(const Eigen::Vector3d& query) const
  {
    double best = kInfinity;
    for (std::size_t i = begin(); i < members.size(); ++i)
      for (const auto& p : members[i]->points())
        best = std::min(best, (poses[i] * p.cast<double>() - query).norm());
    return best;
  }

  int max_scans;
  Random random{7};
  std::deque<IcpModel> models;
  std::vector<const IcpModel*> members;
  std::vector<Eigen::Isometry3d> poses;
  Metascan metascan;
  Eigen::Vector3d where;
};

/** \return the distance [m] of the nearest point of a target */
double
nearest(const IcpTarget& target, const Eigen::Vector3d& query)
{
  double best_sq = kInfinity;
  for (const auto& part : target) {
    const Eigen::Vector3f q = (part.T_target_part.inverse() * query).cast<float>();
    const Neighbour found = part.tree->nearest(q, kInfinity);
    if (found.index >= 0)
      best_sq = std::min<double>(best_sq, found.distance_sq);
  }
  return std::sqrt(best_sq);
}

std::size_t
countPoints(const IcpTarget& target)
{
  std::size_t count = 0;
  for (const auto& part : target)
    count += part.points->size();
  return count;
}

/** Expects the target to be the union of the last scans, no point more or less. */
void
expectUnion(Scans& scans, const Eigen::Vector3d& origin, double tolerance)
{
  const IcpTarget target = scans.metascan.around(origin);
  EXPECT_EQ(countPoints(target), (scans.members.size() - scans.begin()) * kPoints);
  Random random(scans.members.size());
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d query =
        scans.where + test::randomPose(random, 8, 0).translation();
    EXPECT_NEAR(nearest(target, query - origin), scans.nearest(query), tolerance);
  }
}
} // namespace

class MetascanOf : public testing::TestWithParam<int> {};

TEST_P(MetascanOf, IsTheUnionOfTheLastScans)
{
  Scans scans(kFine, GetParam());
  for (int count = 1; count <= 40; ++count) {
    SCOPED_TRACE(std::to_string(count) + " scans");
    scans.add();
    expectUnion(scans, {1, -2, 3}, 1e-5); // coordinates of 10 m in float
  }
}

TEST_P(MetascanOf, IsTheSameFarFromTheOrigin)
{
  // In float, coordinates of 5e6 m would be good to half a metre.
  const Eigen::Vector3d far(5e6 + 0.3, -4e6 + 0.7, 300);
  Scans scans(kFine, GetParam(), far);
  for (int count = 1; count <= 20; ++count) {
    SCOPED_TRACE(std::to_string(count) + " scans");
    scans.add();
    const Eigen::Vector3d origin = scans.poses.back().translation().array().round();
    expectUnion(scans, origin, 1e-5);
  }
}

TEST_P(MetascanOf, HasFewParts)
{
  Scans scans(kFine, GetParam());
  for (int count = 1; count <= 40; ++count) {
    scans.add();
    // At most two of each size: 1, 2, 4 up to 32 scans.
    const auto size = static_cast<double>(count - scans.begin());
    EXPECT_LE(scans.metascan.around({0, 0, 0}).size(), 2 * std::log2(size) + 1);
  }
}

TEST_P(MetascanOf, BuildsEachNodeOnce)
{
  // A part is known by its scans; scans by the height of their points.
  const auto scansOf = [](const IcpTargetPart& part) {
    std::set<int> scans;
    for (const auto& p : *part.points)
      scans.insert(
          static_cast<int>(std::lround((part.T_target_part * p.cast<double>()).z())));
    return scans;
  };
  std::deque<IcpModel> models;
  Scans scans(kFine, GetParam());
  std::map<std::set<int>, const PointTree*> trees;
  for (int i = 0; i < 40; ++i) {
    models.emplace_back(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, Scans::options());
    const double height = i;
    scans.add(models.back(), poseFromEuler({0, 0, height}, {0, 0, 0.1 * i}));
    for (int twice = 0; twice < 2; ++twice)
      for (const auto& part : scans.metascan.around({0, 0, 0})) {
        const auto [known, is_new] = trees.emplace(scansOf(part), part.tree);
        EXPECT_EQ(known->second, part.tree) << "of " << known->first.size() << " scans";
        EXPECT_TRUE(is_new || i > 0 || twice == 1);
      }
  }
}

INSTANTIATE_TEST_SUITE_P(LastScans,
                         MetascanOf,
                         testing::Values(1, 2, 3, 7, 10, 0),
                         [](const auto& info) {
                           return info.param > 0 ? std::to_string(info.param) : "all";
                         });

TEST(Metascan, IsEmptyWithoutAScan)
{
  EXPECT_TRUE(Scans(kFine, 0).metascan.around({0, 0, 0}).empty());
}

TEST(Metascan, TurnsTheNormalsWithTheScans)
{
  Scans scans(kFine, 0);
  for (int i = 0; i < 7; ++i) // nodes of four, of two and of one
    scans.add();
  const IcpTarget target = scans.metascan.around({1, 2, 3});
  ASSERT_EQ(target.size(), 3u);
  for (std::size_t i = 0; i < scans.members.size(); ++i)
    for (std::size_t k = 0; k < kPoints; ++k) {
      const Eigen::Vector3d p =
          scans.poses[i] * scans.members[i]->points()[k].cast<double>() -
          Eigen::Vector3d(1, 2, 3);
      const Eigen::Vector3d n =
          scans.poses[i].linear() * scans.members[i]->normals()[k].cast<double>();
      bool is_there = false;
      for (const auto& part : target) {
        const Eigen::Vector3f q = (part.T_target_part.inverse() * p).cast<float>();
        const Neighbour found = part.tree->nearest(q, 1e-8f);
        if (found.index < 0)
          continue;
        is_there = true;
        const Eigen::Vector3f& normal = (*part.normals)[found.index];
        EXPECT_LT((part.T_target_part.linear() * normal.cast<double>() - n).norm(),
                  1e-6);
      }
      EXPECT_TRUE(is_there) << "scan " << i << ", point " << k;
    }
}

TEST(Metascan, KeepsOnePointPerVoxelInANode)
{
  constexpr double kVoxel = 0.5; // [m]
  Scans scans(kVoxel, 0);
  for (int i = 0; i < 32; ++i)
    scans.add();
  const IcpTarget target = scans.metascan.around({0, 0, 0});
  ASSERT_EQ(target.size(), 1u);
  std::set<VoxelKey> voxels;
  for (const auto& p : *target[0].points)
    EXPECT_TRUE(voxels.insert(voxelKey(p, kVoxel)).second) << p.transpose();
  EXPECT_LT(voxels.size(), 32 * kPoints) << "some met";
  for (const auto& p : *target[0].points) // no point is made up
    EXPECT_LT(scans.nearest(target[0].T_target_part * p.cast<double>()), 1e-5);
  const double diagonal = std::sqrt(3) * kVoxel;
  for (std::size_t i = 0; i < 32; ++i) // none is lost by more than a voxel
    for (const auto& p : scans.members[i]->points())
      EXPECT_LT(nearest(target, scans.poses[i] * p.cast<double>()), diagonal);
}

TEST(Metascan, KeepsTheFirstScansPointInAVoxel)
{
  const IcpModel first({{0.1f, 0.1f, 0.1f}}, Scans::options());
  const IcpModel second({{0.2f, 0.1f, 0.1f}, {0.7f, 0.1f, 0.1f}}, Scans::options());
  Metascan metascan(0.5, 0, Scans::options());
  metascan.add(first, Eigen::Isometry3d::Identity());
  metascan.add(second, Eigen::Isometry3d::Identity());
  const IcpTarget target = metascan.around({0, 0, 0});
  ASSERT_EQ(target.size(), 1u);
  EXPECT_EQ(*target[0].points, (Points{{0.1f, 0.1f, 0.1f}, {0.7f, 0.1f, 0.1f}}));
}

TEST(Metascan, KeepsPointsBeyondItsGrid)
{
  constexpr double kVoxel = 0.1; // [m] the grid reaches 104857.6 m
  const Points wild = {{0, 0, 0}, {2e5f, 0, 0}, {0, -1e30f, 0}, {0, 0, 104857.5f}};
  const IcpModel scan(wild, Scans::options());
  Metascan metascan(kVoxel, 0, Scans::options());
  for (int i = 0; i < 2; ++i)
    metascan.add(scan, Eigen::Isometry3d::Identity());
  const IcpTarget target = metascan.around({0, 0, 0});
  ASSERT_EQ(target.size(), 1u);
  for (const auto& p : {wild[0], wild[1], wild[3]})
    EXPECT_EQ(target[0].tree->nearest(p, 1e-6f).distance_sq, 0) << p.transpose();
  EXPECT_EQ(std::count(target[0].points->begin(), target[0].points->end(), wild[2]), 2);
}

TEST(Metascan, HasTheSamePartsWhereverTheWorldsOriginIs)
{
  Scans near(0.5, 0), far(0.5, 0, {1e6, -2e6, 3e5}); // whole metres
  for (int i = 0; i < 8; ++i) {
    near.add();
    far.add();
  }
  const IcpTarget a = near.metascan.around({0, 0, 0});
  const IcpTarget b = far.metascan.around({1e6, -2e6, 3e5});
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a[0].points->size(), b[0].points->size()) << "the same voxels";
  for (std::size_t i = 0; i < a[0].points->size(); ++i)
    EXPECT_LT(((*a[0].points)[i] - (*b[0].points)[i]).norm(), 1e-5f);
}
