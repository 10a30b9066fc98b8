// SPDX-License-Identifier: BSD-3-Clause
// The step that brings common surfaces together.
#include "fit_options.h"
#include "support/points.h"

using pcl6d::fitSurfaces;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::SurfaceFit;
using pcl6d::SurfaceFitOptions;
using pcl6d::VerifiedScan;
using pcl6d::test::badArgumentOf;
using pcl6d::test::fitOptions;
using pcl6d::test::kNan;
using pcl6d::test::kVoxel;
using pcl6d::test::shifted;
using pcl6d::test::VerifiedScans;
using Vector = Eigen::Vector3d;

namespace {
/** [m] Reduced points at an edge are means of two walls, and differ between scans. */
constexpr double kRestTol = 0.02 * kVoxel;

/** \return points of a grid on the walls of a box [m] about the origin, without noise:
 * spaced by 0.1 m, beginning at a phase [m] */
Points
box(const Vector& half, double phase, const Eigen::Isometry3d& T_scan_box)
{
  Points points;
  for (int axis = 0; axis < 3; ++axis)
    for (double u = -half[(axis + 1) % 3] + phase; u < half[(axis + 1) % 3]; u += 0.1)
      for (double v = -half[(axis + 2) % 3] + phase; v < half[(axis + 2) % 3]; v += 0.1)
        for (const double side : {-1, 1}) {
          Vector p;
          p[axis] = side * half[axis];
          p[(axis + 1) % 3] = u;
          p[(axis + 2) % 3] = v;
          points.push_back((T_scan_box * p).cast<float>());
        }
  return points;
}

/** \brief Two scans of a box, of different points, with their true pose. */
struct Boxes {
  explicit Boxes(double scale = 1)
  {
    const Vector half(2.5, 2, 1.3);
    const Points clouds[] = {box(half, 0.02, Eigen::Isometry3d::Identity()),
                             box(half, 0.07, T_first_second.inverse())};
    for (const Points& points : clouds)
      scans.add(pcl6d::test::ScannedPair::scaled(points, scale), scale * kVoxel);
    T_first_second.translation() *= scale;
  }
  Eigen::Isometry3d T_first_second =
      pcl6d::poseFromEuler({0.3, -0.2, 0.1}, {0, 0.1, 1});
  VerifiedScans scans;

  SurfaceFit
  fit(const Eigen::Isometry3d& T, const SurfaceFitOptions& options = fitOptions()) const
  {
    return fitSurfaces(scans[0], scans[1], T, options);
  }
};
} // namespace

TEST(SurfaceFit, StaysAtTheTruePose)
{
  const Boxes boxes;
  const SurfaceFit fit = boxes.fit(boxes.T_first_second);
  EXPECT_GT(fit.pairs, 1000u);
  EXPECT_GT(fit.overlap, 0.95);
  EXPECT_LT(fit.displacement(), kRestTol);
  EXPECT_EQ(fit.open_directions, 0);
}

TEST(SurfaceFit, StepsBackByTheWholeShift)
{
  const Boxes boxes;
  constexpr double kShare = 0.1; // at corners pairs are of two walls
  for (const double way : {0.02, 0.05, 0.1})
    for (const Vector& to : {Vector(1, 0, 0), Vector(0, -1, 0), Vector(2, 1, 2)}) {
      const Vector shift = way * to.normalized();
      const SurfaceFit fit = boxes.fit(shifted(boxes.T_first_second, shift));
      EXPECT_NEAR(fit.displacement(), way, kShare * way + kRestTol);
      EXPECT_LT((fit.step.head<3>() + shift).norm(), kShare * way + kRestTol)
          << shift.transpose();
    }
}

TEST(SurfaceFit, StepsBackByATurn)
{
  const Boxes boxes;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector turn = 0.02 * Vector::Unit(axis); // [rad]
    Eigen::Isometry3d T = boxes.T_first_second;
    const Vector centroid = boxes.fit(T).centroid;
    T = Eigen::Translation3d(centroid) * Eigen::AngleAxisd(0.02, Vector::Unit(axis)) *
        Eigen::Translation3d(-centroid) * T;
    const SurfaceFit fit = boxes.fit(T);
    EXPECT_LT((fit.step.tail<3>() + turn).norm(), 0.15 * 0.02) << axis;
    EXPECT_LT(fit.step.head<3>().norm(), 0.1 * 0.02 * fit.spread) << axis;
  }
}

TEST(SurfaceFit, DoesNotDependOnUnits)
{
  const Boxes metres;
  const SurfaceFit fit = metres.fit(shifted(metres.T_first_second, {0.05, 0.03, 0.02}));
  for (const double scale : {1.0 / 128, 128.0}) { // exact in float
    const Boxes other(scale);
    const SurfaceFit scaled =
        other.fit(shifted(other.T_first_second, scale * Vector(0.05, 0.03, 0.02)),
                  fitOptions(scale));
    EXPECT_EQ(scaled.pairs, fit.pairs);
    EXPECT_EQ(scaled.overlap, fit.overlap);
    EXPECT_EQ(scaled.open_directions, fit.open_directions);
    EXPECT_NEAR(scaled.displacement(), scale * fit.displacement(), 1e-6 * scale);
    EXPECT_NEAR(scaled.deviation(), scale * fit.deviation(), 1e-6 * scale);
    EXPECT_NEAR(scaled.mahalanobisSq() / fit.mahalanobisSq(), 1, 1e-6);
  }
}

TEST(SurfaceFit, TakesTheInverseStepTheOtherWayRound)
{
  const Boxes boxes;
  const Eigen::Isometry3d T = shifted(boxes.T_first_second, {0.05, 0.03, 0.02});
  const SurfaceFit there = boxes.fit(T);
  const SurfaceFit back =
      fitSurfaces(boxes.scans[1], boxes.scans[0], T.inverse(), fitOptions());
  EXPECT_EQ(back.pairs, there.pairs);
  EXPECT_EQ(back.overlap, there.overlap);
  EXPECT_NEAR(back.residual, there.residual, 1e-9);
  EXPECT_LT((T.linear() * back.step.head<3>() + there.step.head<3>()).norm(), 0.002);
  EXPECT_NEAR(back.deviation() / there.deviation(), 1, 0.2) << "cubes lie elsewhere";
}

TEST(SurfaceFit, WithoutCovarianceIsTheSameStep)
{
  const Boxes boxes;
  SurfaceFitOptions options = fitOptions();
  const SurfaceFit with = boxes.fit(boxes.T_first_second, options);
  options.covariance = false;
  const SurfaceFit without = boxes.fit(boxes.T_first_second, options);
  EXPECT_EQ(without.step, with.step);
  EXPECT_TRUE(without.covariance.isZero(0));
  EXPECT_FALSE(with.covariance.isZero(0));
}

TEST(SurfaceFit, DoesNotPairTheTwoFacesOfAWall)
{
  // A wall of 6 cm, seen from the left by one scan, from the right by the other.
  Random random(9);
  VerifiedScans scans;
  for (const double side : {1, -1}) {
    Points wall;
    for (int k = 0; k < 6000; ++k)
      wall.emplace_back(static_cast<float>(side * 2),
                        static_cast<float>(random.uniform(-2, 2)),
                        static_cast<float>(random.uniform(-2, 2)));
    scans.add(wall);
  }
  const SurfaceFit fit = fitSurfaces(
      scans[0], scans[1], pcl6d::poseFromEuler({4.06, 0, 0}, {}), fitOptions());
  EXPECT_EQ(fit.pairs, 0u);
}

TEST(SurfaceFit, OfScansApartIsNothing)
{
  const Boxes boxes;
  const SurfaceFit fit = boxes.fit(shifted(boxes.T_first_second, {50, 0, 0}));
  EXPECT_EQ(fit.pairs, 0u);
  EXPECT_EQ(fit.overlap, 0);
  EXPECT_EQ(fit.displacement(), 0);
  EXPECT_EQ(fit.deviation(), 0);
  EXPECT_EQ(fit.mahalanobisSq(), 0);
}

TEST(SurfaceFit, OfEmptyAndTinyScansIsNothing)
{
  const Boxes boxes;
  VerifiedScans small;
  small.add({});
  small.add({{1, 2, 1}});
  for (std::size_t i = 0; i < 2; ++i)
    for (const VerifiedScan* other : {&boxes.scans[0], &small[0], &small[1]}) {
      const SurfaceFit fit =
          fitSurfaces(*other, small[i], Eigen::Isometry3d::Identity(), fitOptions());
      EXPECT_LT(fit.pairs, 3u);
      EXPECT_EQ(fit.displacement(), 0);
      EXPECT_TRUE(fit.covariance.isZero(0));
    }
}

TEST(SurfaceFit, NamesTheOptionThatBreaksItsRule)
{
  const Boxes boxes;
  const auto errorOf = [&](auto change) {
    SurfaceFitOptions options;
    change(options);
    return badArgumentOf([&] { boxes.fit(boxes.T_first_second, options); });
  };
  EXPECT_EQ(errorOf([](auto& o) { o.max_distance = 0; }),
            "max_distance = 0, but must be finite and > 0");
  EXPECT_EQ(errorOf([](auto& o) { o.max_distance = kNan; }),
            "max_distance = nan, but must be finite and > 0");
  EXPECT_EQ(errorOf([](auto& o) { o.points = 0; }), "points = 0, but must be > 0");
  for (const float wrong : {0.0F, -1.0F, kNan, pcl6d::test::kInfinity})
    EXPECT_EQ(
        errorOf([wrong](auto& o) { o.cube_voxels = wrong; }).find("cube_voxels = "), 0u)
        << wrong;
  EXPECT_EQ(errorOf([](auto& o) { o.shared_error = -0.5; }),
            "shared_error = -0.5, but must be finite and >= 0");
  EXPECT_EQ(errorOf([](auto& o) { o.shared_error = kNan; }),
            "shared_error = nan, but must be finite and >= 0");
}
