// SPDX-License-Identifier: BSD-3-Clause
#include "support/constants.h"

#include <pcl6d/common/rotation.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/simulation/cast_scan.h>
#include <pcl6d/simulation/scene_builder.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <sstream>

using pcl6d::test::kDegree;

namespace {
using namespace pcl6d;

constexpr double kFit = 1e-6; // [m] what is asked for within 10 m

// Looks into the corner that the box of cornerRoom() has at (4, 3, 2).
Eigen::Isometry3d
towardsTheCorner()
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 1.5, 0.7, 0.1;
  pose.linear() = rotationFromEuler({0.1, -0.55, 0.74});
  return pose;
}

RayCaster
cornerRoom()
{
  TriangleScene scene;
  addBox(scene, {-4, -3, -1.5}, {4, 3, 2}, {"room", 0.8});
  return RayCaster(scene);
}

TriangleScene
sphere(const Eigen::Vector3d& centre, double radius)
{
  constexpr int kRings = 24;
  constexpr int kSegments = 48;
  TriangleScene scene;
  scene.addSurface({"sphere", 0.5});
  for (int ring = 0; ring <= kRings; ++ring)
    for (int segment = 0; segment < kSegments; ++segment) {
      const double polar = M_PI * ring / kRings;
      const double azimuth = 2 * M_PI * segment / kSegments;
      scene.vertices.push_back(
          centre + radius * Eigen::Vector3d(std::sin(polar) * std::cos(azimuth),
                                            std::sin(polar) * std::sin(azimuth),
                                            std::cos(polar)));
    }
  const auto at = [](int ring, int segment) {
    return static_cast<std::uint32_t>(ring * kSegments + segment % kSegments);
  };
  for (int ring = 0; ring < kRings; ++ring)
    for (int segment = 0; segment < kSegments; ++segment) {
      if (ring > 0)
        scene.triangles.push_back(
            {{at(ring, segment), at(ring + 1, segment), at(ring, segment + 1)}, 0});
      if (ring + 1 < kRings)
        scene.triangles.push_back(
            {{at(ring, segment + 1), at(ring + 1, segment), at(ring + 1, segment + 1)},
             0});
    }
  return scene;
}

std::vector<Eigen::Vector3d>
pointsOf(const RangeScan& scan,
         const ScannerModel& scanner,
         const Eigen::Isometry3d& pose)
{
  std::vector<Eigen::Vector3d> points;
  for (int line = 0; line < scan.num_lines; ++line)
    for (int i = 0; i < scan.samples_per_line; ++i) {
      const Ray ray = scanner.ray(line, i);
      points.push_back(pose * (ray.origin + scan.at(line, i).range * ray.direction));
    }
  return points;
}

struct PlaneFit {
  Eigen::Vector3d centre, normal;
  double worst = 0;  // [m] largest distance of a point
  double spread = 0; // [m] extent of the points in the plane's narrow direction
};

PlaneFit
fitPlane(const std::vector<Eigen::Vector3d>& points)
{
  PlaneFit fit;
  fit.centre.setZero();
  for (const auto& p : points)
    fit.centre += p / static_cast<double>(points.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const auto& p : points)
    moments += (p - fit.centre) * (p - fit.centre).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
  fit.normal = solver.eigenvectors().col(0);
  fit.spread = std::sqrt(solver.eigenvalues()(1) / static_cast<double>(points.size()));
  for (const auto& p : points)
    fit.worst = std::max(fit.worst, std::abs(fit.normal.dot(p - fit.centre)));
  return fit;
}

// Distance from a point to a triangle: to its plane if above it, else to an edge.
double
distanceTo(const TriangleScene& scene, std::uint32_t index, const Eigen::Vector3d& p)
{
  const Eigen::Vector3d n = scene.normal(index);
  bool is_above = true;
  double edge = HUGE_VAL;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d& a = scene.corner(index, i);
    const Eigen::Vector3d side = scene.corner(index, (i + 1) % 3) - a;
    is_above = is_above && n.dot(side.cross(p - a)) >= 0;
    const double t = std::clamp(side.dot(p - a) / side.squaredNorm(), 0.0, 1.0);
    edge = std::min(edge, (a + t * side - p).norm());
  }
  return is_above ? std::abs(n.dot(p - scene.corner(index, 0))) : edge;
}

class Accuracy : public testing::TestWithParam<std::string> {
protected:
  ScannerPreset preset_ = scannerByName(GetParam());

  // For --gtest_output=json.
  static void
  record(const char* name, double value)
  {
    std::ostringstream text;
    text << value;
    RecordProperty(name, text.str());
  }

  RangeScan
  exactScan(const RayCaster& caster, const Eigen::Isometry3d& pose) const
  {
    return castScan(caster, *preset_.scanner, pose, preset_.range.withoutErrors());
  }
};

INSTANTIATE_TEST_SUITE_P(Scanners,
                         Accuracy,
                         testing::ValuesIn(scannerNames()),
                         [](const auto& preset) { return preset.param; });
} // namespace

TEST_P(Accuracy, FitsACornerWithoutNoise)
{
  const RayCaster room = cornerRoom();
  const Eigen::Isometry3d pose = towardsTheCorner();
  const RangeScan scan = exactScan(room, pose);
  const auto points = pointsOf(scan, *preset_.scanner, pose);
  std::map<std::uint32_t, std::vector<Eigen::Vector3d>> faces; // by surface
  int returns = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const RangeSample& sample = scan.samples[i];
    if (std::isnan(sample.range))
      continue;
    ++returns;
    ASSERT_LT(sample.range, 10);
    const Eigen::Vector3d inside =
        (Eigen::Vector3d(4, 3, 2) - points[i])
            .cwiseMin(points[i] + Eigen::Vector3d(4, 3, 1.5));
    ASSERT_LT(std::abs(inside.minCoeff()), kFit); // on one of the six true faces
    faces[room.scene().triangles[sample.triangle].surface].push_back(points[i]);
  }
  EXPECT_GT(returns, 0.4 * static_cast<double>(points.size()));
  if (preset_.scanner->numLines() == 1)
    return; // a line of points or one: no plane to fit
  Eigen::Matrix3d normals;
  Eigen::Vector3d offsets;
  int planes = 0;
  double worst = 0;
  for (const auto& face : faces) {
    const PlaneFit fit = fitPlane(face.second);
    if (face.second.size() < 20 || fit.spread < 0.05)
      continue;
    EXPECT_LT(fit.worst, kFit);
    worst = std::max(worst, fit.worst);
    if (fit.centre.x() > 3.9 || fit.centre.y() > 2.9 || fit.centre.z() > 1.9) {
      ASSERT_LT(planes, 3);
      normals.row(planes) = fit.normal.transpose();
      offsets(planes++) = fit.normal.dot(fit.centre);
    }
  }
  record("plane_error", worst);
  ASSERT_EQ(planes, 3) << "all three faces of the corner are seen";
  const Eigen::Vector3d corner = normals.colPivHouseholderQr().solve(offsets);
  const double error = (corner - Eigen::Vector3d(4, 3, 2)).norm();
  EXPECT_LT(error, kFit);
  record("corner_error", error);
}

TEST_P(Accuracy, PutsPointsOnTheMeshOfASphere)
{
  const Eigen::Isometry3d pose = towardsTheCorner();
  const RayCaster caster(sphere(pose * Eigen::Vector3d(1.6, 0, 0), 0.5));
  const RangeScan scan = exactScan(caster, pose);
  const auto points = pointsOf(scan, *preset_.scanner, pose);
  const auto count = static_cast<std::uint32_t>(caster.scene().triangles.size());
  int hits = 0;
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::isnan(scan.samples[i].range))
      continue;
    const double off = distanceTo(caster.scene(), scan.samples[i].triangle, points[i]);
    ASSERT_LT(off, kFit);
    worst = std::max(worst, off);
    if (hits++ % 97 != 0)
      continue;
    double nearest = HUGE_VAL; // by hand, whatever triangle the scan names
    for (std::uint32_t t = 0; t < count; ++t)
      nearest = std::min(nearest, distanceTo(caster.scene(), t, points[i]));
    ASSERT_LT(nearest, kFit);
  }
  EXPECT_GE(hits, preset_.scanner->numLines() == 1 ? 1 : 100);
  record("mesh_error", worst);
}

TEST_P(Accuracy, HasTheNoiseOfItsModel)
{
  const RayCaster room = cornerRoom();
  const Eigen::Isometry3d pose = towardsTheCorner();
  const RangeScan exact = exactScan(room, pose);
  RangeOptions options = preset_.range; // spots and steps have tests of their own
  options.beam = {};
  options.quantum = 0;
  const RangeErrorModel model(options);
  double sum = 0;
  double sum_sq = 0;
  int count = 0;
  const std::uint64_t num_scans = exact.samples.size() < 1000 ? 50 : 1;
  for (std::uint64_t index = 0; index < num_scans; ++index) {
    const RangeScan noisy = castScan(room, *preset_.scanner, pose, options, index);
    for (std::size_t i = 0; i < exact.samples.size(); ++i) {
      const RangeSample& truth = exact.samples[i];
      if (!(truth.range > options.min_range + 0.1) ||
          std::isnan(noisy.samples[i].range))
        continue;
      const double cos_incidence = truth.intensity / 0.8; // the room's reflectance
      const double sigma = model.sigma(truth.range, truth.intensity, cos_incidence);
      const double error = (noisy.samples[i].range - truth.range) / sigma;
      sum += error;
      sum_sq += error * error;
      ++count;
    }
  }
  ASSERT_GE(count, 50);
  // Five standard errors of the mean and of the standard deviation.
  EXPECT_NEAR(sum / count, 0, 5 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(sum_sq / count), 1, 5 / std::sqrt(2.0 * count));
  record("mean", sum / count);
  record("sigma", std::sqrt(sum_sq / count));
}

TEST_P(Accuracy, HasTheSameBytesForEveryThreadCount)
{
  const auto coarse =
      GetParam() == "rangefinder" ? preset_ : scannerByName(GetParam(), 4 * kDegree);
  const RayCaster room = cornerRoom();
  RangeOptions options = coarse.range;
  options.num_threads = 1;
  const RangeScan expected =
      castScan(room, *coarse.scanner, towardsTheCorner(), options);
  for (const unsigned threads : {2u, 7u}) {
    options.num_threads = threads;
    const RangeScan scan = castScan(room, *coarse.scanner, towardsTheCorner(), options);
    for (std::size_t i = 0; i < scan.samples.size(); ++i)
      ASSERT_EQ(std::memcmp(
                    &scan.samples[i].range, &expected.samples[i].range, sizeof(double)),
                0);
  }
}
