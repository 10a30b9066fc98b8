// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/scanner/driven_scanner.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/scanner/scene_builder.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace {
using namespace pcl6d;

constexpr double kDegree = M_PI / 180;
constexpr double kFit = 1e-6; // [m] what is asked for within 10 m

// Looks into the corner that the box of boxRoom() has at (4, 3, 2).
Eigen::Isometry3d
towardsTheCorner()
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 1.5, 0.7, 0.1;
  pose.linear() = rotationFromEuler({0.1, -0.55, 0.74});
  return pose;
}

RayCaster
boxRoom()
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

class Preset : public testing::TestWithParam<std::string> {
protected:
  ScannerPreset preset_ = scannerByName(GetParam());

  RangeScan
  exactScan(const RayCaster& caster, const Eigen::Isometry3d& pose) const
  {
    return castScan(caster, *preset_.scanner, pose, preset_.range.withoutErrors());
  }
};

INSTANTIATE_TEST_SUITE_P(Scanners,
                         Preset,
                         testing::ValuesIn(scannerNames()),
                         [](const auto& preset) { return preset.param; });
} // namespace

TEST_P(Preset, FitsACornerWithoutNoise)
{
  const RayCaster room = boxRoom();
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
  for (const auto& face : faces) {
    const PlaneFit fit = fitPlane(face.second);
    if (face.second.size() < 20 || fit.spread < 0.05)
      continue;
    EXPECT_LT(fit.worst, kFit);
    if (fit.centre.x() > 3.9 || fit.centre.y() > 2.9 || fit.centre.z() > 1.9) {
      ASSERT_LT(planes, 3);
      normals.row(planes) = fit.normal.transpose();
      offsets(planes++) = fit.normal.dot(fit.centre);
    }
  }
  ASSERT_EQ(planes, 3) << "all three faces of the corner are seen";
  const Eigen::Vector3d corner = normals.colPivHouseholderQr().solve(offsets);
  EXPECT_LT((corner - Eigen::Vector3d(4, 3, 2)).norm(), kFit);
}

TEST_P(Preset, PutsPointsOnTheMeshOfASphere)
{
  const Eigen::Isometry3d pose = towardsTheCorner();
  const RayCaster caster(sphere(pose * Eigen::Vector3d(1.6, 0, 0), 0.5));
  const RangeScan scan = exactScan(caster, pose);
  const auto points = pointsOf(scan, *preset_.scanner, pose);
  const auto count = static_cast<std::uint32_t>(caster.scene().triangles.size());
  int hits = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::isnan(scan.samples[i].range))
      continue;
    ASSERT_LT(distanceTo(caster.scene(), scan.samples[i].triangle, points[i]), kFit);
    if (hits++ % 97 != 0)
      continue;
    double nearest = HUGE_VAL; // by hand, whatever triangle the scan names
    for (std::uint32_t t = 0; t < count; ++t)
      nearest = std::min(nearest, distanceTo(caster.scene(), t, points[i]));
    ASSERT_LT(nearest, kFit);
  }
  EXPECT_GE(hits, preset_.scanner->numLines() == 1 ? 1 : 100);
}

TEST_P(Preset, MeasuresWithinItsDuration)
{
  const ScannerModel& scanner = *preset_.scanner;
  double last = 0;
  for (int line = 0; line < scanner.numLines(); ++line)
    for (int i = 0; i < scanner.samplesPerLine(); i += 13) {
      ASSERT_GE(scanner.time(line, i), 0);
      last = std::max(last, scanner.time(line, i));
      ASSERT_NEAR(scanner.ray(line, i).direction.norm(), 1, 1e-12);
    }
  EXPECT_LT(last, scanner.duration());
}

TEST_P(Preset, TellsItsSize)
{
  EXPECT_EQ(preset_.name, GetParam());
  EXPECT_EQ(preset_.description, scannerDescription(GetParam()));
  const std::string size = std::to_string(preset_.scanner->numLines()) + " x " +
                           std::to_string(preset_.scanner->samplesPerLine());
  if (GetParam() != "rangefinder") {
    EXPECT_NE(preset_.description.find(size), std::string::npos) << size;
  }
}

TEST_P(Preset, TakesAnotherResolution)
{
  for (const double wrong : {0.0, -0.1, 2.0, std::nan("")})
    EXPECT_THROW(scannerByName(GetParam(), wrong), BadArgument) << wrong;
  if (GetParam() == "rangefinder")
    return; // a single beam has no neighbour
  EXPECT_THROW(scannerByName(GetParam(), 1e-300), BadArgument);
  const double step = 3 * kDegree;
  const auto coarse = scannerByName(GetParam(), step).scanner;
  const int line = coarse->numLines() / 2;
  const int sample = coarse->samplesPerLine() / 2;
  const auto angle = [&](int other_line, int other_sample) {
    return std::acos(
        coarse->ray(line, sample)
            .direction.dot(coarse->ray(other_line, other_sample).direction));
  };
  EXPECT_NEAR(angle(line, sample + 1), step, 0.03 * step);
  EXPECT_LT(coarse->samplesPerLine(), preset_.scanner->samplesPerLine());
}

TEST(ScannerByName, KeepsTheSolidAtAnotherResolution)
{
  const auto coarse = scannerByName("rotating", 10 * kDegree).scanner;
  EXPECT_EQ(coarse->numLines(), 36); // the seam is closed once
  EXPECT_EQ(coarse->samplesPerLine(), 13);
  EXPECT_NEAR(coarse->ray(0, 12).direction.z(), std::sin(60 * kDegree), 1e-12);
  EXPECT_NEAR(std::acos(coarse->ray(0, 6).direction.dot(coarse->ray(35, 6).direction)),
              10 * kDegree,
              1e-9);
  const auto nodding = scannerByName("pitching", 0.25 * kDegree).scanner;
  EXPECT_EQ(nodding->numLines(), 481);
  EXPECT_EQ(nodding->samplesPerLine(), 721);
}

TEST(ScannerByName, NamesThoseItKnows)
{
  try {
    scannerByName("sonar");
    FAIL();
  } catch (const BadArgument& e) {
    for (const auto& name : scannerNames())
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
  }
  EXPECT_THROW(scannerDescription("sonar"), BadArgument);
}

TEST(ScannerByName, HasTheFiguresOfTheBook)
{
  const auto pitching = scannerByName("pitching").scanner;
  EXPECT_NEAR(pitching->ray(0, 0).direction.y(), -1, 1e-12); // 180 deg wide
  const auto sick = scannerByName("sick").scanner;
  EXPECT_EQ(sick->numLines(), 1);
  EXPECT_EQ(sick->samplesPerLine(), 181);
  EXPECT_NEAR(sick->duration(), 13e-3, 0.5e-3);
  const auto scandrive = scannerByName("scandrive").scanner;
  EXPECT_EQ(scandrive->numLines() * scandrive->samplesPerLine(), 32580);
  EXPECT_NEAR(scandrive->duration(), 1.2, 1e-12);
  const ScannerPreset tof = scannerByName("tof");
  EXPECT_EQ(tof.scanner->numLines() * tof.scanner->samplesPerLine(), 25344);
  EXPECT_NEAR(tof.range.ambiguity_interval, 7.49, 0.01);
}
