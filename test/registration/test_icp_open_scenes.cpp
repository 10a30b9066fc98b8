// SPDX-License-Identifier: BSD-3-Clause
// Scenes that leave motions open: ICP must not call their pose fixed.
#include "icp_cases.h"
#include "support/constants.h"

using namespace pcl6d; // NOLINT: the whole API of ICP
using pcl6d::test::corner;
using pcl6d::test::kAllMetrics;
using pcl6d::test::kIdentity;
using pcl6d::test::kNudge;
using pcl6d::test::optionsOf;
using pcl6d::test::rectangle;
using pcl6d::test::run;
using pcl6d::test::Surface;

namespace {

/** \return the surface with normals estimated from its points */
Surface
estimated(const Surface& surface)
{
  IcpModel::Options options;
  options.normals = true;
  const IcpModel model(surface.points, options);
  return {surface.points, model.normals()};
}

Surface
wall(Random& random, std::size_t count, double sigma, const Eigen::Isometry3d& pose)
{
  return rectangle(random, count, 2, {-3, -3, 0}, {3, 3, 0}, sigma).moved(pose);
}

Surface
corridorOf(Random& random,
           std::size_t count,
           double sigma,
           const Eigen::Isometry3d& pose)
{
  Surface surface;
  for (const double side : {-1.0, 1.0})
    for (const int across : {1, 2}) {
      Eigen::Vector3d low(-3, -1, -1), high(3, 1, 1);
      low[across] = high[across] = side;
      surface.add(rectangle(random, count / 4, across, low, high, sigma));
    }
  return surface.moved(pose);
}

Surface
sphere(Random& random, double sigma, const Eigen::Vector3d& centre)
{
  Surface surface;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d n =
        Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    surface.add(centre + (2 + sigma * random.normal()) * n, n);
  }
  return surface;
}

const Eigen::Isometry3d kTilted = poseFromEuler({2, -3, 4}, {0.5, -0.4, 0.3});
} // namespace

class OpenScenes : public testing::TestWithParam<double> {
protected:
  /** Expects point to plane not to call the pose of a scene fixed. */
  void
  expectNotFixed(const Surface& target, const Surface& source)
  {
    for (const auto& name : planeMinimiserNames()) {
      IcpOptions options = optionsOf(Metric::kPlane);
      options.plane_minimiser = planeMinimiserFromName(name);
      const IcpResult result = run(target, source, options);
      EXPECT_TRUE(result.status == Status::kRankDeficient ||
                  result.status == Status::kMaxIterations)
          << name << ": " << toString(result.status);
      EXPECT_LT(distanceBetween(kIdentity, result.T_target_source).translation, 0.2);
    }
  }
  Random random_{11};
  const double sigma_ = GetParam(); ///< [m] of the points across the surface
};

TEST_P(OpenScenes, APlaneIsNotCalledFixed)
{
  const Surface target = wall(random_, 3000, sigma_, kTilted);
  const Surface source = wall(random_, 2000, sigma_, kTilted).moved(kNudge);
  expectNotFixed(target, source);
}

TEST_P(OpenScenes, APlaneWithEstimatedNormalsIsNotCalledFixed)
{
  const Surface target = estimated(wall(random_, 3000, sigma_, kTilted));
  const Surface source = wall(random_, 2000, sigma_, kTilted).moved(kNudge);
  expectNotFixed(target, source);
}

TEST_P(OpenScenes, ACorridorIsNotCalledFixed)
{
  const Surface target = corridorOf(random_, 3000, sigma_, kTilted);
  const Surface source = corridorOf(random_, 3000, sigma_, kTilted).moved(kNudge);
  expectNotFixed(target, source);
}

TEST_P(OpenScenes, ASphereIsNotCalledFixed)
{
  const Surface target = sphere(random_, sigma_, {3, 1, 2});
  const Surface source = sphere(random_, sigma_, {3, 1, 2}).moved(kNudge);
  expectNotFixed(target, source);
}

TEST_P(OpenScenes, GicpCallsNeitherFixed)
{
  // Its N is stiff by a thousandth along the planes, towards arbitrary partners: the
  // error along a corridor stays, and yet the normal equations are regular.
  for (const auto& scene : {wall, corridorOf}) {
    const Surface target = scene(random_, 3000, sigma_, kTilted);
    const Surface source = scene(random_, 2000, sigma_, kTilted).moved(kNudge);
    const IcpResult result = run(target, source, optionsOf(Metric::kGicp));
    EXPECT_NE(result.status, Status::kOk)
        << distanceBetween(kNudge.inverse(), result.T_target_source).translation
        << " m wrong";
  }
}

TEST_P(OpenScenes, CopiesThatRestAtOnceAreNotCalledFixed)
{
  for (const Surface& scene : {estimated(wall(random_, 3000, sigma_, kTilted)),
                               estimated(corridorOf(random_, 3000, sigma_, kTilted)),
                               estimated(sphere(random_, sigma_, {3, 1, 2}))}) {
    const IcpResult result = run(scene, scene, optionsOf(Metric::kPlane));
    EXPECT_EQ(result.stop, IcpStop::kAtRest);
    EXPECT_EQ(result.status, Status::kRankDeficient) << toString(result.status);
  }
}

TEST(IcpLocalizability, IsReportedWhateverTheMetric)
{
  Random random(12);
  const Surface box = corner(random, 3000, 4, 0.002);
  const Surface tube = corridorOf(random, 3000, 0.002, kTilted),
                again = corridorOf(random, 3000, 0.002, kTilted);
  for (const Metric metric : kAllMetrics) {
    SCOPED_TRACE(toString(metric));
    const IcpResult fixed = run(box, box, optionsOf(metric));
    ASSERT_TRUE(fixed.localizability);
    EXPECT_EQ(fixed.localizability->openDirections(), 0);
    const IcpResult open = run(tube, again, optionsOf(metric));
    ASSERT_TRUE(open.localizability);
    EXPECT_EQ(open.localizability->openDirections(), 1);
    const Eigen::Vector3d along = kTilted.linear().col(0);
    EXPECT_GT(std::abs(along.dot(open.localizability->directions.col(0).head<3>())),
              0.99);
  }
}

INSTANTIATE_TEST_SUITE_P(Noise, OpenScenes, testing::Values(0.0, 0.005));
