// SPDX-License-Identifier: BSD-3-Clause
// Normals of scans whose lines lie far apart, against the walls that were measured.
#include "support/clouds.h"
#include "support/points.h"

#include <pcl6d/common/random.h>
#include <pcl6d/filters/line_growth.h>
#include <pcl6d/filters/pcl/normal_estimation.h>

#include <cmath>
#include <cstring>

using pcl6d::LineGrowth;
using pcl6d::LineSurface;
using pcl6d::Normals;
using pcl6d::Points;
using pcl6d::PointTree;
using pcl6d::Random;
using pcl6d::ScanNormals;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;
using pcl6d::test::toCloud;

namespace {
constexpr double kDegree = 3.14159265358979 / 180;
constexpr double kNoise = 0.01;        // [m] of a range
const Eigen::Array3d kHalf(4, 3, 1.5); // [m] of the room about the scanner
constexpr double kNearEdge = 0.4;      // [m] patches there hold two walls
using Estimation = pcl6d::NormalEstimation<pcl::PointXYZ, pcl::Normal>;

/** A turn of a spinning lidar in the middle of a room. */
Points
ringsInRoom(int rings = 16, double pitch = 2 * kDegree, double step = 0.2 * kDegree)
{
  Random random(1);
  Points points;
  for (int ring = 0; ring < rings; ++ring)
    for (double azimuth = 0; azimuth < 360 * kDegree; azimuth += step) {
      const double elevation = (ring - 0.5 * (rings - 1)) * pitch;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth),
                                std::sin(elevation));
      const double range = (kHalf / ray.array().abs()).minCoeff();
      points.push_back(((range + kNoise * random.normal()) * ray).cast<float>());
    }
  return points;
}

/** \return the normal of the wall of a point, zero near an edge of the room */
Eigen::Vector3f
wallAt(const Eigen::Vector3f& p)
{
  const Eigen::Array3d gap = (p.cast<double>().array().abs() - kHalf).abs();
  Eigen::Index nearest = 0;
  gap.minCoeff(&nearest);
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    if (axis != nearest && gap[axis] < kNearEdge)
      return normal;
  normal[nearest] = p[nearest] > 0 ? -1.0F : 1.0F;
  return normal;
}

/** How normals agree with the walls, of the points away from edges. */
struct Agreement {
  std::size_t points = 0, with_normal = 0, wrong = 0; ///< wrong by 20 degrees and more
};

template <typename NormalAt>
Agreement
agreementOf(const Points& points, NormalAt normal_at)
{
  Agreement found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f wall = wallAt(points[i]), normal = normal_at(i);
    if (wall.isZero(0))
      continue;
    ++found.points;
    if (!normal.allFinite() || normal.isZero(0))
      continue;
    ++found.with_normal;
    found.wrong += normal.dot(wall) < std::cos(20 * kDegree) ? 1 : 0;
  }
  return found;
}

Agreement
agreementOf(LineGrowth growth)
{
  const Points points = ringsInRoom();
  const Normals normals =
      pcl6d::estimateScanNormals(points, PointTree(points), {20, growth});
  return agreementOf(points, [&](std::size_t i) { return normals[i]; });
}

pcl::PointCloud<pcl::Normal>
computed(const Points& points, LineGrowth growth, unsigned int threads = 0)
{
  Estimation estimation(threads);
  estimation.setLineGrowth(growth);
  estimation.setKSearch(20);
  estimation.setInputCloud(toCloud<pcl::PointXYZ>(points));
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  return normals;
}

Agreement
agreementOfClass(LineGrowth growth)
{
  const Points points = ringsInRoom();
  const auto normals = computed(points, growth);
  return agreementOf(points, [&](std::size_t i) -> Eigen::Vector3f {
    return normals[i].getNormalVector3fMap();
  });
}

bool
haveSameBits(const pcl::PointCloud<pcl::Normal>& a,
             const pcl::PointCloud<pcl::Normal>& b)
{
  return a.size() == b.size() && std::memcmp(a.points.data(),
                                             b.points.data(),
                                             a.size() * sizeof(pcl::Normal)) == 0;
}

/** Points of a cube's faces, evenly at random. */
Points
evenCube()
{
  Random random(5);
  Points points;
  for (int i = 0; i < 6000; ++i) {
    Eigen::Vector3d p(
        random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    p[i % 3] = i % 2 == 0 ? 1 : -1;
    points.push_back(p.cast<float>());
  }
  return points;
}
} // namespace

TEST(ScanNormals, OfRingsAreThoseOfTheWalls)
{
  const Agreement nearest = agreementOf(LineGrowth::kNever);
  const Agreement grown = agreementOf(LineGrowth::kAuto);
  EXPECT_GT(nearest.wrong, nearest.points / 20) << "noise of points on one ring";
  EXPECT_LT(grown.wrong, grown.points / 200);
  EXPECT_GT(grown.with_normal, grown.points * 9 / 10);
}

TEST(ScanNormals, OfAnEvenCloudAreThoseOfTheNearestPoints)
{
  const Points points = evenCube();
  const PointTree tree(points);
  EXPECT_FALSE(LineSurface(points, Eigen::Vector3f::Zero(), LineGrowth::kAuto).grows());
  EXPECT_TRUE(pcl6d::estimateScanNormals(points, tree) ==
              pcl6d::estimateNormals(points, tree));
  EXPECT_TRUE(haveSameBits(computed(points, LineGrowth::kAuto),
                           computed(points, LineGrowth::kNever)));
}

TEST(ScanNormals, NeverGrowWhereNotWanted)
{
  const Points points = ringsInRoom();
  const PointTree tree(points);
  EXPECT_TRUE(pcl6d::estimateScanNormals(points, tree, {20, LineGrowth::kNever}) ==
              pcl6d::estimateNormals(points, tree));
}

TEST(ScanNormals, HaveTheSameBitsForAnyNumberOfThreads)
{
  const Points points = ringsInRoom();
  const PointTree tree(points);
  EXPECT_TRUE(pcl6d::estimateScanNormals(points, tree, {}, 1) ==
              pcl6d::estimateScanNormals(points, tree, {}, 3));
  EXPECT_TRUE(haveSameBits(computed(points, LineGrowth::kAuto, 1),
                           computed(points, LineGrowth::kAuto, 3)));
}

TEST(ScanNormals, OfASingleLineAreZero)
{
  Random random(2);
  Points line; // on a wall 2 m away
  for (int i = -300; i <= 300; ++i)
    line.push_back({0.01F * static_cast<float>(i),
                    2 + static_cast<float>(kNoise * random.normal()),
                    0});
  for (const auto& normal :
       pcl6d::estimateScanNormals(line, PointTree(line), {20, LineGrowth::kAlways}))
    EXPECT_TRUE(normal.isZero(0)) << normal.transpose();
}

TEST(ScanNormals, TakeWhatIsNoScan)
{
  EXPECT_TRUE(
      pcl6d::estimateScanNormals({}, PointTree(), {20, LineGrowth::kAlways}).empty());
  const auto nan = static_cast<float>(kNan);
  const Points odd = {{nan, 0, 0}, {1e30F, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  for (const auto& normal :
       pcl6d::estimateScanNormals(odd, PointTree(odd), {3, LineGrowth::kAlways}))
    EXPECT_TRUE(normal.isZero(0));
  EXPECT_NE(badArgumentOf([] {
              pcl6d::estimateScanNormals({}, PointTree(), {2});
            }).find("neighbours"),
            std::string::npos);
  const LineSurface none({}, Eigen::Vector3f::Zero(), LineGrowth::kAlways);
  EXPECT_TRUE(none.patchAt({nan, 0, 0}).normal.isZero(0));
  std::vector<pcl6d::SurfacePatch> patches(2);
  EXPECT_NE(badArgumentOf([&] {
              pcl6d::growLines(Points(1), none, patches);
            }).find("one per place"),
            std::string::npos);
}

TEST(NormalEstimation, OfRingsGrowsAcrossThem)
{
  EXPECT_EQ(Estimation().getLineGrowth(), LineGrowth::kAuto);
  const Agreement as_pcl = agreementOfClass(LineGrowth::kNever);
  const Agreement grown = agreementOfClass(LineGrowth::kAuto);
  EXPECT_EQ(as_pcl.with_normal, as_pcl.points);
  EXPECT_GT(as_pcl.wrong, as_pcl.points / 20);
  EXPECT_LT(grown.wrong, grown.points / 200);
  EXPECT_GT(grown.with_normal, grown.points * 9 / 10);
}
