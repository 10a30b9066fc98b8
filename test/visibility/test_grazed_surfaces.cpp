// SPDX-License-Identifier: BSD-3-Clause
// Floors far away, which rays meet at a few degrees: rays that miss a point of the floor by the
// width of a cell end on the floor far behind it.
#include "support/points.h"

#include <pcl6d/visibility/sight_evidence.h>

#include <cmath>

namespace {
using pcl6d::passedThrough;
using pcl6d::Points;
using pcl6d::RayImage;
using pcl6d::RayImageOptions;
using pcl6d::Sight;
using pcl6d::SightEvidence;
using pcl6d::sightEvidence;
using pcl6d::SightOfPlace;
using pcl6d::test::badArgumentOf;

constexpr float kOverFloor = 0.9F; // [m] of the scanner over the floor
constexpr double kNoiseOfFloor = 0.005;

/** \return the image of a floor, by rings 0.3 deg apart far away, and 4 deg apart nearby */
RayImage
imageOfFloor()
{
  Points points;
  for (int ring = 0; ring < 25; ++ring) {
    const double degrees = ring < 20 ? 5 + 0.3 * ring : 15 + 4 * (ring - 20);
    const double down = degrees * M_PI / 180;
    const double range = kOverFloor / std::sin(down);
    for (double turn = 0; turn < 2 * M_PI; turn += 0.006)
      points.emplace_back(range * std::cos(down) * std::cos(turn),
                          range * std::cos(down) * std::sin(turn),
                          -kOverFloor);
  }
  RayImageOptions options;
  options.noise = kNoiseOfFloor;
  return RayImage(points, options);
}

/** \return a piece of ground from 3 to 8 m away, so high over the floor */
Points
ground(float over)
{
  Points points;
  for (float x = 3; x < 8; x += 0.05F)
    for (float y = -1; y < 1; y += 0.05F)
      points.emplace_back(x, y, over - kOverFloor);
  return points;
}

SightEvidence
evidenceOn(const Points& points, const Eigen::Vector3f* normal)
{
  pcl6d::PlaceUncertainty uncertainty;
  uncertainty.noise = kNoiseOfFloor;
  const RayImage image = imageOfFloor();
  if (!normal)
    return sightEvidence(
        image, points, Eigen::Isometry3d::Identity(), uncertainty, 0.3);
  const std::vector<Eigen::Vector3f> normals(points.size(), *normal);
  return sightEvidence(image,
                       pcl6d::TestedSurface(points, normals),
                       Eigen::Isometry3d::Identity(),
                       uncertainty,
                       0.3);
}

TEST(GrazedSurfaces, AFloorDoesNotContradictItself)
{
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  EXPECT_GT(evidenceOn(ground(0), nullptr).free, 50u) << "rays end far behind";
  const SightEvidence seen = evidenceOn(ground(0), &up);
  EXPECT_EQ(seen.free, 0u);
  EXPECT_GT(seen.confirmed, 100u);
  EXPECT_EQ(seen.points(), ground(0).size());
}

TEST(GrazedSurfaces, AFloorThatIsTooHighIsContradicted)
{
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  const SightEvidence seen = evidenceOn(ground(0.3F), &up);
  EXPECT_GT(seen.free, seen.confirmed);
  EXPECT_GT(seen.contradicted_patches, seen.confirmed_patches);
}

TEST(GrazedSurfaces, NormalsOfUnknownDirectionChangeNothing)
{
  const Eigen::Vector3f unknown = Eigen::Vector3f::Zero();
  EXPECT_EQ(evidenceOn(ground(0), &unknown).free, evidenceOn(ground(0), nullptr).free);
}

TEST(GrazedSurfaces, ARayPassesThroughByTheDistanceAcross)
{
  SightOfPlace seen;
  seen.sight = Sight::kFree;
  seen.beyond = 0.4F;
  seen.sigmas = 12; // a third of the tolerance is 0.4 / 12: the tolerance is 0.1 m
  const Eigen::Vector3f ray(5, 0, 0);
  EXPECT_TRUE(passedThrough(seen, Eigen::Vector3f::UnitX(), ray));
  EXPECT_TRUE(passedThrough(seen, -Eigen::Vector3f::UnitX(), ray))
      << "from behind as well";
  EXPECT_TRUE(passedThrough(seen, Eigen::Vector3f::Zero(), ray));
  // 0.4 m along the ray are 0.1 m across where the sine of the incidence is a quarter.
  const auto inclined = [](float sine) {
    return Eigen::Vector3f(sine, 0, std::sqrt(1 - sine * sine));
  };
  EXPECT_TRUE(passedThrough(seen, inclined(0.26F), ray));
  EXPECT_FALSE(passedThrough(seen, inclined(0.24F), ray));
}

TEST(GrazedSurfaces, RefuseNormalsThatAreNotOnePerPoint)
{
  const Points points = ground(0);
  const std::vector<Eigen::Vector3f> normals(3, Eigen::Vector3f::UnitZ());
  const RayImage image = imageOfFloor();
  EXPECT_EQ(badArgumentOf([&] {
              (void)sightEvidence(image,
                                  pcl6d::TestedSurface(points, normals),
                                  Eigen::Isometry3d::Identity(),
                                  {},
                                  0.3);
            }),
            "normals = 3, but must be one per point");
}
} // namespace
