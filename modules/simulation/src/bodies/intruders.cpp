// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/random.h>
#include <pcl6d/common/require.h>
#include <pcl6d/simulation/body_ways.h>
#include <pcl6d/simulation/ground_survey.h>
#include <pcl6d/simulation/intruders.h>
#include <pcl6d/visibility/range_noise.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace simulation {
// A direction of sight of a scan in plan, and its range.
struct Sight {
  Eigen::Vector2d direction;
  double range; // [m]
};
} // namespace simulation
using simulation::Sight;

namespace {
constexpr double kNoiseMargin = 3;      // [sigma] by which a body must be nearer
constexpr std::size_t kSights = 512;    // directions kept per scan
constexpr int kViewTries = 8;           // tries to find a position in view
constexpr std::size_t kRayBlock = 4096; // points

// The frame with z along up and an equal origin.
Eigen::Isometry3d
levelFrame(const Eigen::Vector3d& up)
{
  const Eigen::Vector3d z = up.normalized();
  Eigen::Isometry3d T_world_level = Eigen::Isometry3d::Identity();
  if (z == Eigen::Vector3d::UnitZ())
    return T_world_level;
  // x stays as near as possible to the world's x, or to its y if x is up.
  const Eigen::Vector3d side =
      std::abs(z.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d x = (side - side.dot(z) * z).normalized();
  T_world_level.linear() << x, z.cross(x), z;
  return T_world_level;
}

std::vector<Sight>
sightsOf(const Points& level, const Eigen::Vector3d& scanner)
{
  std::vector<Sight> sights;
  const std::size_t step = std::max<std::size_t>(1, level.size() / kSights);
  for (std::size_t i = step / 2; i < level.size(); i += step) {
    const Eigen::Vector2d way = (level[i].cast<double>() - scanner).head<2>();
    if (std::isfinite(way.norm()) && way.norm() > 0)
      sights.push_back({way.normalized(), way.norm()});
  }
  return sights;
}

Points
finite(const Points& points)
{
  Points some;
  for (const auto& p : points)
    if (p.allFinite())
      some.push_back(p);
  return some;
}
} // namespace

void
IntruderOptions::validate() const
{
  require(people >= 0 && people <= kMostBodies, "people", people, "in [0, 200]");
  require(cars >= 0 && cars <= kMostBodies, "cars", cars, "in [0, 200]");
  require(people + cars > 0, "people and cars", 0, "above 0 for people or cars");
  require(up.allFinite() && up.norm() > 0, "up", up.transpose(), "a direction");
}

struct Intruders::Impl {
  IntruderOptions options;
  Trajectory scans; // in the level frame
  Eigen::Isometry3d T_world_level;
  std::vector<std::vector<Sight>> sights; // of each scan
  MovingBodies bodies;

  Eigen::Vector2d
  goalAt(double time, double nearest, double farthest, Random& random) const;
  void
  lay(const GroundMap& map);
};

// A goal in view of the scan at a time, in front of the surfaces it sees.
Eigen::Vector2d
Intruders::Impl::goalAt(double time,
                        double nearest,
                        double farthest,
                        Random& random) const
{
  const auto next = std::upper_bound(scans.stamps.begin(), scans.stamps.end(), time);
  const auto i = static_cast<std::size_t>(
      std::max<std::ptrdiff_t>(next - scans.stamps.begin(), 1) - 1);
  const Eigen::Vector2d scanner = scans.poses[i].translation().head<2>();
  for (int look = 0; look < kViewTries && !sights[i].empty(); ++look) {
    const auto at = static_cast<std::size_t>(random.uniform() *
                                             static_cast<double>(sights[i].size()));
    const Sight& sight = sights[i][at];
    if (sight.range > nearest)
      return scanner +
             random.uniform(nearest, std::min(farthest, sight.range)) * sight.direction;
  }
  return scanner;
}

void
Intruders::Impl::lay(const GroundMap& map)
{
  ScannerTrack track;
  track.times = scans.stamps;
  for (const auto& pose : scans.poses)
    track.places.push_back(pose.translation());
  BodyWays ways(
      map, track, [this](double time, double nearest, double farthest, Random& random) {
        return goalAt(time, nearest, farthest, random);
      });
  std::vector<MovingBody> all;
  std::uint64_t seed = mixBits(options.seed);
  for (int i = 0; i < options.cars; ++i)
    all.push_back(ways.add(BodyKind::kCar, ++seed));
  for (int i = 0; i < options.people; ++i)
    all.push_back(ways.add(BodyKind::kPerson, ++seed));
  bodies = MovingBodies(std::move(all));
}

Intruders::Intruders(const Trajectory& scans,
                     const std::function<Points(std::size_t)>& points,
                     const IntruderOptions& options)
: impl_(std::make_unique<Impl>())
{
  options.validate();
  require(!scans.poses.empty(), "number of scans", scans.poses.size(), ">= 1");
  require(scans.stamps.size() == scans.poses.size(),
          "number of stamps",
          scans.stamps.size(),
          "that of the scans");
  ScannerTrack{scans.stamps, std::vector<Eigen::Vector3d>(scans.poses.size())}
      .validate();
  impl_->options = options;
  impl_->T_world_level = levelFrame(options.up);
  impl_->T_world_level.translation() =
      scans.poses.front().translation(); // floats keep their digits near the scans
  impl_->scans = scans;
  std::vector<Eigen::Vector3d> places;
  for (auto& pose : impl_->scans.poses) {
    pose = impl_->T_world_level.inverse() * pose;
    places.push_back(pose.translation());
  }
  const double reach =
      wayRules(options.cars > 0 ? BodyKind::kCar : BodyKind::kPerson).farthest;
  GroundSurvey survey(places, reach);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Points level = transformed(finite(points(i)), impl_->scans.poses[i]);
    survey.add(i, level);
    impl_->sights.push_back(sightsOf(level, places[i]));
  }
  impl_->lay(survey.map());
}

Intruders::~Intruders() = default;

IntrudedPoints
Intruders::enter(std::size_t i, const Points& measured) const
{
  require(i < impl_->scans.poses.size(), "scan", i, "below the number of scans");
  const double noise = rangeNoise(measured);
  const Eigen::Isometry3d& T_level_scan = impl_->scans.poses[i];
  const double time = impl_->scans.stamps[i];
  const std::uint64_t key = mixBits(mixBits(~impl_->options.seed) ^ i);
  std::vector<IntrudedPoints> parts((measured.size() + kRayBlock - 1) / kRayBlock);
  parallelBlocks(
      measured.size(), kRayBlock, impl_->options.num_threads, [&](const Block& block) {
        IntrudedPoints& part = parts[block.index];
        for (std::size_t k = block.begin; k < block.end; ++k) {
          const Eigen::Vector3d p = measured[k].cast<double>();
          const double range = p.norm();
          if (!std::isfinite(range) || !(range > 0))
            continue;
          const Eigen::Vector3d direction = p / range;
          const auto hit = impl_->bodies.cast(
              {T_level_scan.translation(), T_level_scan.linear() * direction}, time);
          if (!hit || hit->range > range - kNoiseMargin * noise)
            continue;
          Random random(mixBits(key ^ k));
          part.indices.push_back(static_cast<std::uint32_t>(k));
          part.points.emplace_back(
              ((hit->range + noise * random.normal()) * direction).cast<float>());
          part.bodies.push_back(
              static_cast<std::uint32_t>(impl_->bodies.bodyOf(hit->triangle)));
        }
      });
  IntrudedPoints all;
  for (const auto& part : parts) {
    all.indices.insert(all.indices.end(), part.indices.begin(), part.indices.end());
    all.points.insert(all.points.end(), part.points.begin(), part.points.end());
    all.bodies.insert(all.bodies.end(), part.bodies.begin(), part.bodies.end());
  }
  return all;
}

const MovingBody&
Intruders::body(std::size_t i) const
{
  require(i < size(), "body", i, "below the number of bodies");
  return impl_->bodies.body(i);
}

std::size_t
Intruders::size() const
{
  return impl_->bodies.size();
}

const Eigen::Isometry3d&
Intruders::worldFromLevel() const
{
  return impl_->T_world_level;
}

} // namespace pcl6d
