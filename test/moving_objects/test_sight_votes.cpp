// SPDX-License-Identifier: BSD-3-Clause
#include "sight_votes.h"
#include "visibility/rays.h"

#include <deque>

namespace pcl6d::moving_objects {
namespace {

/** Scans of spheres about the scanner, without surfaces unless asked for: of a place within a
 * sphere all of its rays say the same. */
class Spheres : public testing::Test {
protected:
  const SeenScan&
  sphere(double radius)
  {
    RayImageOptions options;
    options.noise = kNoise;
    images_.emplace_back(
        test::scanAround(20000, {0, 0, 0}, [&](auto&&) { return radius; }), options);
    scans_.emplace_back();
    scans_.back().rays = &images_.back();
    return scans_.back();
  }
  /** Gives the scan a wall at x = 3 m as its surface, with or without normals. */
  const SeenScan&
  wallOf(const SeenScan& scan, const Eigen::Vector3f& normal)
  {
    for (float y = -1; y < 1; y += 0.1F)
      for (float z = -1; z < 1; z += 0.1F)
        wall_.emplace_back(3, y, z);
    normals_.assign(wall_.size(), normal);
    tree_ = PointTree(wall_);
    scans_.push_back(scan);
    scans_.back().surface = &wall_;
    scans_.back().normals = &normals_;
    scans_.back().tree = &tree_;
    scans_.back().voxel = 0.1;
    return scans_.back();
  }

  /** \return what observers say of a place at 3 m; their radius by how much later they are */
  ObserverVotes
  asked(const std::vector<std::pair<std::ptrdiff_t, double>>& observers)
  {
    const SeenScan& evaluated = sphere(3);
    std::vector<Observer> candidates;
    for (const auto& [later, radius] : observers)
      candidates.emplace_back(sphere(radius), evaluated, later);
    ObserverVotes votes_of_observers(std::move(candidates), evaluated, places_, 1);
    votes_of_observers.ask({0}, 0, votes_of_observers.choose({0}, observers.size()));
    return votes_of_observers;
  }

  static constexpr double kNoise = 0.01; // [m]
  const Points places_{{3, 0, 0}};
  std::deque<RayImage> images_;
  std::deque<SeenScan> scans_;
  Points wall_;
  Normals normals_;
  PointTree tree_;
};

/** \return the bits of the observers that are so much later */
unsigned
bitsOf(const ObserverVotes& votes_of_observers, std::ptrdiff_t later)
{
  unsigned bits = 0;
  for (std::size_t j = 0; j < votes_of_observers.observers().size(); ++j)
    bits |= votes_of_observers.observers()[j].later() == later ? 1U << j : 0U;
  return bits;
}

TEST_F(Spheres, VoteByWhereTheirRaysEnded)
{
  const ObserverVotes votes_of_observers = asked({{1, 3}, {2, 5}, {3, 2}});
  EXPECT_EQ(votes_of_observers.votes()[0].hits, bitsOf(votes_of_observers, 1));
  EXPECT_EQ(votes_of_observers.votes()[0].misses, bitsOf(votes_of_observers, 2));
  EXPECT_EQ(votes_of_observers.votes()[0].numHits(), 1);
  EXPECT_EQ(votes_of_observers.votes()[0].numMisses(), 1);
  EXPECT_EQ(bitsOf(votes_of_observers, 3), 0u) << "who sees nothing of it is no judge";
}

TEST_F(Spheres, HitsLastIfTheThingWasGoneBetween)
{
  const ObserverVotes votes_of_observers = asked({{1, 3}, {2, 5}, {3, 3}});
  EXPECT_EQ(votes_of_observers.lastingHits(0), bitsOf(votes_of_observers, 3))
      << "seen, gone, seen again";
}

TEST_F(Spheres, HitsBeforeTheFirstMissDoNotLast)
{
  const ObserverVotes votes_of_observers =
      asked({{1, 3}, {2, 3}, {3, 5}, {-1, 3}, {-2, 5}});
  EXPECT_EQ(votes_of_observers.votes()[0].numHits(), 3);
  EXPECT_EQ(votes_of_observers.lastingHits(0), 0) << "it came, stayed and left";
}

TEST_F(Spheres, HitsLastOnTheirSideOfTimeOnly)
{
  const ObserverVotes votes_of_observers = asked({{-1, 5}, {-2, 3}, {1, 3}, {2, 5}});
  EXPECT_EQ(votes_of_observers.lastingHits(0), bitsOf(votes_of_observers, -2));
}

TEST_F(Spheres, TheJuryTakesThoseThatSayMost)
{
  const SeenScan& evaluated = sphere(3);
  const Points places(50, Eigen::Vector3f(3, 0, 0));
  std::vector<Observer> candidates;
  for (int k = 0; k < 40; ++k)
    candidates.emplace_back(sphere(k % 2 == 0 ? 2 : 3), evaluated, k + 1);
  ObserverVotes votes_of_observers(std::move(candidates), evaluated, places, 1);
  std::vector<std::uint32_t> all(places.size());
  for (std::uint32_t i = 0; i < all.size(); ++i)
    all[i] = i;
  EXPECT_EQ(votes_of_observers.choose(all, 8), 8u);
  for (const Observer& observer : votes_of_observers.observers())
    EXPECT_EQ(observer.later() % 2, 0) << "the others see nothing of the places";
  EXPECT_EQ(votes_of_observers.choose(all, 20), 16u) << "a bit for each";
  EXPECT_EQ(votes_of_observers.choose(all, 1), 16u);
}

TEST_F(Spheres, AMissIsFartherBehindThanGrazingExplains)
{
  const Observer observer(sphere(5), sphere(3), 1);
  const Eigen::Vector3f place(3, 0, 0);
  SightOfPlace seen;
  seen.sight = Sight::kFree;
  seen.beyond = 0.4F;
  seen.sigmas = 12; // so that its tolerance is 3 x 0.4 / 12 = 0.1 m
  const auto tilted = [](double slope) {
    return Eigen::Vector3d(slope, 0, std::sqrt(1 - slope * slope)).cast<float>().eval();
  };
  EXPECT_TRUE(observer.isMiss(seen, place, tilted(1)));
  EXPECT_TRUE(observer.isMiss(seen, place, tilted(0.26)))
      << "0.4 m along: 0.104 m across";
  EXPECT_FALSE(observer.isMiss(seen, place, tilted(0.24)));
  EXPECT_FALSE(observer.isMiss(seen, place, -tilted(0.24))) << "whatever side is out";
  EXPECT_TRUE(observer.isMiss(seen, place, {0, 0, 0})) << "not known";
}

TEST_F(Spheres, AJudgeKnowsTheGapsBetweenItsRays)
{
  const SeenScan& evaluated = sphere(3);
  SeenScan moved = sphere(5);
  moved.T_world_scan.translation().x() = 1; // 2 m from the place
  const double cell = moved.rays->resolution();
  EXPECT_NEAR(Observer(moved, evaluated, 1).gapAt({3, 0, 0}), 2 * cell, 1e-6);
}

TEST_F(Spheres, ASurfaceSupportsWhatIsOnIt)
{
  const SeenScan& evaluated = sphere(3);
  const Observer observer(wallOf(sphere(3), {-1, 0, 0}), evaluated, 1);
  ASSERT_TRUE(observer.hasSurface());
  const float sigma = static_cast<float>(std::sqrt(2.0) * kNoise); // of both points
  EXPECT_TRUE(observer.supports({3, 0.03F, 0.02F}));
  EXPECT_TRUE(observer.supports({3 + 2.9F * sigma, 0, 0}));
  // 3 sigma, and what a patch may bend within half a voxel.
  EXPECT_FALSE(observer.supports({3 + 3.1F * sigma + 0.01F, 0, 0}));
  EXPECT_FALSE(observer.supports({3, 1.5F, 0})) << "it has none there";
  EXPECT_TRUE(Observer(sphere(3), evaluated, 1).supports({9, 9, 9}))
      << "it has none at all";
}

TEST_F(Spheres, FromFarRaysTellLessThanASurface)
{
  const SeenScan& evaluated = sphere(3);
  SeenScan far = wallOf(sphere(30), {-1, 0, 0});
  const double cell = far.rays->resolution();
  // 3 sigma of both points and the gap between rays, against 1.75 voxels of 0.1 m.
  const double farthest = (0.175 - 3 * std::sqrt(2.0) * kNoise) / cell;
  far.T_world_scan.translation().x() = 3 - 0.99 * farthest;
  EXPECT_TRUE(Observer(far, evaluated, 1).tellsWhere({3, 0, 0}));
  far.T_world_scan.translation().x() = 3 - 1.01 * farthest;
  EXPECT_FALSE(Observer(far, evaluated, 1).tellsWhere({3, 0, 0}));
}

TEST_F(Spheres, AHitFromFarCountsIfThereIsASurface)
{
  // From 30 m its rays end at the place, within half a metre; its wall is at 3 m.
  const auto hitsOf = [&](const SeenScan& scan) {
    SeenScan far = scan;
    far.T_world_scan.translation().x() = -27;
    ObserverVotes votes_of_observers(
        {Observer(far, sphere(3), 1)}, sphere(3), places_, 1);
    votes_of_observers.ask({0}, 0, votes_of_observers.choose({0}, 1));
    return votes_of_observers.votes()[0].numHits();
  };
  EXPECT_EQ(hitsOf(sphere(30)), 1) << "it has no surfaces to ask";
  const SeenScan& walled = wallOf(sphere(30), {-1, 0, 0});
  EXPECT_EQ(hitsOf(walled), 0);
  for (Eigen::Vector3f& p : wall_)
    p.x() = 30;
  tree_ = PointTree(wall_);
  EXPECT_EQ(hitsOf(walled), 1) << "now the wall is where the place is";
}

TEST_F(Spheres, WithoutANormalTheNearestPointMustBeNear)
{
  const Observer observer(wallOf(sphere(3), {0, 0, 0}), sphere(3), 1);
  EXPECT_TRUE(observer.supports(wall_[205]));
  EXPECT_FALSE(observer.supports(wall_[205] + Eigen::Vector3f(0.06F, 0, 0)));
}

TEST_F(Spheres, CalibratingTakesInHowFarSurfacesAreApart)
{
  Observer observer(wallOf(sphere(3), {-1, 0, 0}), sphere(3), 1);
  const Eigen::Vector3f off(0.08F, 0, 0); // of a pose, say
  EXPECT_FALSE(observer.supports(wall_[205] + off));
  Points few(wall_.begin(), wall_.begin() + 15), sample = wall_;
  for (Eigen::Vector3f& p : few)
    p += off;
  observer.calibrate(few);
  EXPECT_FALSE(observer.supports(wall_[205] + off)) << "15 say too little";
  for (Eigen::Vector3f& p : sample)
    p += off;
  observer.calibrate(sample);
  EXPECT_TRUE(observer.supports(wall_[205] + off));
}

TEST_F(Spheres, AnInexactPoseWidensWhatIsOnASurface)
{
  SeenScan evaluated = sphere(3);
  evaluated.sigma.translation = 0.05;
  const SeenScan& wall = wallOf(sphere(3), {-1, 0, 0});
  EXPECT_TRUE(Observer(wall, evaluated, 1).supports({3.12F, 0, 0}));
  evaluated.sigma = {0, 0.05 / 3}; // [rad] 5 cm at 3 m
  EXPECT_TRUE(Observer(wall, evaluated, 1).supports({3.12F, 0, 0}));
  evaluated.sigma = {};
  EXPECT_FALSE(Observer(wall, evaluated, 1).supports({3.12F, 0, 0}));
}

TEST_F(Spheres, NormalsAreThoseOfTheNearestSurface)
{
  const SeenScan& wall = wallOf(sphere(3), {-1, 0, 0});
  EXPECT_EQ(normalOf(wall, {3.05F, 0, 0}), Eigen::Vector3f(-1, 0, 0));
  EXPECT_TRUE(normalOf(wall, {3.5F, 0, 0}).isZero()) << "too far";
  EXPECT_TRUE(normalOf(sphere(3), {3, 0, 0}).isZero()) << "no surface";
}

} // namespace
} // namespace pcl6d::moving_objects
