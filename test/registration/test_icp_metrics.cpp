// SPDX-License-Identifier: BSD-3-Clause
// Truth, convergence and honest refusal of the metrics of ICP.
#include "icp_cases.h"
#include "support/constants.h"

using namespace pcl6d; // NOLINT: the whole API of ICP
using pcl6d::test::badArgumentOf;
using pcl6d::test::corner;
using pcl6d::test::kAllMetrics;
using pcl6d::test::kIdentity;
using pcl6d::test::kNan;
using pcl6d::test::kNudge;
using pcl6d::test::kPlaneMetrics;
using pcl6d::test::kTruth;
using pcl6d::test::optionsOf;
using pcl6d::test::rectangle;
using pcl6d::test::run;
using pcl6d::test::sameBits;
using pcl6d::test::Surface;

TEST(IcpMetrics, FindTheMotionBetweenCopies)
{
  Random random(1);
  const Surface target = corner(random, 3000, 4, 0.002);
  for (const Metric metric : kAllMetrics) {
    SCOPED_TRACE(toString(metric));
    const IcpResult result =
        run(target, target.moved(kTruth.inverse()), optionsOf(metric));
    EXPECT_EQ(result.status, Status::kOk);
    EXPECT_EQ(result.stop, IcpStop::kAtRest);
    const auto error = distanceBetween(kTruth, result.T_target_source);
    EXPECT_LT(error.translation, 2e-6); // copies; rounded to float
    EXPECT_LT(error.rotation, 2e-6);
    EXPECT_EQ(result.pairs, 3000u);
    EXPECT_EQ(result.overlap, 1);
    EXPECT_LT(result.residual, 1e-6);
  }
}

TEST(IcpMetrics, WithNormalsFindTheMotionOfOtherPointsOnTheSameSurfaces)
{
  // No point has a partner; the surfaces do: without noise they lie on one another. The
  // source stays clear of the edges, where partners are on the other wall.
  Random random(2);
  const Surface target = corner(random, 6000, 4);
  Surface source;
  for (int across = 0; across < 3; ++across) {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(0.5);
    low[across] = 0;
    source.add(rectangle(random, 1000, across, low, Eigen::Vector3d::Constant(3.5)));
  }
  source = source.moved(kTruth.inverse());
  for (const auto& name : planeMinimiserNames()) {
    IcpOptions options = optionsOf(Metric::kPlane);
    options.plane_minimiser = planeMinimiserFromName(name);
    const IcpResult result = run(target, source, options);
    EXPECT_EQ(result.status, Status::kOk);
    const auto error = distanceBetween(kTruth, result.T_target_source);
    EXPECT_LT(error.translation, 1e-6) << name; // rounding to float
    EXPECT_LT(error.rotation, 1e-6) << name;
  }
}

TEST(IcpMetrics, BothPlaneMinimisersEndAtTheSamePose)
{
  Random random(3);
  const Surface target = corner(random, 6000, 4, 0.01);
  const Surface source = corner(random, 3000, 4, 0.01).moved(kTruth.inverse());
  for (const Metric metric : kPlaneMetrics) {
    SCOPED_TRACE(toString(metric));
    IcpOptions helix = optionsOf(metric), linear = helix;
    helix.plane_minimiser = planeStepByHelix;
    linear.plane_minimiser = planeStepByLinear;
    const auto a = run(target, source, helix), b = run(target, source, linear);
    EXPECT_EQ(a.status, Status::kOk);
    EXPECT_EQ(b.status, Status::kOk);
    EXPECT_LT(distanceBetween(a.T_target_source, b.T_target_source).translation, 2e-4);
    EXPECT_LT(distanceBetween(kTruth, a.T_target_source).translation, 3e-3);
  }
}

TEST(IcpMetrics, WithNormalsNeedFarFewerIterationsOnLargePlanes)
{
  Random random(4);
  const Surface target = corner(random, 6000, 4, 0.003);
  const Surface source = corner(random, 3000, 4, 0.003).moved(kTruth.inverse());
  const IcpResult point = run(target, source, optionsOf(Metric::kPoint));
  for (const Metric metric : kPlaneMetrics) {
    const IcpResult result = run(target, source, optionsOf(metric));
    EXPECT_EQ(result.status, Status::kOk);
    EXPECT_LT(2 * result.iterations, point.iterations) << toString(metric);
    EXPECT_LT(distanceBetween(kTruth, result.T_target_source).translation,
              distanceBetween(kTruth, point.T_target_source).translation);
  }
}

TEST(IcpMetrics, WorkFarFromTheOrigin)
{
  Random random(5);
  const Eigen::Isometry3d far = poseFromEuler({5000, -4000, 100}, {0, 0, 2});
  const Surface here = corner(random, 6000, 4, 0.01), target = here.moved(far);
  const Surface source = corner(random, 3000, 4, 0.01);
  for (const Metric metric : kAllMetrics) {
    SCOPED_TRACE(toString(metric));
    const IcpResult result = run(target, source, optionsOf(metric), far * kNudge);
    EXPECT_NE(result.status, Status::kDiverged);
    const IcpResult near = run(here, source, optionsOf(metric), kNudge);
    const auto error =
        distanceBetween(far * near.T_target_source, result.T_target_source);
    EXPECT_LT(error.translation, 1e-3); // floats lie 0.5 mm apart there
    EXPECT_LT(error.rotation, 1e-3);
  }
}

TEST(IcpMetrics, RestAtOnceAtTheTruth)
{
  Random random(6);
  const Surface target = corner(random, 900, 2);
  for (const Metric metric : kAllMetrics)
    for (const double epsilon : {1e-5, 1e-12, 0.0}) {
      SCOPED_TRACE(testing::Message() << toString(metric) << " " << epsilon);
      IcpOptions options = optionsOf(metric);
      options.translation_epsilon = options.rotation_epsilon = epsilon;
      const IcpResult result = run(target, target, options);
      EXPECT_NE(result.status, Status::kDiverged);
      EXPECT_LT(distanceBetween(kIdentity, result.T_target_source).translation, 1e-6);
      if (epsilon > 0) {
        EXPECT_EQ(result.status, Status::kOk);
      }
    }
}

TEST(IcpMetrics, DoNotCallRoundingDivergence)
{
  // Thresholds below rounding are allowed: ICP then goes on at the solution.
  Random random(7);
  for (int trial = 0; trial < 20; ++trial) {
    const Surface target = corner(random, 300, 2);
    const Surface source = target.moved(kTruth.inverse());
    for (const Metric metric : kAllMetrics) {
      SCOPED_TRACE(testing::Message() << toString(metric) << ", trial " << trial);
      IcpOptions options = optionsOf(metric);
      options.translation_epsilon = options.rotation_epsilon = 0;
      const IcpResult result = run(target, source, options);
      EXPECT_NE(result.status, Status::kDiverged);
    }
  }
}

TEST(IcpMetrics, ThatSeePlanesNeedNormals)
{
  Random random(8);
  const Surface scene = corner(random, 300, 2);
  const PointTree tree(scene.points);
  const Normals few(10, {0, 0, 1});
  for (const Normals* bad : {static_cast<const Normals*>(nullptr), &few}) {
    const IcpTarget target{{&tree, &scene.points, bad}};
    const IcpTarget good{{&tree, &scene.points, &scene.normals}};
    const IcpSource source{&scene.points, &scene.normals};
    for (const Metric metric : kPlaneMetrics)
      EXPECT_NE(badArgumentOf([&] {
                  icp(target, source, kIdentity, optionsOf(metric));
                }).find("target normals = " + std::to_string(bad ? 10 : 0)),
                std::string::npos);
    EXPECT_NE(badArgumentOf([&] {
                icp(good, {&scene.points, bad}, kIdentity, optionsOf(Metric::kGicp));
              }).find("source normals"),
              std::string::npos);
    EXPECT_NO_THROW(
        icp(good, {&scene.points, bad}, kIdentity, optionsOf(Metric::kPlane)));
  }
}

TEST(IcpMetrics, RefuseNormalsOfAnotherNumberEvenIfNotNeeded)
{
  // With point to point, too: they would be read beyond their end.
  Random random(9);
  const Surface scene = corner(random, 300, 2);
  const PointTree tree(scene.points);
  const Normals few(10, {0, 0, 1});
  EXPECT_THROW(icp({{&tree, &scene.points, &few}},
                   {&scene.points},
                   kIdentity,
                   optionsOf(Metric::kPoint)),
               BadArgument);
}

TEST(IcpMetrics, PassOverPointsWithoutNormals)
{
  Random random(10);
  Surface target = corner(random, 3000, 4, 0.002);
  Surface source = target.moved(kTruth.inverse());
  for (std::size_t i = 0; i < target.normals.size(); i += 4)
    target.normals[i].setConstant(i % 8 ? kNan : 0);
  for (const Metric metric : kPlaneMetrics) {
    const IcpResult result = run(target, source, optionsOf(metric));
    EXPECT_EQ(result.status, Status::kOk) << toString(metric);
    EXPECT_LT(distanceBetween(kTruth, result.T_target_source).translation, 2e-6);
  }
  for (auto& n : target.normals)
    n.setZero();
  const IcpResult none = run(target, source, optionsOf(Metric::kPlane), kTruth);
  EXPECT_EQ(none.status, Status::kTooFewPairs);
  EXPECT_TRUE(sameBits(none.T_target_source, kTruth));
}
