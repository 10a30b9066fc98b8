// SPDX-License-Identifier: BSD-3-Clause
// Plücker lines: joins, meets, and what lies nearest to many.
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/common/line.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace pcl6d; // NOLINT: the header alone
using Eigen::Vector3d;
using pcl6d::test::kNan;

namespace {
constexpr int kLines = 200;
constexpr double kExtent = 10; // [m] largest coordinate
// Products of coordinates: some tens of roundings of kExtent^2 and 1 / sine below.
constexpr double kTol = 1e-12;
constexpr double kLeastSine = 0.05; ///< of the random figures

Vector3d
randomPoint(Random& random)
{
  return {random.uniform(-kExtent, kExtent),
          random.uniform(-kExtent, kExtent),
          random.uniform(-kExtent, kExtent)};
}

Vector3d
randomDirection(Random& random)
{
  return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

PlaneEquation
planeAt(const Vector3d& point, const Vector3d& normal)
{
  return {normal, normal.dot(point)};
}

PlaneEquation
moved(const Eigen::Isometry3d& T, const PlaneEquation& plane)
{
  const Vector3d normal = T.linear() * plane.normal;
  return {normal, plane.offset + normal.dot(T.translation())};
}

/** Expects one line, run the same way. */
void
expectSame(const PlueckerLine& a, const PlueckerLine& b, double tolerance = kTol)
{
  EXPECT_LT((a.direction - b.direction).norm(), tolerance);
  EXPECT_LT((a.moment - b.moment).norm(), kExtent * tolerance);
}
} // namespace

TEST(PlueckerLine, HoldsThePointsThatItJoins)
{
  Random random(1);
  for (int i = 0; i < kLines; ++i) {
    const Vector3d p = randomPoint(random), q = randomPoint(random);
    const PlueckerLine line = lineThrough(p, q).value();
    EXPECT_NEAR(line.direction.norm(), 1, kTol);
    EXPECT_NEAR(line.direction.dot(line.moment), 0, kExtent * kTol);
    for (const double s : {-1.0, 0.0, 0.3, 1.0, 2.0})
      EXPECT_LT(distanceTo(line, p + s * (q - p)), kExtent * kTol);
    EXPECT_NEAR(line.foot().dot(line.direction), 0, kExtent * kTol);
    EXPECT_LT(distanceTo(line, line.foot()), kExtent * kTol);
    EXPECT_NEAR(line.foot().norm(), distanceTo(line, Vector3d::Zero()), kExtent * kTol);
    // The same from any two of its points; the other way round from q to p.
    expectSame(line, *lineThrough(q, q + 0.5 * (q - p)), 1e-10);
    const PlueckerLine back = *lineThrough(q, p);
    expectSame(line, {-back.direction, -back.moment}, 1e-10);
  }
}

TEST(PlueckerLine, MovesWithItsPoints)
{
  Random random(2);
  for (int i = 0; i < kLines; ++i) {
    const Vector3d p = randomPoint(random), q = randomPoint(random);
    const Eigen::Isometry3d T = test::randomPose(random, kExtent, 3);
    const PlueckerLine line = *lineThrough(p, q);
    expectSame(pcl6d::moved(T, line), *lineThrough(T * p, T * q), 1e-10);
    const Vector3d x = randomPoint(random);
    EXPECT_NEAR(distanceTo(pcl6d::moved(T, line), T * x), distanceTo(line, x), 1e-11);
    expectSame(pcl6d::moved(T.inverse(), pcl6d::moved(T, line)), line, 1e-11);
  }
}

TEST(PlueckerLine, MeetsPlanesAndPlanesMeetInIt)
{
  Random random(3);
  for (int i = 0; i < kLines; ++i) {
    const Vector3d p = randomPoint(random);
    const PlaneEquation a = planeAt(p, randomDirection(random));
    const PlaneEquation b = planeAt(p, randomDirection(random));
    const PlaneEquation c = planeAt(p, randomDirection(random));
    const auto line = meetOf(a, b, kLeastSine);
    if (!line)
      continue;
    EXPECT_LT(distanceTo(*line, p), 1e-11);
    EXPECT_NEAR(a.normal.dot(line->direction), 0, 1e-11);
    EXPECT_NEAR(b.normal.dot(line->direction), 0, 1e-11);
    const auto corner = meetOf(*line, c, kLeastSine); // of three planes: the point
    if (corner) {
      EXPECT_LT((*corner - p).norm(), 1e-10);
    }
    const Eigen::Isometry3d T = test::randomPose(random, kExtent, 3);
    expectSame(*meetOf(moved(T, a), moved(T, b)), pcl6d::moved(T, *line), 1e-10);
  }
}

TEST(PlueckerLine, JoinAndMeetAreDual)
{
  // The line of two points is where the planes meet that join it with two others; the plane
  // of a line and a point meets another line through that point there.
  Random random(4);
  for (int i = 0; i < kLines; ++i) {
    const Vector3d p = randomPoint(random), q = randomPoint(random);
    const Vector3d x = randomPoint(random), y = randomPoint(random);
    const PlueckerLine line = *lineThrough(p, q);
    const PlaneEquation a = planeThrough(line, x).value();
    const PlaneEquation b = planeThrough(line, y).value();
    for (const Vector3d& on : {p, q, x})
      EXPECT_NEAR(a.normal.dot(on), a.offset, 1e-11);
    if (const auto meet = meetOf(a, b, kLeastSine)) {
      const bool turned = meet->direction.dot(line.direction) < 0;
      const double way = turned ? -1 : 1;
      expectSame({way * meet->direction, way * meet->moment}, line, 1e-9);
    }
    if (const auto meet = meetOf(*lineThrough(x, y), a, kLeastSine)) {
      EXPECT_LT((*meet - x).norm(), 1e-9);
    }
  }
}

TEST(PlueckerLines, AreAsFarApartAsTheirNearestPoints)
{
  Random random(5);
  for (int i = 0; i < kLines; ++i) {
    // By construction: u and v upright on the way between them.
    const Vector3d u = randomDirection(random), across = u.unitOrthogonal();
    const double angle = random.uniform(0.1, 3), apart = random.uniform(0, 5);
    const Vector3d v = Eigen::AngleAxisd(angle, across) * u;
    const Vector3d on_a = randomPoint(random), on_b = on_a + apart * across;
    const PlueckerLine a = lineAlong(on_a + 3 * u, u), b = lineAlong(on_b - 2 * v, v);
    EXPECT_NEAR(distanceBetween(a, b), apart, 1e-11);
    EXPECT_NEAR(distanceBetween(b, a), apart, 1e-11);
    const NearestPoints nearest = nearestPoints(a, b).value();
    EXPECT_LT((nearest.on_a - on_a).norm(), 1e-10);
    EXPECT_LT((nearest.on_b - on_b).norm(), 1e-10);
    const NearestPoint middle = nearestPoint(std::vector<PlueckerLine>{a, b});
    EXPECT_EQ(middle.status, Status::kOk);
    EXPECT_LT((middle.point - 0.5 * (on_a + on_b)).norm(), 1e-9);
    EXPECT_NEAR(middle.rms, apart / 2, 1e-10);
  }
}

TEST(PlueckerLines, ThatAreParallelHaveADistanceAndNoMeet)
{
  Random random(6);
  for (int i = 0; i < kLines; ++i) {
    const Vector3d u = randomDirection(random), p = randomPoint(random);
    const double apart = random.uniform(0, 5);
    const PlueckerLine a = lineAlong(p, u);
    for (const double way : {1.0, -1.0}) {
      const PlueckerLine b = lineAlong(p + apart * u.unitOrthogonal() + 7 * u, way * u);
      EXPECT_NEAR(distanceBetween(a, b), apart, 1e-11);
      EXPECT_FALSE(nearestPoints(a, b));
      const NearestPoint open = nearestPoint(std::vector<PlueckerLine>{a, b});
      EXPECT_EQ(open.status, Status::kRankDeficient);
      EXPECT_NEAR(distanceTo(a, open.point), apart / 2, 1e-10) << "one of the best";
      EXPECT_NEAR(open.rms, apart / 2, 1e-10);
    }
    const PlaneEquation plane = planeAt(p, u.unitOrthogonal());
    EXPECT_FALSE(meetOf(lineAlong(randomPoint(random), u), plane));
    EXPECT_FALSE(meetOf(plane, planeAt(randomPoint(random), plane.normal)));
    EXPECT_FALSE(meetOf(plane, planeAt(randomPoint(random), -plane.normal)));
  }
}

TEST(PlueckerLines, OfDegenerateFiguresAreNone)
{
  const Vector3d p(1, 2, 3);
  EXPECT_FALSE(lineThrough(p, p));
  EXPECT_FALSE(lineThrough(p, {kNan, 0, 0}));
  EXPECT_FALSE(lineThrough(p, {HUGE_VAL, 0, 0}));
  const PlueckerLine line = *lineThrough(p, {4, -1, 2});
  EXPECT_FALSE(planeThrough(line, p));
  EXPECT_FALSE(planeThrough(line, {kNan, 0, 0}));
  EXPECT_FALSE(meetOf(line, {{kNan, 0, 0}, 1}));
  EXPECT_FALSE(meetOf(PlaneEquation(), {{kNan, 0, 0}, 1}));
}

TEST(NearestPoint, IsWhereAllLinesOrPlanesMeet)
{
  Random random(7);
  for (const double from_origin :
       {0.0, 1e6}) { // as UTM coordinates: 1e-10 m of rounding
    const double tolerance = 1e-9 + 1e-14 * from_origin;
    const Vector3d p = randomPoint(random) + Vector3d::Constant(from_origin);
    std::vector<PlueckerLine> lines;
    std::vector<PlaneEquation> planes;
    for (int i = 0; i < 20; ++i) {
      lines.push_back(lineAlong(p, randomDirection(random)));
      planes.push_back(planeAt(p, randomDirection(random)));
    }
    for (const NearestPoint& nearest : {nearestPoint(lines), nearestPoint(planes)}) {
      EXPECT_EQ(nearest.status, Status::kOk);
      EXPECT_LT((nearest.point - p).norm(), tolerance);
      EXPECT_LT(nearest.rms, tolerance);
    }
  }
}

TEST(NearestPoint, IsTheMinimumOfTheSquares)
{
  Random random(8);
  std::vector<PlueckerLine> lines;
  std::vector<PlaneEquation> planes;
  for (int i = 0; i < 9; ++i) {
    lines.push_back(lineAlong(randomPoint(random), randomDirection(random)));
    planes.push_back(planeAt(randomPoint(random), randomDirection(random)));
  }
  const auto ofLines = [&](const Vector3d& x) {
    double sum = 0;
    for (const auto& line : lines)
      sum += std::pow(distanceTo(line, x), 2);
    return sum;
  };
  const auto ofPlanes = [&](const Vector3d& x) {
    double sum = 0;
    for (const auto& plane : planes)
      sum += std::pow(plane.normal.dot(x) - plane.offset, 2);
    return sum;
  };
  const Vector3d to_lines = nearestPoint(lines).point;
  const Vector3d to_planes = nearestPoint(planes).point;
  EXPECT_NEAR(nearestPoint(lines).rms, std::sqrt(ofLines(to_lines) / 9), 1e-12);
  EXPECT_NEAR(nearestPoint(planes).rms, std::sqrt(ofPlanes(to_planes) / 9), 1e-12);
  for (int i = 0; i < kLines; ++i) {
    const Vector3d aside = 1e-3 * randomDirection(random);
    EXPECT_GT(ofLines(to_lines + aside), ofLines(to_lines));
    EXPECT_GT(ofPlanes(to_planes + aside), ofPlanes(to_planes));
  }
}

TEST(NearestPoint, MovesWithWhatItIsNearTo)
{
  Random random(9);
  const Eigen::Isometry3d T = test::randomPose(random, kExtent, 3);
  std::vector<PlueckerLine> lines, moved_lines;
  std::vector<PlaneEquation> planes, moved_planes;
  for (int i = 0; i < 9; ++i) {
    lines.push_back(lineAlong(randomPoint(random), randomDirection(random)));
    moved_lines.push_back(pcl6d::moved(T, lines.back()));
    planes.push_back(planeAt(randomPoint(random), randomDirection(random)));
    moved_planes.push_back(moved(T, planes.back()));
  }
  EXPECT_LT((T * nearestPoint(lines).point - nearestPoint(moved_lines).point).norm(),
            1e-10);
  EXPECT_LT((T * nearestPoint(planes).point - nearestPoint(moved_planes).point).norm(),
            1e-10);
}

TEST(NearestPoint, SaysWhenItIsOneOfMany)
{
  EXPECT_EQ(nearestPoint(std::vector<PlueckerLine>()).status, Status::kTooFewPairs);
  EXPECT_EQ(nearestPoint(std::vector<PlaneEquation>()).status, Status::kTooFewPairs);
  const PlueckerLine line = lineAlong({1, 2, 3}, Vector3d::UnitZ());
  const NearestPoint on_line = nearestPoint(std::vector<PlueckerLine>{line});
  EXPECT_EQ(on_line.status, Status::kRankDeficient);
  EXPECT_LT((on_line.point - Vector3d(1, 2, 0)).norm(), 1e-12) << "its foot point";
  const NearestPoint on_edge = nearestPoint(
      std::vector<PlaneEquation>{{Vector3d::UnitX(), 1}, {Vector3d::UnitY(), 2}});
  EXPECT_EQ(on_edge.status, Status::kRankDeficient);
  EXPECT_LT((on_edge.point - Vector3d(1, 2, 0)).norm(), 1e-12);
  EXPECT_LT(on_edge.rms, 1e-12);
  EXPECT_EQ(nearestPoint(std::vector<PlaneEquation>{{{kNan, 0, 0}, 1}}).status,
            Status::kDiverged);
}
