// SPDX-License-Identifier: BSD-3-Clause
// What holds for every detector that draws or votes.
#include "plane_scenes.h"

#include <pcl6d/common/error.h>
#include <pcl6d/plane_segmentation/plane_hough.h>
#include <pcl6d/plane_segmentation/plane_ransac.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

namespace {
using pcl6d::PlaneCandidates;
using pcl6d::PlaneCloud;
using pcl6d::Points;
using pcl6d::Random;

struct Detector {
  std::string name;
  std::function<PlaneCandidates(const PlaneCloud&, std::uint64_t seed)> find;
};

void
PrintTo(const Detector& detector, std::ostream* out)
{
  *out << detector.name;
}

Detector
hough(const std::string& name, pcl6d::HoughVariant variant)
{
  return {name, [variant](const PlaneCloud& cloud, std::uint64_t seed) {
            pcl6d::HoughPlaneOptions options;
            options.variant = variant;
            options.seed = seed;
            return pcl6d::houghCandidates(cloud, options);
          }};
}

Detector
ransac()
{
  return {"Ransac", [](const PlaneCloud& cloud, std::uint64_t seed) {
            pcl6d::RansacPlaneOptions options;
            options.seed = seed;
            return pcl6d::ransacCandidates(cloud, options);
          }};
}

/** \return the unit normal of the least squares plane of some points */
Eigen::Vector3d
fittedNormal(const PlaneCloud& cloud, const std::vector<std::uint32_t>& places)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto i : places)
    mean += cloud.points()[i].cast<double>() / static_cast<double>(places.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto i : places) {
    const Eigen::Vector3d d = cloud.points()[i].cast<double>() - mean;
    scatter += d * d.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
}

class Detectors : public testing::TestWithParam<Detector> {
protected:
  PlaneCandidates
  find(const Points& points, unsigned int num_threads = 1) const
  {
    return GetParam().find(PlaneCloud(points, num_threads), 1);
  }
};

// The cube of check C26: 3000 points a face, evenly within 5 cm of it.
constexpr std::size_t kFacePoints = 3000;
constexpr double kFaceNoise = 0.05; // [m]
/** Of a face; the rest, near an edge or in a rough place, is left to finishPlanes(). */
constexpr double kSmoothShare = 0.6;

TEST_P(Detectors, FindTheSixFacesOfANoisyCube)
{
  const PlaneCloud cloud(pcl6d::test::noisyCube(4, kFacePoints, kFaceNoise, 5), 1);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const PlaneCandidates planes = GetParam().find(cloud, seed);
    ASSERT_EQ(planes.size(), 6u);
    std::set<std::size_t> faces;
    for (const auto& plane : planes) {
      const std::size_t face = plane[plane.size() / 2] / kFacePoints;
      faces.insert(face);
      const auto axis = static_cast<int>(face / 2);
      const double cosine = std::abs(fittedNormal(cloud, plane)[axis]);
      EXPECT_LT(std::acos(std::min(1.0, cosine)), 0.16 * M_PI / 180) << "face " << face;
      EXPECT_GT(plane.size(), kSmoothShare * kFacePoints);
    }
    EXPECT_EQ(faces.size(), 6u);
  }
}

TEST_P(Detectors, GiveEachPointToOnePlaneAtMost)
{
  const Points points = pcl6d::test::noisyCube(4, kFacePoints, kFaceNoise, 5);
  std::vector<int> planes_of(points.size(), 0);
  for (const auto& plane : find(points)) {
    EXPECT_TRUE(std::is_sorted(plane.begin(), plane.end()));
    for (const auto i : plane)
      ++planes_of.at(i);
  }
  EXPECT_EQ(*std::max_element(planes_of.begin(), planes_of.end()), 1);
}

TEST_P(Detectors, GiveTheSamePlanesForAnyNumberOfThreads)
{
  const Points points = pcl6d::test::noisyCube(4, kFacePoints, kFaceNoise, 5);
  const PlaneCandidates one = find(points, 1);
  for (const unsigned int threads : {2u, 8u})
    EXPECT_EQ(find(points, threads), one);
}

TEST_P(Detectors, FindAllOfASinglePlane)
{
  Points points;
  Random random(1);
  pcl6d::test::addRectangle(
      points, {1, -2, -1}, {0.5, 4, 0}, {0, 0.2, 3}, 5000, 0.01, random);
  const PlaneCandidates planes = find(points);
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_GT(planes[0].size(), 0.99 * 5000);
}

TEST_P(Detectors, PartWhatIsNotConnected)
{
  Points points;
  Random random(1);
  for (const double y : {-3.0, 1.0})
    pcl6d::test::addRectangle(
        points, {2, y, -1}, {0, 2, 0}, {0, 0, 2}, 3000, 0.01, random);
  const PlaneCandidates planes = find(points);
  ASSERT_EQ(planes.size(), 2u);
  for (const auto& plane : planes)
    EXPECT_EQ(plane.front() / 3000, plane.back() / 3000);
}

TEST_P(Detectors, KeepADoorApartFromTheWallBehind)
{
  Points points;
  Random random(1);
  pcl6d::test::addRectangle(
      points, {2, -2, -1}, {0, 2, 0}, {0, 0, 2.5}, 4000, 0.005, random);
  pcl6d::test::addRectangle(
      points, {1.92, 0.1, -1}, {0, 1, 0}, {0, 0, 2}, 2000, 0.005, random);
  const PlaneCandidates planes = find(points);
  ASSERT_EQ(planes.size(), 2u);
  for (const auto& plane : planes) {
    const auto of_wall = std::count_if(
        plane.begin(), plane.end(), [](std::uint32_t i) { return i < 4000; });
    EXPECT_TRUE(of_wall == 0 || of_wall == static_cast<std::ptrdiff_t>(plane.size()));
  }
}

TEST_P(Detectors, FindAPlateInClutterAndNothingElse)
{
  Points points;
  Random random(1);
  pcl6d::test::addRectangle(
      points, {2, 0, 0}, {0.3, 0.5, 0}, {0, 0, 0.5}, 500, 0.005, random);
  for (int i = 0; i < 10000; ++i)
    points.push_back(Eigen::Vector3d(random.uniform(-5, 5),
                                     random.uniform(-5, 5),
                                     random.uniform(-5, 5))
                         .cast<float>());
  const PlaneCandidates planes = find(points);
  ASSERT_EQ(planes.size(), 1u);
  const auto of_plate = std::count_if(
      planes[0].begin(), planes[0].end(), [](std::uint32_t i) { return i < 500; });
  EXPECT_GT(of_plate, 400);
  EXPECT_LT(planes[0].size(), 1.03 * static_cast<double>(of_plate)); // in a surfel
}

TEST_P(Detectors, FindNoPlaneOnASphere)
{
  for (const double radius : {0.5, 1.0, 3.0})
    EXPECT_TRUE(find(pcl6d::test::sphere(radius, 10000, 1)).empty()) << radius << " m";
}

TEST_P(Detectors, FindNoPlaneInFewPointsOnALineOrInNoPoints)
{
  EXPECT_TRUE(find({}).empty());
  EXPECT_TRUE(find({{1, 0, 0}, {1, 1, 0}}).empty());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(find(Points(1000, {nan, nan, nan})).empty());
  EXPECT_TRUE(find(Points(1000, {1, 2, 3})).empty()); // all in one place
  Points line;
  for (int i = 0; i < 1000; ++i)
    line.emplace_back(0.01f * static_cast<float>(i), 1.f, 2.f);
  EXPECT_TRUE(find(line).empty());
}

TEST_P(Detectors, WorkFarFromTheOrigin)
{
  Points points = pcl6d::test::noisyCube(4, kFacePoints, 0.01, 5);
  pcl6d::PlaneCloudOptions options;
  options.viewpoint = {9000, -9000, 100}; // float: 1 mm
  for (auto& point : points)
    point += options.viewpoint;
  EXPECT_EQ(GetParam().find(PlaneCloud(points, options), 1).size(), 6u);
}

INSTANTIATE_TEST_SUITE_P(
    All,
    Detectors,
    testing::Values(ransac(),
                    hough("HoughRandomized", pcl6d::HoughVariant::kRandomized),
                    hough("HoughProbabilistic", pcl6d::HoughVariant::kProbabilistic),
                    hough("HoughStandard", pcl6d::HoughVariant::kStandard),
                    hough("HoughAdaptive", pcl6d::HoughVariant::kAdaptive),
                    hough("HoughProgressive", pcl6d::HoughVariant::kProgressive)),
    [](const auto& detector) { return detector.param.name; });

template <typename Options, typename Value>
void
expectRefused(Value Options::*field, Value value)
{
  Options options;
  options.*field = value;
  EXPECT_THROW(options.validate(), pcl6d::BadArgument) << value;
}

TEST(RansacPlaneOptions, NameWhatBreaksItsRule)
{
  using Options = pcl6d::RansacPlaneOptions;
  EXPECT_NO_THROW(Options().validate());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan}) {
    expectRefused(&Options::max_plane_distance, bad);
    expectRefused(&Options::max_angle, bad);
    expectRefused(&Options::neighbourhood, bad);
    expectRefused(&Options::probability, bad);
  }
  expectRefused(&Options::max_angle, 1.6);
  expectRefused(&Options::probability, 1.0);
  expectRefused(&Options::min_surfels, std::size_t{2});
  Options options;
  options.bend = -1;
  try {
    pcl6d::ransacCandidates(PlaneCloud({}), options);
    FAIL() << "accepted";
  } catch (const pcl6d::BadArgument& error) {
    EXPECT_STREQ(error.what(), "bend = -1, but must be finite and >= 0");
  }
}

TEST(HoughPlaneOptions, NameWhatBreaksItsRule)
{
  using Options = pcl6d::HoughPlaneOptions;
  EXPECT_NO_THROW(Options().validate());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan}) {
    expectRefused(&Options::offset_cell, bad);
    expectRefused(&Options::max_plane_distance, bad);
    expectRefused(&Options::max_angle, bad);
    expectRefused(&Options::max_side, bad);
    expectRefused(&Options::share, bad);
  }
  expectRefused(&Options::slices, 1);
  expectRefused(&Options::min_surfels, std::size_t{2});
  expectRefused(&Options::min_side, -0.1);
  expectRefused(&Options::min_side, 2.0);
  expectRefused(&Options::votes, 1);
  expectRefused(&Options::max_draws, 0);
  expectRefused(&Options::max_failures, 0);
  expectRefused(&Options::share, 1.1);
  expectRefused(&Options::peaks, 0);
  expectRefused(&Options::stable_batches, 0);
  for (const double bad : {0.0, 1.0, nan})
    expectRefused(&Options::chance, bad);
}
} // namespace
