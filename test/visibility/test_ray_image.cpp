// SPDX-License-Identifier: BSD-3-Clause
#include "ray_spheres.h"
#include "rays.h"
#include "support/points.h"

#include <pcl6d/visibility/ray_image.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

using pcl6d::Points;
using pcl6d::RayImage;
using pcl6d::RayImageOptions;
using pcl6d::Sight;
using pcl6d::SightOfPlace;
using pcl6d::test::badArgumentOf;
using pcl6d::test::directionOf;
using pcl6d::test::filledOptions;
using pcl6d::test::kAsked;
using pcl6d::test::kCodeTol;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;
using pcl6d::test::kOrigin;
using pcl6d::test::kRadius;
using pcl6d::test::kRays;
using pcl6d::test::placeAt;
using pcl6d::test::scanAround;
using pcl6d::test::sphere;

namespace {
using Vector = Eigen::Vector3d;

/** \return a range that differs in each direction, without edges */
double
wavyRange(const Vector& d)
{
  return 5 + std::sin(7 * d.x() + 1) + std::cos(5 * d.y()) * d.z();
}

/** \return the answers for places before, at and behind a wavy room */
std::vector<SightOfPlace>
answersInWavyRoom(const std::function<Vector(const Vector&)>& moved,
                  double scale,
                  bool reversed = false)
{
  Points scan = scanAround(kRays, Vector::Zero(), wavyRange);
  Points places;
  const double factors[] = {0.3, 0.6, 1, 1.5, 3};
  for (std::size_t i = 0; i < kAsked; ++i)
    places.push_back(placeAt(factors[i % 5] * wavyRange(directionOf(i, kAsked)),
                             directionOf(i, kAsked),
                             Vector::Zero()));
  for (Points* points : {&scan, &places})
    for (auto& p : *points)
      p = (scale * moved(p.cast<double>())).cast<float>();
  if (reversed)
    std::reverse(scan.begin(), scan.end());
  RayImageOptions options;
  options.noise = 0.01 * scale;
  const RayImage image(scan, options);
  std::vector<SightOfPlace> answers;
  for (const auto& place : places)
    answers.push_back(image.look(place, static_cast<float>(0.02 * scale)));
  return answers;
}

Vector
unmoved(const Vector& p)
{
  return p;
}
} // namespace

TEST(RayImage, SaysOfEachPlaceInASphereWhatItsRaysSaw)
{
  const RayImage image(sphere(), filledOptions());
  for (std::size_t i = 0; i < kAsked; ++i) {
    const Vector d = directionOf(i, kAsked);
    EXPECT_EQ(image.look(placeAt(kRadius, d), 0).sight, Sight::kConfirmed) << i;
    EXPECT_EQ(image.look(placeAt(1.5 * kRadius, d), 0).sight, Sight::kBehind) << i;
    const SightOfPlace before = image.look(placeAt(0.5 * kRadius, d), 0);
    EXPECT_EQ(before.sight, Sight::kFree) << i;
    EXPECT_NEAR(before.beyond, 0.5 * kRadius, kCodeTol * kRadius) << i;
  }
  EXPECT_EQ(image.look(kOrigin.cast<float>(), 0).sight, Sight::kUnseen);
  EXPECT_EQ(image.origin(), kOrigin.cast<float>());
  EXPECT_EQ(image.noise(), 0.01);
}

TEST(RayImage, ToleratesThreeDeviationsAndTheWidthOfACell)
{
  constexpr double kNoise = 0.03, kSigma = 0.04; // [m]: 0.05 together
  const RayImage image(sphere(), filledOptions(kNoise));
  const double cell = image.resolution();
  ASSERT_NEAR(cell, 0.05, 0.001);
  const double nearest = (kRadius - 3 * 0.05) / (1 + cell); // where they are equal
  const double farthest = (kRadius + 3 * 0.05) / (1 - cell);
  for (std::size_t i = 0; i < kAsked; ++i) {
    const Vector d = directionOf(i, kAsked);
    const auto sightAt = [&](double range) {
      return image.look(placeAt(range, d), static_cast<float>(kSigma)).sight;
    };
    EXPECT_EQ(sightAt(nearest * (1 - 2 * kCodeTol)), Sight::kFree) << i;
    EXPECT_EQ(sightAt(nearest * (1 + 2 * kCodeTol)), Sight::kConfirmed) << i;
    EXPECT_EQ(sightAt(farthest * (1 - 2 * kCodeTol)), Sight::kConfirmed) << i;
    EXPECT_EQ(sightAt(farthest * (1 + 2 * kCodeTol)), Sight::kBehind) << i;
  }
}

TEST(RayImage, TellsHowManyDeviationsItIsBeyond)
{
  const RayImage image(sphere(), filledOptions(0.03));
  const double tolerance = 3 * 0.05 + image.resolution() * 0.5 * kRadius;
  const SightOfPlace seen = image.look(placeAt(0.5 * kRadius, {0, 0.6, 0.8}), 0.04F);
  EXPECT_NEAR(seen.sigmas, 3 * seen.beyond / tolerance, 1e-4 * seen.sigmas);
}

TEST(RayImage, ConfirmsMoreTheLessThePlaceIsKnown)
{
  const RayImage image(sphere(), filledOptions());
  const Eigen::Vector3f place = placeAt(0.9 * kRadius, {0.6, 0, -0.8});
  EXPECT_EQ(image.look(place, 0).sight, Sight::kFree);
  EXPECT_EQ(image.look(place, 0.05F).sight, Sight::kFree);
  EXPECT_EQ(image.look(place, 0.2F).sight, Sight::kConfirmed);
}

TEST(RayImage, SaysNothingWhereNothingWasMeasured)
{
  const Points cap = scanAround(
      kRays, kOrigin, [](const Vector& d) { return d.z() > 0.5 ? kRadius : 0; });
  RayImageOptions options; // with the coarse cells, too
  options.origin = kOrigin.cast<float>();
  const RayImage image(cap, options);
  const double widest = 3 * 0.07; // [rad] that a halo reaches beyond the last ray
  for (std::size_t i = 0; i < kAsked; ++i) {
    const Vector d = directionOf(i, kAsked);
    const double angle = std::acos(d.z()) - std::acos(0.5); // beyond the cap
    for (const double factor : {0.5, 1.0, 1.5}) {
      const Sight sight = image.look(placeAt(factor * kRadius, d), 0).sight;
      if (angle > widest) {
        EXPECT_EQ(sight, Sight::kUnseen) << d.transpose();
      }
      else if (angle < -0.1) {
        EXPECT_NE(sight, Sight::kUnseen) << d.transpose();
      }
    }
  }
}

TEST(RayImage, SeesTheWallsOfABoxFromAnyPlaceInIt)
{
  const Eigen::AlignedBox3d room(Vector(-4, -3, -1), Vector(6, 3, 2));
  for (const Vector& origin :
       {Vector(0, 0, 0), Vector(4.5, -2, 1), Vector(-3, 2, -0.5)}) {
    const auto range = [&](const Vector& d) {
      double nearest = 1e9;
      for (int axis = 0; axis < 3; ++axis)
        if (d[axis] != 0)
          nearest = std::min(
              nearest,
              ((d[axis] > 0 ? room.max() : room.min())[axis] - origin[axis]) / d[axis]);
      return nearest;
    };
    std::size_t confirmed = 0;
    RayImageOptions options;
    options.origin = origin.cast<float>();
    const RayImage image(scanAround(2 * kRays, origin, range), options);
    for (std::size_t i = 0; i < kAsked; ++i) {
      const Vector d = directionOf(i, kAsked);
      const auto sightAt = [&](double factor) {
        return image.look(placeAt(factor * range(d), d, origin), 0).sight;
      };
      // Along a wall at a grazing angle the ends of the rays around may be far apart.
      confirmed += sightAt(1) == Sight::kConfirmed ? 1 : 0;
      EXPECT_TRUE(sightAt(1) == Sight::kConfirmed || sightAt(1) == Sight::kEdge)
          << d.transpose();
      EXPECT_EQ(sightAt(0.6), Sight::kFree) << d.transpose();
      EXPECT_EQ(sightAt(1.6), Sight::kBehind) << d.transpose();
    }
    EXPECT_GT(confirmed, 0.9 * kAsked);
  }
}

TEST(RayImage, LooksAcrossTheEdgesOfTheCubeAsElsewhere)
{
  // In each direction another range: a wrong neighbour would show in `beyond`.
  const auto range = [](const Vector& d) {
    return 10 + 2 * d.x() + 1.5 * d.y() + d.z(); // [m]; changes by 2.7 m/rad at most
  };
  const RayImage image(scanAround(kRays, Vector::Zero(), range),
                       filledOptions(0.01, Vector::Zero()));
  const double halo = 2.7 * 2 * std::sqrt(2.0) * 1.3 * image.resolution();
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (double z = -1; z <= 1; z += 0.01)
        for (const double aside : {-0.02, -0.001, 0.001, 0.02})
          for (int turn = 0; turn < 3; ++turn) {
            const Vector on_edge(x * (1 + aside), y, z);
            const Vector d =
                Vector(on_edge[turn], on_edge[(turn + 1) % 3], on_edge[(turn + 2) % 3])
                    .normalized();
            const SightOfPlace seen = image.look((3 * d).cast<float>(), 0);
            ASSERT_EQ(seen.sight, Sight::kFree) << d.transpose();
            EXPECT_LE(seen.beyond, range(d) - 3 + 0.01) << d.transpose();
            EXPECT_GE(seen.beyond, range(d) - 3 - halo) << d.transpose();
          }
}

TEST(RayImage, NeverTakesTheEdgeOfANearObjectForFree)
{
  constexpr double kNear = 2, kFar = 10; // [m]
  struct Object {
    const char* name;
    std::function<bool(const Vector&)> holds;
  };
  const auto cap = [](const Vector& centre) {
    return [centre](const Vector& d) {
      return d.dot(centre.normalized()) > std::cos(0.3);
    };
  };
  // Its edge lies on that of the cube: at 45 degrees.
  const Vector touching(std::cos(M_PI / 4 - 0.3), std::sin(M_PI / 4 - 0.3), 0);
  const Object objects[] = {{"within a face", cap({1, 0.1, 0.2})},
                            {"across an edge", cap({1, -1, 0})},
                            {"across a corner", cap({-1, 1, -1})},
                            {"up to an edge", cap(touching)},
                            {"a whole face", [](const Vector& d) {
                               return d.y() > std::abs(d.x()) &&
                                      d.y() > std::abs(d.z());
                             }}};
  for (const Object& object : objects) {
    SCOPED_TRACE(object.name);
    const Points scan = scanAround(kRays, kOrigin, [&](const Vector& d) {
      return object.holds(d) ? kNear : kFar;
    });
    const RayImage image(scan, filledOptions());
    const double aside = 0.4 * image.resolution(); // beam width, error of the pose
    for (std::size_t i = 0; i < 20 * kAsked; ++i) {
      const Vector d = directionOf(i, 20 * kAsked);
      const bool near = object.holds(d);
      const Vector shifted =
          (d + aside * d.cross(directionOf((i * 7) % kAsked, kAsked))).normalized();
      const double surface = near ? kNear : kFar;
      EXPECT_NE(image.look(placeAt(surface, shifted), 0).sight, Sight::kFree)
          << d.transpose();
      // Between both: hidden or free, or no answer; before both: free.
      const Sight between = image.look(placeAt(5, d), 0).sight;
      EXPECT_TRUE(between == (near ? Sight::kBehind : Sight::kFree) ||
                  between == Sight::kEdge)
          << d.transpose() << ": " << toString(between);
      EXPECT_EQ(image.look(placeAt(1, d), 0).sight, Sight::kFree) << d.transpose();
    }
  }
}

TEST(RayImage, AnswersTheSameInOtherUnits)
{
  const auto expected = answersInWavyRoom(unmoved, 1);
  for (const double scale : {100.0, 0.01}) {
    const auto found = answersInWavyRoom(unmoved, scale);
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].sight, expected[i].sight) << "place " << i;
      EXPECT_NEAR(found[i].beyond / scale, expected[i].beyond, 2 * kCodeTol * 8);
    }
  }
}

TEST(RayImage, AnswersTheSameTurnedAboutTheAxes)
{
  const auto expected = answersInWavyRoom(unmoved, 1);
  const Eigen::Matrix3d third =
      Eigen::Matrix3d(Eigen::AngleAxisd(2 * M_PI / 3, Vector::Ones().normalized()))
          .array()
          .round();
  const Eigen::Matrix3d quarter =
      Eigen::Matrix3d(Eigen::AngleAxisd(M_PI / 2, Vector::UnitZ())).array().round();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  for (int turn = 0; turn < 24; ++turn) {
    R = (turn % 2 == 0 ? third : quarter) * R;
    const auto found =
        answersInWavyRoom([&](const Vector& p) -> Vector { return R * p; }, 1);
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].sight, expected[i].sight) << "place " << i << "\n" << R;
      ASSERT_NEAR(found[i].beyond, expected[i].beyond, 1e-5) << "place " << i;
    }
  }
}

TEST(RayImage, DoesNotDependOnTheOrderOfThePoints)
{
  const auto expected = answersInWavyRoom(unmoved, 1);
  const auto found = answersInWavyRoom(unmoved, 1, true);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].sight, expected[i].sight);
    EXPECT_EQ(found[i].beyond, expected[i].beyond);
    EXPECT_EQ(found[i].sigmas, expected[i].sigmas);
  }
}

TEST(RayImage, LooksFromMillimetresToAHundredKilometres)
{
  for (double radius = 1e-3; radius < 2e5; radius *= 10) {
    const RayImage image(sphere(radius, Vector::Zero()),
                         filledOptions(0.001 * radius, Vector::Zero()));
    for (std::size_t i = 0; i < 100; ++i) {
      const Vector d = directionOf(i, 100);
      const auto at = [&](double factor) {
        return image.look((factor * radius * d).cast<float>(), 0);
      };
      EXPECT_EQ(at(1).sight, Sight::kConfirmed) << radius;
      EXPECT_EQ(at(1.1).sight, Sight::kBehind) << radius;
      EXPECT_EQ(at(0.9).sight, Sight::kFree) << radius;
      EXPECT_NEAR(at(0.5).beyond, 0.5 * radius, kCodeTol * radius) << radius;
    }
  }
}

TEST(RayImage, TakesCoarserCellsForASparseScan)
{
  const double spacings[] = {0.005, 0.02, 0.06}; // [rad]
  double finer = 0;
  for (const double spacing : spacings) {
    const auto rays = static_cast<std::size_t>(4 * M_PI / (spacing * spacing));
    const RayImage image(
        scanAround(rays, Vector::Zero(), [](const Vector&) { return 5.0; }));
    EXPECT_GT(image.resolution(), finer);
    EXPECT_LT(image.resolution(), 1.5 * 1.1 * std::max(spacing, 0.0061));
    finer = image.resolution();
    for (std::size_t i = 0; i < 100; ++i)
      EXPECT_EQ(image.look((4 * directionOf(i, 100)).cast<float>(), 0).sight,
                Sight::kFree)
          << spacing;
  }
}

TEST(RayImage, AnswersWithCoarseOptionsWhereTheRaysAreFarApart)
{
  constexpr std::size_t kFew = 1000; // 0.11 rad apart
  const Points few =
      scanAround(kFew, Vector::Zero(), [](const Vector&) { return 5.0; });
  const RayImage usual(few), coarse(few, RayImageOptions::coarse());
  EXPECT_EQ(usual.resolution(), 0);
  EXPECT_GT(coarse.resolution(), 0.09);
  EXPECT_EQ(coarse.noise(), 0);
  for (std::size_t i = 0; i < 100; ++i) {
    const Eigen::Vector3f direction = directionOf(i, 100).cast<float>();
    EXPECT_EQ(usual.look(3 * direction, 0).sight, Sight::kUnseen);
    EXPECT_EQ(coarse.look(3 * direction, 0).sight, Sight::kFree);
    EXPECT_EQ(coarse.look(3 * direction, 1).sight, Sight::kConfirmed) << "3 sigma";
    EXPECT_EQ(coarse.look(8 * direction, 0).sight, Sight::kBehind);
  }
}

TEST(RayImage, SaysOfManyPlacesWhatItSaysOfEach)
{
  const RayImage image(scanAround(kRays, kOrigin, wavyRange), filledOptions());
  Points places{{kNan, 0, 0}, kOrigin.cast<float>(), {1e30F, 0, 0}};
  std::vector<float> sigmas{0.1F, 0.1F, 0.1F};
  for (std::size_t i = 0; i < 100; ++i) { // no multiple of what is fetched at once
    places.push_back(placeAt(3 + 0.05 * static_cast<double>(i), directionOf(i, 100)));
    sigmas.push_back(0.01F * static_cast<float>(i));
  }
  const auto expectSame = [&](const RayImage& asked, const std::vector<float>& of_all) {
    const std::vector<SightOfPlace> seen = asked.look(places, of_all);
    ASSERT_EQ(seen.size(), places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const SightOfPlace one =
          asked.look(places[i], of_all.size() == 1 ? of_all[0] : of_all[i]);
      EXPECT_EQ(seen[i].sight, one.sight) << i;
      EXPECT_EQ(seen[i].beyond, one.beyond) << i;
      EXPECT_EQ(seen[i].sigmas, one.sigmas) << i;
    }
  };
  expectSame(image, sigmas);
  expectSame(image, {0.05F});
  expectSame(RayImage(), sigmas);
  EXPECT_TRUE(image.look({}, std::vector<float>{}).empty());
  EXPECT_NE(badArgumentOf([&] { image.look(places, {0.1F, 0.2F}); }), "");
}
