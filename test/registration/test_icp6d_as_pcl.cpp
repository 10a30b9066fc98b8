// SPDX-License-Identifier: BSD-3-Clause
// "Change one class name": what users of pcl::IterativeClosestPoint rely on, with PCL's class
// beside ours where it shows what they expect.
#include "icp6d_cases.h"
#include "support/pcl_peers.h"

#include <pcl/point_representation.h>
#include <pcl/registration/transformation_estimation_svd_scale.h>

#include <functional>
#include <numeric>
#include <type_traits>

using namespace pcl6d::test;
using pcl6d::IcpStop;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::Status;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Icp = pcl6d::ICP6D<Point, Point>;
using Pcl = pcl::IterativeClosestPoint<Point, Point>;

Points
randomPoints(Random& random, std::size_t count, const Eigen::Vector3d& size)
{
  Points points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(Eigen::Vector3d(random.uniform(0, 1),
                                     random.uniform(0, 1),
                                     random.uniform(0, 1))
                         .cwiseProduct(size)
                         .cast<float>());
  return points;
}

/** Registers points with a moved copy of them. */
void
registerCopy(Icp& icp, const Points& points, const Eigen::Isometry3d& motion)
{
  icp.setInputTarget(toCloud<Point>(points));
  icp.setInputSource(toCloud<Point>(pcl6d::transformed(points, motion.inverse())));
  Cloud aligned;
  icp.align(aligned);
}

/** Walls of a room at the height 0, as a laser scanner of two dimensions sees them from a
 * place: x from -4 to 4; open: without the walls across. */
Points
flatScan(Random& random, const Eigen::Vector2d& place, double sigma, bool open)
{
  Points points;
  for (int i = 0; i < 720; ++i) {
    const double angle = (i + random.uniform(0, 1)) * M_PI / 360;
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    const double to_side = ((ray.y() > 0 ? 2 : -3) - place.y()) / ray.y();
    const double to_end = ((ray.x() > 0 ? 4 : -4) - place.x()) / ray.x();
    const double range = open ? to_side : std::min(to_side, to_end);
    if (range > 20)
      continue;
    const Eigen::Vector2d p = (range + sigma * random.normal()) * ray;
    points.emplace_back(p.x(), p.y(), 0);
  }
  return points;
}
} // namespace

TEST(Icp6DAsPcl, ConvergesOnTenExactPoints)
{
  int ours = 0, of_pcl = 0;
  for (int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const Points points = randomPoints(random, 10, {1, 1, 1});
    Icp icp;
    registerCopy(icp, points, kSmall);
    EXPECT_LT(icp.getFitnessScore(), 1e-12) << seed;
    ours += icp.hasConverged() ? 1 : 0;
    Pcl pcl;
    pcl.setInputTarget(toCloud<Point>(points));
    pcl.setInputSource(toCloud<Point>(pcl6d::transformed(points, kSmall.inverse())));
    Cloud aligned;
    pcl.align(aligned);
    of_pcl += pcl.hasConverged() ? 1 : 0;
  }
  EXPECT_EQ(of_pcl, 200);
  EXPECT_EQ(ours, 200);
}

TEST(Icp6DAsPcl, ConvergesOnMarkersInAPlane)
{
  for (const double sigma : {0.0, 0.002}) {
    Random random(1);
    Points points = randomPoints(random, 60, {3, 3, 0}), moved;
    for (const auto& p : points)
      moved.push_back((kSmall.inverse() * p.cast<double>() +
                       sigma * Eigen::Vector3d(random.normal(), random.normal(), 0))
                          .cast<float>());
    Icp icp;
    icp.setInputTarget(toCloud<Point>(points));
    icp.setInputSource(toCloud<Point>(moved));
    Cloud aligned;
    icp.align(aligned);
    EXPECT_TRUE(icp.hasConverged()) << sigma << ' ' << toString(icp.result().status);
    EXPECT_LT(pcl6d::distanceBetween(icp.result().T_target_source, kSmall).translation,
              1e-5 + 2 * sigma);
  }
}

TEST(Icp6DAsPcl, ConvergesOnScansOfTwoDimensionsThatFixThePose)
{
  for (const double sigma : {0.0, 0.005})
    for (const bool open : {false, true}) {
      Random random(2);
      const Points target = flatScan(random, {0, 0}, sigma, open);
      const Points source = flatScan(random, {0.05, -0.04}, sigma, open);
      Icp icp;
      icp.setInputTarget(toCloud<Point>(target));
      icp.setInputSource(toCloud<Point>(source));
      icp.setMaxCorrespondenceDistance(0.5);
      icp.setMaximumIterations(300);
      Cloud aligned;
      icp.align(aligned);
      EXPECT_EQ(icp.result().stop, IcpStop::kAtRest);
      EXPECT_EQ(icp.hasConverged(), !open)
          << sigma << ", " << (open ? "a corridor" : "a room") << ": "
          << icp.result().localizability->eigenvalues.transpose();
    }
}

TEST(Icp6DAsPcl, CallsTheIterationLimitConvergenceWhereAsked)
{
  Random random(3);
  const Points points = roomCorner(random, 2000, 4, 0.002);
  Icp icp;
  icp.setMaximumIterations(1); // a key press of PCL's tutorial interactive_icp
  registerCopy(icp, points, kSmall);
  EXPECT_FALSE(icp.hasConverged());
  icp.setIterationLimitConverges(true);
  registerCopy(icp, points, kSmall);
  EXPECT_TRUE(icp.hasConverged());
  EXPECT_EQ(icp.result().status, Status::kMaxIterations) << "says which it was";
  EXPECT_EQ(icp.result().stop, IcpStop::kIterationLimit);
}

TEST(Icp6DAsPcl, EstimatesTheScaleWherePclsEstimationDoes)
{
  Random random(4);
  const Points points = roomCorner(random, 2000, 4, 0);
  Points smaller = pcl6d::transformed(points, kSmall.inverse());
  for (auto& p : smaller)
    p *= 0.98f;
  using SvdScale = pcl::registration::TransformationEstimationSVDScale<Point, Point>;
  Icp icp;
  icp.setTransformationEstimation(pcl::make_shared<SvdScale>());
  icp.setMaxCorrespondenceDistance(0.5);
  icp.setInputTarget(toCloud<Point>(points));
  icp.setInputSource(toCloud<Point>(smaller));
  Cloud aligned;
  icp.align(aligned);
  EXPECT_TRUE(icp.hasConverged());
  EXPECT_NEAR(icp.result().scale, 1 / 0.98, 1e-5);
  const Eigen::Matrix3f linear = icp.getFinalTransformation().topLeftCorner<3, 3>();
  EXPECT_NEAR(std::cbrt(linear.determinant()), 1 / 0.98, 1e-5);
  EXPECT_LT((aligned[7].getVector3fMap() - points[7]).norm(), 1e-4);
}

namespace {
/** Makes what is no motion. */
struct Shearing : pcl::registration::TransformationEstimationSVD<Point, Point> {
  void
  estimateRigidTransformation(const Cloud&,
                              const Cloud&,
                              const pcl::Correspondences&,
                              Matrix4& found) const override
  {
    found.setIdentity();
    found(0, 1) = 0.1f;
  }
};
} // namespace

TEST(Icp6DAsPcl, RefusesAnEstimationThatMakesNoMotion)
{
  Random random(5);
  Icp icp;
  icp.setTransformationEstimation(pcl::make_shared<Shearing>());
  const std::string words =
      badArgumentOf([&] { registerCopy(icp, roomCorner(random, 500, 4, 0), kSmall); });
  EXPECT_NE(words.find("no motion"), std::string::npos) << words;
}

TEST(Icp6DAsPcl, IsNotCopiedAsPclsClassIsNot)
{
  static_assert(!std::is_copy_constructible<Pcl>::value, "PCL's");
  static_assert(!std::is_copy_constructible<Icp>::value, "ours");
  static_assert(!std::is_copy_assignable<pcl6d::GICP6D<Point, Point>>::value, "ours");
}

TEST(Icp6DAsPcl, KeepsTheLastIncrementOfTheMotion)
{
  Random random(6);
  const Points points = roomCorner(random, 2000, 4, 0.002);
  Icp icp;
  icp.setMaximumIterations(1);
  registerCopy(icp, points, kSmall);
  EXPECT_LT(
      (icp.getLastIncrementalTransformation() - icp.getFinalTransformation()).norm(),
      1e-6);
  Icp whole;
  registerCopy(whole, points, kSmall);
  EXPECT_TRUE(whole.hasConverged());
  const auto last = whole.getLastIncrementalTransformation();
  EXPECT_LT((last - Eigen::Matrix4f::Identity()).norm(), 1e-3) << "at rest";
  EXPECT_GT((whole.getFinalTransformation() - Eigen::Matrix4f::Identity()).norm(),
            0.02);
}

TEST(Icp6DAsPcl, TakesASmallerSourceBeforeItsIndices)
{
  Random random(7);
  const Points points = roomCorner(random, 900, 4, 0);
  const auto last = pcl::make_shared<pcl::Indices>(100);
  std::iota(last->begin(), last->end(), 800);
  Icp icp;
  icp.setInputTarget(toCloud<Point>(points));
  icp.setInputSource(toCloud<Point>(points));
  icp.setIndices(last);
  Cloud aligned;
  icp.align(aligned);
  EXPECT_EQ(aligned.size(), 100u);
  icp.setInputSource(toCloud<Point>(Points(points.begin(), points.begin() + 300)));
  EXPECT_NE(badArgumentOf([&] { icp.align(aligned); }).find("earlier source"),
            std::string::npos);
  const auto first = pcl::make_shared<pcl::Indices>(50);
  std::iota(first->begin(), first->end(), 0);
  icp.setIndices(first);
  icp.align(aligned);
  EXPECT_TRUE(icp.hasConverged());
  EXPECT_EQ(aligned.size(), 50u);
}

TEST(Icp6DAsPcl, RunsOnceWithoutIterationsAndFindsNothingWithinNoDistance)
{
  Random random(8);
  const Points points = roomCorner(random, 900, 4, 0);
  Icp icp;
  icp.setMaximumIterations(0);
  registerCopy(icp, points, kSmall);
  EXPECT_EQ(icp.result().iterations, 1);
  EXPECT_FALSE(icp.hasConverged());
  for (const double distance : {0.0, -1.0}) {
    icp.setMaxCorrespondenceDistance(distance);
    registerCopy(icp, points, kSmall);
    EXPECT_EQ(icp.result().status, Status::kTooFewPairs) << distance;
  }
}

TEST(Icp6DAsPcl, StopsByPclsEpsilons)
{
  Random random(9);
  const Points points = roomCorner(random, 2000, 4, 0.01);
  const Points others = roomCorner(random, 2000, 4, 0.01);
  const auto iterations = [&](auto change) {
    Icp icp;
    icp.setInputTarget(toCloud<Point>(points));
    icp.setInputSource(toCloud<Point>(pcl6d::transformed(others, kSmall.inverse())));
    icp.setMotionEpsilon(0, 0);
    change(icp);
    Cloud aligned;
    icp.align(aligned);
    return icp.result().iterations;
  };
  const int all = iterations([](Icp&) {});
  const int by_error =
      iterations([](Icp& icp) { icp.setEuclideanFitnessEpsilon(0.01); });
  const int by_motion =
      iterations([](Icp& icp) { icp.setTransformationEpsilon(1e-4); });
  EXPECT_LT(by_error, all);
  EXPECT_LT(by_motion, all);
  EXPECT_GT(by_error, 1);
}

TEST(Icp6DAsPcl, ShowsEachIterationToPclsCallback)
{
  Random random(10);
  const Points points = roomCorner(random, 500, 4, 0);
  Icp icp;
  icp.setInputTarget(toCloud<Point>(points));
  icp.setInputSource(toCloud<Point>(pcl6d::transformed(points, kSmall.inverse())));
  int calls = 0;
  double last = 1;
  std::function<void(
      const Cloud&, const pcl::Indices&, const Cloud&, const pcl::Indices&)>
      callback = [&](const Cloud& moved,
                     const pcl::Indices& of_source,
                     const Cloud& target,
                     const pcl::Indices& of_target) {
        EXPECT_EQ(moved.size(), 500u);
        EXPECT_EQ(of_source.size(), of_target.size());
        if (++calls > 1) {
          ASSERT_GT(of_source.size(), 100u);
          last = (moved[of_source[5]].getVector3fMap() -
                  target[of_target[5]].getVector3fMap())
                     .norm();
        }
      };
  ASSERT_TRUE(icp.registerVisualizationCallback(callback));
  Cloud aligned;
  icp.align(aligned);
  EXPECT_EQ(calls, 1 + icp.result().iterations) << "once when it is set, as in PCL";
  EXPECT_LT(last, 1e-5);
}

namespace {
/** x, y, z and how bright a point is, as the tutorial pairwise_incremental_registration
 * has it with the curvature. */
struct WithIntensity : pcl::PointRepresentation<pcl::PointXYZI> {
  WithIntensity() { nr_dimensions_ = 4; }
  void
  copyToFloatArray(const pcl::PointXYZI& p, float* out) const override
  {
    out[0] = p.x;
    out[1] = p.y;
    out[2] = p.z;
    out[3] = p.intensity;
  }
};
} // namespace

TEST(Icp6DAsPcl, SearchesByTheRepresentationOfPoints)
{
  using Bright = pcl::PointXYZI;
  // A row of posts with the brightness of each its own, moved by more than half their
  // spacing: each is nearest to the next one.
  pcl::PointCloud<Bright>::Ptr target(new pcl::PointCloud<Bright>),
      source(new pcl::PointCloud<Bright>);
  for (int i = 0; i < 320; ++i) {
    Bright p;
    p.x = 0.4f * static_cast<float>(i % 20);
    p.y = 0.7f * static_cast<float>(i / 20 % 4);
    p.z = 0.9f * static_cast<float>(i / 80);
    p.intensity = 10.f * static_cast<float>(i % 20);
    target->push_back(p);
    p.x += 0.25f;
    source->push_back(p);
  }
  const auto align = [&](auto&& icp) {
    icp.setInputTarget(target);
    icp.setInputSource(source);
    pcl::PointCloud<Bright> aligned;
    icp.align(aligned);
    return std::abs(icp.getFinalTransformation()(0, 3) + 0.25f);
  };
  const auto representation = pcl::make_shared<WithIntensity>();
  pcl6d::ICP6D<Bright, Bright> plain, bright;
  EXPECT_GT(align(plain), 0.01) << "so it is needed";
  bright.setPointRepresentation(representation);
  EXPECT_LT(align(bright), 1e-4);
  EXPECT_TRUE(bright.hasConverged());
  EXPECT_LT(bright.getFitnessScore(), 1e-8);
}
