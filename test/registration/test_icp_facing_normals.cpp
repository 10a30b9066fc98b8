// SPDX-License-Identifier: BSD-3-Clause
// The two faces of a wall, seen from both its sides, are not one surface.
#include "icp_cases.h"
#include "support/constants.h"

using namespace pcl6d; // NOLINT: the whole API of ICP
using pcl6d::test::kIdentity;
using pcl6d::test::rectangle;
using pcl6d::test::Surface;

namespace {

/** \return a rectangle whose normals point along the axis across it */
Surface
facing(Random& random,
       int across,
       const Eigen::Vector3d& low,
       const Eigen::Vector3d& high,
       const Eigen::Vector3d& normal)
{
  Surface surface = rectangle(random, 1500, across, low, high, 0.002);
  for (auto& n : surface.normals)
    n = normal.cast<float>();
  return surface;
}

/** \return floor, a side wall and a pillar, which both scans see, and the near face of a
 * wall of 0.1 m, which each sees from its own side */
Surface
roomSeenFrom(double side, std::uint64_t seed)
{
  Random random(seed);
  Surface room = facing(random, 2, {-3, -2, 0}, {3, 2, 0}, {0, 0, 1});
  room.add(facing(random, 1, {-3, 2, 0}, {3, 2, 2}, {0, -1, 0}));
  const double face = side < 0 ? 0 : 0.1;
  for (int i = 0; i < 3; ++i) // large beside the pillar
    room.add(facing(random, 0, {face, -2, 0}, {face, 1, 2}, {side, 0, 0}));
  room.add(facing(random, 0, {3, -2, 0}, {3, -1, 2}, {-1, 0, 0}));
  return room;
}

IcpResult
across(bool facing_normals, unsigned int num_threads = 1)
{
  const Surface target = roomSeenFrom(-1, 1), source = roomSeenFrom(1, 2);
  const IcpModel model = target.model(), data = source.model();
  IcpOptions options;
  options.metric = Metric::kGicp;
  options.facing_normals = facing_normals;
  options.num_threads = num_threads;
  return icp({model.part()}, data.source(), kIdentity, options);
}
} // namespace

TEST(IcpFacingNormals, KeepTheFacesOfAWallApart)
{
  const IcpResult result = across(true);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_LT(result.T_target_source.translation().norm(), 0.002);
  EXPECT_LT(across(true).overlap, 0.7) << "the wall has no partners";
}

TEST(IcpFacingNormals, AreNotAskedForByDefault)
{
  // Normals of other programs may point either way.
  EXPECT_FALSE(IcpOptions().facing_normals);
  EXPECT_GT(std::abs(across(false).T_target_source.translation().x()), 0.03)
      << "else the scene shows nothing";
}

TEST(IcpFacingNormals, GiveTheSameBitsForAnyNumberOfThreads)
{
  const IcpResult one = across(true);
  for (const unsigned int threads : {2u, 8u})
    EXPECT_EQ(across(true, threads).T_target_source.matrix(),
              one.T_target_source.matrix());
}
