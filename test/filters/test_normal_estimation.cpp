// SPDX-License-Identifier: BSD-3-Clause
// NormalEstimation beside pcl::NormalEstimation and pcl::NormalEstimationOMP.
#include "support/clouds.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/filters/pcl/normal_estimation.h>

#include <pcl/features/impl/normal_3d_omp.hpp>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/octree.h>

#include <cmath>
#include <cstring>

using pcl6d::Points;
using pcl6d::Random;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;
using pcl6d::test::toCloud;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Normals = pcl::PointCloud<pcl::Normal>;
using Ours = pcl6d::NormalEstimation<Point, pcl::Normal>;
using OfPcl = pcl::NormalEstimation<Point, pcl::Normal>;

/** Points of a sphere about the origin, with their true normals outwards. */
Points
sphere(std::size_t count, double radius, const Eigen::Vector3d& centre = {0, 0, 0})
{
  Random random(1);
  Points points;
  while (points.size() < count) {
    const Eigen::Vector3d d(random.normal(), random.normal(), random.normal());
    points.push_back((centre + radius * d.normalized()).cast<float>());
  }
  return points;
}

/** A plane through a place, with a normal, sampled every centimetre. */
Points
plane(const Eigen::Vector3d& place, const Eigen::Vector3d& normal)
{
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  Points points;
  for (int i = -12; i <= 12; ++i)
    for (int k = -12; k <= 12; ++k)
      points.push_back((place + 0.01 * i * u + 0.01 * k * v).cast<float>());
  return points;
}

template <typename Estimation>
Normals
computed(Estimation& estimation, const Cloud::ConstPtr& cloud)
{
  Normals normals;
  estimation.setInputCloud(cloud);
  estimation.compute(normals);
  return normals;
}

bool
haveSameBits(const Normals& a, const Normals& b)
{
  return a.size() == b.size() && std::memcmp(a.points.data(),
                                             b.points.data(),
                                             a.size() * sizeof(pcl::Normal)) == 0;
}

template <typename Estimation>
class NormalsBy : public testing::Test {};
using Estimations =
    testing::Types<OfPcl, pcl::NormalEstimationOMP<Point, pcl::Normal>, Ours>;
TYPED_TEST_SUITE(NormalsBy, Estimations);
} // namespace

TYPED_TEST(NormalsBy, HasPclsSettings)
{
  TypeParam estimation;
  const Cloud::Ptr cloud = toCloud<Point>(sphere(50, 1));
  const auto tree = pcl::make_shared<pcl::search::KdTree<Point>>();
  estimation.setKSearch(7);
  estimation.setRadiusSearch(0.25);
  estimation.setSearchMethod(tree);
  estimation.setSearchSurface(cloud);
  EXPECT_EQ(estimation.getKSearch(), 7);
  EXPECT_EQ(estimation.getRadiusSearch(), 0.25);
  EXPECT_EQ(estimation.getSearchMethod(), tree);
  EXPECT_EQ(estimation.getSearchSurface(), cloud);
  float x = 0, y = 0, z = 0;
  cloud->sensor_origin_ = {1, 2, 3, 0};
  estimation.setInputCloud(cloud);
  estimation.getViewPoint(x, y, z);
  EXPECT_EQ(Eigen::Vector3f(x, y, z), Eigen::Vector3f(1, 2, 3));
  estimation.setViewPoint(4, 5, 6);
  estimation.getViewPoint(x, y, z);
  EXPECT_EQ(Eigen::Vector3f(x, y, z), Eigen::Vector3f(4, 5, 6));
  estimation.useSensorOriginAsViewPoint();
  estimation.getViewPoint(x, y, z);
  EXPECT_EQ(Eigen::Vector3f(x, y, z), Eigen::Vector3f(1, 2, 3));
}

TYPED_TEST(NormalsBy, FindsThoseOfAPlane)
{
  const Eigen::Vector3d truth = Eigen::Vector3d(1, -2, 2) / 3;
  const Cloud::Ptr cloud = toCloud<Point>(plane(3 * truth, truth));
  for (const int k : {0, 12, 100}) {
    TypeParam estimation;
    estimation.setKSearch(k);
    estimation.setRadiusSearch(k == 0 ? 0.035 : 0);
    const Normals normals = computed(estimation, cloud);
    ASSERT_EQ(normals.size(), cloud->size());
    EXPECT_TRUE(normals.is_dense);
    EXPECT_EQ(estimation.getSearchMethod()->getInputCloud(), cloud);
    for (const auto& n : normals) { // towards the sensor
      EXPECT_LT((n.getNormalVector3fMap().cast<double>() + truth).norm(), 1e-4);
      EXPECT_LT(n.curvature, 1e-5f);
    }
  }
}

TYPED_TEST(NormalsBy, TakesNeighboursFromTheSurface)
{
  const Cloud::Ptr surface = toCloud<Point>(plane({0, 0, 2}, {0, 0, 1}));
  const Cloud::Ptr places = toCloud<Point>({{0, 0, 2.1f}, {0.05f, 0, 1.9f}, {9, 9, 9}});
  TypeParam estimation;
  estimation.setSearchSurface(surface);
  estimation.setRadiusSearch(0.13);
  estimation.setViewPoint(0, 0, 5);
  const Normals normals = computed(estimation, places);
  ASSERT_EQ(normals.size(), 3u);
  EXPECT_GT(normals[0].normal_z, 0.9999f);
  EXPECT_GT(normals[1].normal_z, 0.9999f);
  EXPECT_TRUE(std::isnan(normals[2].normal_z)) << "nothing is near";
  EXPECT_TRUE(std::isnan(normals[2].curvature));
  EXPECT_FALSE(normals.is_dense);
}

TYPED_TEST(NormalsBy, WritesChosenPointsInTheirOrder)
{
  const Cloud::Ptr cloud = toCloud<Point>(sphere(500, 1));
  TypeParam estimation;
  estimation.setKSearch(10);
  const Normals all = computed(estimation, cloud);
  estimation.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{400, 3, 77}));
  const Normals some = computed(estimation, cloud);
  ASSERT_EQ(some.size(), 3u);
  EXPECT_EQ(some.height, 1u);
  for (const auto& [at, of] : {std::pair(0, 400), {1, 3}, {2, 77}})
    EXPECT_EQ(some[static_cast<std::size_t>(at)].getNormalVector3fMap(),
              all[static_cast<std::size_t>(of)].getNormalVector3fMap());
}

TYPED_TEST(NormalsBy, HasNoneForPointsThatAreNotFinite)
{
  Points points = sphere(100, 1);
  points[5] = {kNan, 0, 0};
  TypeParam estimation;
  estimation.setKSearch(8);
  const Normals normals = computed(estimation, toCloud<Point>(points));
  EXPECT_FALSE(normals.is_dense);
  for (std::size_t i = 0; i < normals.size(); ++i)
    EXPECT_EQ(std::isfinite(normals[i].normal_x), i != 5) << i;
}

TEST(NormalEstimation, GivesWhatPclGives)
{
  const Cloud::Ptr cloud = toCloud<Point>(sphere(3000, 1));
  for (const int k : {0, 10, 20, 80}) {
    Ours ours;
    OfPcl of_pcl;
    const auto setUp = [&](auto& estimation) {
      estimation.setKSearch(k);
      estimation.setRadiusSearch(k == 0 ? 0.2 : 0);
    };
    setUp(ours);
    setUp(of_pcl);
    const Normals found = computed(ours, cloud), expected = computed(of_pcl, cloud);
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_LT(
          (found[i].getNormalVector3fMap() - expected[i].getNormalVector3fMap()).norm(),
          2e-4)
          << k << " " << i;
      EXPECT_NEAR(found[i].curvature, expected[i].curvature, 1e-5);
    }
  }
}

TEST(NormalEstimation, KeepsItsDigitsFarFromTheOrigin)
{
  // Coordinates of 4 km have steps of a quarter of a millimetre (half of that is the error): the
  // tilt of a patch of radius 6 cm is a few of them over its width.
  const Eigen::Vector3d truth = Eigen::Vector3d(2, -1, 2) / 3;
  const Cloud::Ptr cloud = toCloud<Point>(plane({3000, -2500, 1000}, truth));
  const auto worstOf = [&](auto estimation) {
    estimation.setRadiusSearch(0.06);
    double worst = 0;
    for (const auto& n : computed(estimation, cloud))
      worst = std::max(
          worst, n.getNormalVector3fMap().template cast<double>().cross(truth).norm());
    return worst;
  };
  const double ours = worstOf(Ours());
  EXPECT_LT(ours, 0.00025 / 0.06);
  EXPECT_LE(ours, 1.001 * worstOf(OfPcl()));
}

TEST(NormalEstimation, GivesTheSameBitsForAnyNumberOfThreadsAndAnyTree)
{
  const Cloud::Ptr cloud = toCloud<Point>(sphere(3000, 1));
  Ours estimation(1);
  estimation.setKSearch(20);
  const Normals expected = computed(estimation, cloud);
  for (const unsigned int threads : {0u, 2u, 5u}) {
    estimation.setNumberOfThreads(threads);
    EXPECT_TRUE(haveSameBits(computed(estimation, cloud), expected));
  }
  const auto by = [&](const pcl::search::Search<Point>::Ptr& search) {
    estimation.setSearchMethod(search);
    const Normals found = computed(estimation, cloud);
    EXPECT_EQ(search->getInputCloud(), cloud) << "is ready for other use, as in PCL";
    return found;
  };
  EXPECT_TRUE(haveSameBits(by(pcl::make_shared<pcl6d::KdTree<Point>>()), expected));
  EXPECT_TRUE(
      haveSameBits(by(pcl::make_shared<pcl::search::KdTree<Point>>()), expected));
}

TEST(NormalEstimation, AsksSearchesOfItsOwnKind)
{
  // A search that leaves points out, and one that counts other coordinates.
  const Cloud::Ptr cloud = toCloud<Point>(sphere(2000, 1));
  const auto setUp = [&](auto& estimation, const auto& search) {
    estimation.setKSearch(12);
    estimation.setSearchMethod(search);
  };
  class Flat : public pcl::PointRepresentation<Point> {
  public:
    Flat() { nr_dimensions_ = 2; }
    void
    copyToFloatArray(const Point& p, float* out) const override
    {
      out[0] = p.x;
      out[1] = p.y;
    }
  };
  const auto flat = pcl::make_shared<pcl::search::KdTree<Point>>();
  flat->setPointRepresentation(pcl::make_shared<Flat>());
  const auto octree = pcl::make_shared<pcl::search::Octree<Point>>(0.1);
  Ours ours, plain;
  OfPcl of_pcl;
  plain.setKSearch(12);
  const Normals without = computed(plain, cloud);
  for (const pcl::search::Search<Point>::Ptr& search :
       {pcl::search::Search<Point>::Ptr(flat),
        pcl::search::Search<Point>::Ptr(octree)}) {
    setUp(ours, search);
    setUp(of_pcl, search);
    const Normals found = computed(ours, cloud), expected = computed(of_pcl, cloud);
    std::size_t num_same = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
      num_same += std::abs(found[i].getNormalVector3fMap().dot(
                      expected[i].getNormalVector3fMap())) > 0.9999f;
    // Columns of points through both halves of the sphere have two directions in which they
    // spread about equally little, between which the float sums of PCL decide.
    EXPECT_GT(num_same, found.size() * 97 / 100);
    if (search == flat) {
      EXPECT_FALSE(haveSameBits(found, without));
    }
    ours.setNumberOfThreads(2);
    EXPECT_TRUE(haveSameBits(computed(ours, cloud), found));
    ours.setNumberOfThreads(0);
  }
}

TEST(NormalEstimation, HasNoneForPointsOnALine)
{
  Points points;
  for (int i = 0; i < 50; ++i)
    points.push_back(Eigen::Vector3f(1, 2, 0.5f) * (0.25f * static_cast<float>(i)));
  Ours estimation;
  estimation.setKSearch(5);
  for (const auto& n : computed(estimation, toCloud<Point>(points)))
    EXPECT_TRUE(std::isnan(n.normal_x));
  for (const auto& n : computed(estimation, toCloud<Point>(Points(20, {1, 1, 1}))))
    EXPECT_TRUE(std::isnan(n.curvature)) << "all in one place";
  estimation.setKSearch(2);
  for (const auto& n : computed(estimation, toCloud<Point>(sphere(20, 1))))
    EXPECT_TRUE(std::isnan(n.normal_x)) << "two points make no plane";
}

TEST(NormalEstimation, FillsPointsThatHaveNormals)
{
  const auto cloud = toCloud<pcl::PointNormal>(plane({0, 0, 2}, {0, 0, 1}));
  pcl6d::NormalEstimationOMP<pcl::PointNormal, pcl::PointNormal> estimation(2);
  pcl::NormalEstimation<pcl::PointNormal, pcl::PointNormal>& base = estimation;
  base.setInputCloud(cloud);
  base.setKSearch(9);
  base.compute(*cloud); // in place
  for (const auto& p : *cloud) {
    EXPECT_LT(p.normal_z, -0.9999f);
    EXPECT_EQ(p.z, 2) << "the points stay";
  }
}

TEST(NormalEstimation, FitsPlanesToChosenPoints)
{
  const Eigen::Vector3d truth = Eigen::Vector3d(1, -2, 2) / 3;
  Points points = plane(3 * truth, truth);
  points.push_back({kNan, 1, 1});
  const Cloud::Ptr cloud = toCloud<Point>(points);
  pcl::Indices all;
  for (std::size_t i = 0; i < points.size(); ++i)
    all.push_back(static_cast<pcl::index_t>(i));
  Ours estimation;
  Eigen::Vector4f plane_found;
  float curvature = 1, nx = 0, ny = 0, nz = 0;
  EXPECT_TRUE(estimation.computePointNormal(*cloud, all, plane_found, curvature));
  if (plane_found[0] < 0)
    plane_found = -plane_found;
  EXPECT_LT((plane_found.head<3>().cast<double>() - truth).norm(), 1e-5);
  EXPECT_NEAR(plane_found[3], -3, 1e-5);
  EXPECT_LT(curvature, 1e-6f);
  EXPECT_TRUE(estimation.computePointNormal(*cloud, all, nx, ny, nz, curvature));
  EXPECT_NEAR(std::abs(nx), 1. / 3, 1e-5);
  EXPECT_FALSE(estimation.computePointNormal(*cloud, {0, 1}, plane_found, curvature));
  EXPECT_TRUE(std::isnan(plane_found[3]) && std::isnan(curvature));
  EXPECT_NE(badArgumentOf([&] {
              estimation.computePointNormal(*cloud, {-1}, plane_found, curvature);
            }).find("index"),
            std::string::npos);
}

TEST(NormalEstimation, RefusesWhatItCannotUse)
{
  const Cloud::Ptr cloud = toCloud<Point>(sphere(50, 1));
  const auto words = [&](auto change) {
    return badArgumentOf([&] {
      Ours estimation;
      Normals normals;
      estimation.setInputCloud(cloud);
      estimation.setKSearch(5);
      change(estimation);
      estimation.compute(normals);
    });
  };
  EXPECT_EQ(words([](auto&) {}), "");
  const auto tells = [&](auto change, const char* what) {
    EXPECT_NE(words(change).find(what), std::string::npos) << what;
  };
  tells([](auto& e) { e.setInputCloud(nullptr); }, "null");
  tells([](auto& e) { e.setRadiusSearch(1); }, "set either the radius");
  tells([](auto& e) { e.setKSearch(0); }, "radius");
  tells([](auto& e) { e.setKSearch(-1); }, "k");
  for (const double radius : {-1., static_cast<double>(kNan), 1. * kInfinity})
    tells(
        [&](auto& e) {
          e.setKSearch(0);
          e.setRadiusSearch(radius);
        },
        "finite and > 0");
  for (const int index : {-1, 50})
    tells(
        [&](auto& e) {
          e.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{index}));
        },
        "index");
  Ours without;
  Normals normals;
  without.setKSearch(5);
  EXPECT_NE(badArgumentOf([&] { without.compute(normals); }).find("no input cloud"),
            std::string::npos);
}

TEST(NormalEstimation, GivesNothingOfNothing)
{
  Ours estimation;
  estimation.setKSearch(5);
  EXPECT_TRUE(computed(estimation, toCloud<Point>({})).empty());
  const Cloud::Ptr cloud = toCloud<Point>(sphere(5, 1));
  estimation.setSearchSurface(toCloud<Point>({}));
  for (const auto& n : computed(estimation, cloud))
    EXPECT_TRUE(std::isnan(n.normal_x));
  estimation.setSearchSurface(nullptr);
  for (const auto& n : computed(estimation, toCloud<Point>(Points(9, {kNan, 0, 0}))))
    EXPECT_TRUE(std::isnan(n.normal_x));
}
