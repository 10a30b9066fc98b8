// SPDX-License-Identifier: BSD-3-Clause
// PCL's classes by the words of the command line.
#include "icp_cases.h"
#include "support/clouds.h"
#include "support/pcl_peers.h"
#include "support/points.h"

#include <pcl6d/registration/pcl/make.h>

#include <memory>

using namespace pcl6d; // NOLINT: the factories
using pcl6d::test::badArgumentOf;
using pcl6d::test::corner;
using pcl6d::test::Surface;
using pcl6d::test::toCloud;

namespace {
using Point = pcl::PointXYZ;
using Estimation = pcl::registration::TransformationEstimation<Point, Point, double>;

// Float storage of points within 3 m: half an ulp each; times 10.
constexpr double kTolerance =
    10 * 0.5 * 3 * double{std::numeric_limits<float>::epsilon()};

const Eigen::Isometry3d kMotion =
    poseFromEuler({0.04, -0.03, 0.02}, {0.02, -0.01, 0.015});

/** The corner of a room twice, the second time moved. */
struct TwoClouds {
  TwoClouds()
  {
    Random random(1);
    const Surface scene = corner(random, 3000, 2);
    target = toCloud<Point>(scene.moved(kMotion).points);
    source = toCloud<Point>(scene.points);
  }
  pcl::PointCloud<Point>::Ptr source, target;
};

template <typename Matrix>
void
expectMotion(const Matrix& found, double tolerance)
{
  const Eigen::Isometry3d pose(found.template cast<double>());
  const auto apart = distanceBetween(kMotion, pose);
  EXPECT_LT(apart.translation, tolerance);
  EXPECT_LT(apart.rotation, tolerance);
}

template <typename Class, typename Base>
bool
is(const std::shared_ptr<Base>& made)
{
  return dynamic_cast<const Class*>(made.get()) != nullptr;
}

/** \return the words that the message about an unknown one lists */
std::string
listOf(const std::vector<std::string>& names)
{
  std::string list;
  for (const auto& name : names)
    list += (list.empty() ? "must be " : "|") + name;
  return list;
}
} // namespace

TEST(Make, GivesEachMinimiserByItsWord)
{
  const TwoClouds clouds;
  for (const auto& name : minimiserNames()) {
    SCOPED_TRACE(name);
    const Estimation::Ptr made =
        makeTransformationEstimation<Point, Point, double>(name);
    Estimation::Matrix4 found;
    made->estimateRigidTransformation(*clouds.source, *clouds.target, found);
    expectMotion(found, kTolerance);
  }
  const auto helix = registration::make("helix");
  EXPECT_TRUE((is<TransformationEstimationHelix<Point, Point>>(helix)));
  const auto mixed =
      registration::make<pcl::PointXYZI, pcl::PointNormal, double>("svd");
  EXPECT_TRUE(
      (is<TransformationEstimationSVD<pcl::PointXYZI, pcl::PointNormal, double>>(
          mixed)));
}

TEST(Make, WordsAreThoseOfTheCommandLine)
{
  for (const std::string word : {"", "Helix", "plane", "quaternion-unconstrained"})
    EXPECT_NE(
        badArgumentOf([&] { registration::make(word); }).find(listOf(minimiserNames())),
        std::string::npos)
        << word;
  using Normal = pcl::PointNormal;
  const auto message =
      badArgumentOf([] { makePlaneTransformationEstimation<Normal, Normal>("svd"); });
  EXPECT_NE(message.find(listOf(planeMinimiserNames())), std::string::npos) << message;
  for (const auto& name : planeMinimiserNames())
    EXPECT_NE((makePlaneTransformationEstimation<Normal, Normal>(name)), nullptr);
  EXPECT_TRUE((is<TransformationEstimationPlaneHelix<Normal, Normal>>(
      makePlaneTransformationEstimation<Normal, Normal>("helix"))));
}

TEST(Make, GivesEachRegistrationByItsWord)
{
  const TwoClouds clouds;
  for (const auto& name : registrationNames()) {
    SCOPED_TRACE(name);
    const auto made = makeRegistration<Point, Point>(name);
    made->setInputSource(clouds.source);
    made->setInputTarget(clouds.target);
    const bool is_coarse = name == "overlap" || name == "features"; // of larger scenes
    if (!is_coarse)
      made->setMaxCorrespondenceDistance(0.5);
    pcl::PointCloud<Point> aligned;
    made->align(aligned);
    EXPECT_EQ(aligned.size(), clouds.source->size());
    if (!is_coarse) {
      EXPECT_TRUE(made->hasConverged());
      expectMotion(made->getFinalTransformation(), name == "ndt" ? 0.02 : 1e-3);
    }
  }
  EXPECT_TRUE((is<ICP6D<Point, Point>>(makeRegistration<Point, Point>("point"))));
  EXPECT_TRUE(
      (is<ICP6DWithNormals<Point, Point>>(makeRegistration<Point, Point>("plane"))));
  EXPECT_TRUE((is<GICP6D<Point, Point, double>>(
      makeRegistration<Point, Point, double>("gicp"))));
  EXPECT_TRUE((is<NDT6D<Point, Point>>(makeRegistration<Point, Point>("ndt"))));
  EXPECT_TRUE(
      (is<OverlapAlignment<Point, Point>>(makeRegistration<Point, Point>("overlap"))));
  EXPECT_TRUE(
      (is<FeatureAlignment<Point, Point>>(makeRegistration<Point, Point>("features"))));
  const auto message = badArgumentOf([] { makeRegistration<Point, Point>("icp"); });
  EXPECT_NE(message.find(listOf(registrationNames())), std::string::npos) << message;
  for (const auto& metric : metricNames())
    EXPECT_NE((makeRegistration<Point, Point>(metric)), nullptr);
}

TEST(Make, GivesEachSearchByItsWord)
{
  const TwoClouds clouds;
  const auto oracle = makeSearch<Point>("brute-force");
  oracle->setInputCloud(clouds.target);
  for (const auto& name : searchMethodNames()) {
    SCOPED_TRACE(name);
    const auto made = makeSearch<Point>(name);
    made->setInputCloud(clouds.target);
    for (std::size_t i = 0; i < clouds.source->size(); i += 100) {
      pcl::Indices found, expected;
      std::vector<float> found_sq, expected_sq;
      ASSERT_EQ(made->nearestKSearch((*clouds.source)[i], 3, found, found_sq), 3);
      oracle->nearestKSearch((*clouds.source)[i], 3, expected, expected_sq);
      if (name == "approximate") { // as --search: up to a tenth farther
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_LE(found_sq[k], 1.1f * 1.1f * expected_sq[k] * (1 + 1e-5f));
        continue;
      }
      EXPECT_EQ(found, expected);
      EXPECT_EQ(found_sq, expected_sq);
    }
  }
  EXPECT_TRUE(is<CachedKdTree<Point>>(makeSearch<Point>("cached-tree")));
  EXPECT_TRUE(is<OctreeSearch<Point>>(makeSearch<Point>("octree")));
  EXPECT_FALSE(is<KdTree<Point>>(makeSearch<Point>("flann"))) << "it is PCL's own";
  const auto message = badArgumentOf([] { makeSearch<Point>("annoy"); });
  EXPECT_NE(message.find(listOf(searchMethodNames())), std::string::npos) << message;
}

/** FLANN is an engine of ICP6D, too: no two points are equally near here. */
TEST(Make, IcpOfOursComesToTheSameBitsWithEachExactTree)
{
  const TwoClouds clouds;
  const auto motionBy = [&](const char* search) {
    ICP6D<Point, Point> icp;
    icp.setSearchMethodTarget(makeKdTree<Point>(search));
    icp.setInputSource(clouds.source);
    icp.setInputTarget(clouds.target);
    icp.setMaxCorrespondenceDistance(0.5);
    pcl::PointCloud<Point> aligned;
    icp.align(aligned);
    EXPECT_TRUE(icp.hasConverged()) << search;
    return icp.result().T_target_source;
  };
  const Eigen::Isometry3d expected = motionBy("kdtree");
  for (const char* const search : {"flann", "cached-tree", "remembered"})
    EXPECT_TRUE(test::sameBits(motionBy(search), expected)) << search;
}

/** PCL's own ICP with a minimiser and a search of ours, by name. */
TEST(Make, PartsWorkInsidePclsOwnIcp)
{
  const TwoClouds clouds;
  for (const char* const search : {"kdtree", "cached-tree", "remembered", "flann"}) {
    SCOPED_TRACE(search);
    pcl::IterativeClosestPoint<Point, Point> icp;
    icp.setTransformationEstimation(registration::make<Point, Point>("quaternion"));
    icp.setSearchMethodTarget(makeKdTree<Point>(search));
    icp.setInputSource(clouds.source);
    icp.setInputTarget(clouds.target);
    icp.setMaximumIterations(100);
    icp.setTransformationEpsilon(1e-12);
    pcl::PointCloud<Point> aligned;
    icp.align(aligned);
    expectMotion(icp.getFinalTransformation(), 1e-3);
  }
  for (const char* const search : {"octree", "brute-force"}) {
    const auto message = badArgumentOf([&] { makeKdTree<Point>(search); });
    EXPECT_NE(message.find("k-d tree"), std::string::npos) << message;
  }
}
