// SPDX-License-Identifier: BSD-3-Clause
#include "bodies/body_models.h"

#include <pcl6d/common/error.h>
#include <pcl6d/simulation/body_ways.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
constexpr double kMoment = 0.1; // [s] between looks whether a way is free
constexpr double kWait = 1;     // [s]
constexpr double kRaster = 0.5; // [m] of the floor's height along a way
constexpr double kAhead = 4;    // [s] a goal is where the scanner will be then
constexpr double kRoom = 0.2;   // [m] between bodies
constexpr int kGoals = 40;      // tries to find a goal, before a body waits
constexpr int kDetours = 4;     // tries that may lead around corners, which cost most
constexpr double kDetour = 1.5; // times the straight way, at most
constexpr int kAsides = 2000;   // cheap tries to find a position out of the way
constexpr int kLives = 10;      // tries to lay a whole way
constexpr double kActive = 0.5; // least share of its time in motion

// Radius around its origin, in any orientation.
double
reachOf(const WayRules& rules)
{
  return rules.radius + std::max(-rules.discs.front(), rules.discs.back());
}

Eigen::Vector2d
aheadOf(const Eigen::Vector2d& from, const Eigen::Vector2d& to)
{
  const Eigen::Vector2d leg = to - from;
  return leg.norm() > 0 ? Eigen::Vector2d(leg.normalized()) : Eigen::Vector2d::UnitX();
}

double
lengthOf(const std::vector<Eigen::Vector2d>& corners)
{
  double length = 0;
  for (std::size_t i = 1; i < corners.size(); ++i)
    length += (corners[i] - corners[i - 1]).norm();
  return length;
}

// Radius in plan of a shape on the floor around its origin; its height does not matter.
double
planRadius(const TriangleScene& shape)
{
  double radius = 0;
  for (const auto& vertex : shape.vertices)
    radius = std::max(radius, vertex.head<2>().norm());
  return radius;
}
} // namespace

/** \brief A body on its way. */
struct BodyWays::Walker {
  BodyKind kind;
  WayRules rules;
  double speed; // [m/s]
  Random random;
  std::vector<Eigen::Vector2d> places = {}; // corners in plan
  std::vector<double> times = {};           // [s]
  double moving = 0;                        // [s] of `times` in motion
};

BodyWays::BodyWays(const GroundMap& map, ScannerTrack track, GoalAt goalAt)
: map_(map), track_(std::move(track)), goalAt_(std::move(goalAt))
{
  track_.validate();
}

void
BodyWays::addOther(const MovingBody& body)
{
  body.validate();
  others_.push_back({body, planRadius(body.shape)});
  others_.back().body.shape = {};
}

bool
BodyWays::fits(const WayRules& rules,
               const Eigen::Vector2d& place,
               const Eigen::Vector2d& ahead) const
{
  return std::all_of(rules.discs.begin(), rules.discs.end(), [&](double along) {
    return map_.room(place + along * ahead) >= rules.radius;
  });
}

bool
BodyWays::meetsNobody(const WayRules& rules,
                      const Eigen::Vector2d& place,
                      double time) const
{
  if ((track_.placeAt(time).head<2>() - place).norm() < rules.keep_away)
    return false;
  const double reach = reachOf(rules) + kRoom;
  return std::all_of(others_.begin(), others_.end(), [&](const Other& other) {
    const Eigen::Vector2d there = other.body.poseAt(time).translation().head<2>();
    return (there - place).norm() >= reach + other.radius;
  });
}

bool
BodyWays::isLegal(const Walker& walker,
                  const std::vector<Eigen::Vector2d>& corners,
                  double time) const
{
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Eigen::Vector2d leg = corners[i] - corners[i - 1];
    const Eigen::Vector2d ahead = aheadOf(corners[i - 1], corners[i]);
    const double step = std::min(walker.speed * kMoment, map_.raster().cell / 2);
    const auto steps = std::max(1, static_cast<int>(std::ceil(leg.norm() / step)));
    for (int k = 0; k <= steps; ++k)
      if (!fits(walker.rules, corners[i - 1] + leg * k / steps, ahead))
        return false;
    const double begin = time;
    time += leg.norm() / walker.speed;
    for (double now = begin; now < time + kMoment; now += kMoment) {
      const double part = std::min(1.0, (now - begin) / (time - begin));
      if (!meetsNobody(walker.rules, corners[i - 1] + part * leg, std::min(now, time)))
        return false;
    }
  }
  return true;
}

// Takes a position in view from which a first way exists.
bool
BodyWays::appear(Walker& walker, double time) const
{
  for (int i = 0; i < kGoals; ++i) {
    const Eigen::Vector2d place =
        goalAt_(time, walker.rules.nearest, walker.rules.farthest, walker.random);
    if (map_.room(place) < walker.rules.radius ||
        !meetsNobody(walker.rules, place, time))
      continue;
    walker.places.push_back(place);
    walker.times.push_back(time);
    if (goOn(walker))
      return true;
    walker.places.pop_back();
    walker.times.pop_back();
  }
  return false;
}

// Goes to a goal, if a reachable goal is found.
bool
BodyWays::goOn(Walker& walker) const
{
  const WayRules& rules = walker.rules;
  int detours = 0;
  for (int i = 0; i < kGoals; ++i) {
    const double time = walker.times.back();
    const Eigen::Vector2d from = walker.places.back();
    const Eigen::Vector2d goal =
        goalAt_(time + kAhead, rules.nearest, rules.farthest, walker.random);
    if ((goal - from).norm() < rules.shortest || (goal - from).norm() > rules.longest ||
        map_.room(goal) < rules.radius)
      continue;
    std::vector<Eigen::Vector2d> corners = {from, goal};
    if (!map_.isFree(from, goal, rules.radius)) {
      if (++detours > kDetours)
        continue;
      const double direct = (goal - from).norm();
      corners =
          map_.way(from, goal, rules.radius, std::min(rules.longest, kDetour * direct));
    }
    if (corners.empty() || lengthOf(corners) > rules.longest ||
        !isLegal(walker, corners, time))
      continue;
    follow(walker, corners);
    return true;
  }
  return false;
}

bool
BodyWays::waitAWhile(Walker& walker) const
{
  const double begin = walker.times.back();
  for (double now = begin; now < begin + kWait + kMoment; now += kMoment)
    if (!meetsNobody(walker.rules, walker.places.back(), now))
      return false;
  walker.places.push_back(walker.places.back());
  walker.times.push_back(begin + kWait);
  return true;
}

// Goes out of the scanner's way, to any position.
bool
BodyWays::stepAside(Walker& walker, double time) const
{
  const GroundMap::Raster& raster = map_.raster();
  const Eigen::Array2d size(static_cast<double>(raster.columns),
                            static_cast<double>(raster.rows));
  for (int i = 0; i < kAsides; ++i) {
    const double x = walker.random.uniform();
    const double y = walker.random.uniform();
    const Eigen::Vector2d place =
        raster.low + raster.cell * (Eigen::Array2d(x, y) * size).matrix();
    if (map_.room(place) < reachOf(walker.rules))
      continue;
    walker.places.push_back(place);
    walker.times.push_back(time);
    if (waitAWhile(walker))
      return true;
    walker.places.pop_back();
    walker.times.pop_back();
  }
  return false;
}

bool
BodyWays::isLeftBehind(const Walker& walker) const
{
  const Eigen::Vector2d scanner =
      track_.placeAt(walker.times.back() + kAhead).head<2>();
  return (scanner - walker.places.back()).norm() >
         walker.rules.farthest + walker.rules.longest / 2;
}

void
BodyWays::follow(Walker& walker, const std::vector<Eigen::Vector2d>& corners) const
{
  walker.moving += lengthOf(corners) / walker.speed;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Eigen::Vector2d from = corners[i - 1];
    const Eigen::Vector2d leg = corners[i] - from;
    const auto parts = std::max(1, static_cast<int>(std::ceil(leg.norm() / kRaster)));
    const double begin = walker.times.back();
    for (int k = 1; k <= parts; ++k) {
      walker.places.push_back(from + leg * k / parts);
      walker.times.push_back(begin + leg.norm() * k / parts / walker.speed);
    }
  }
}

// Lives from the start to the end of the track.
bool
BodyWays::complete(Walker& walker) const
{
  const double begin = track_.times.front();
  if (!appear(walker, begin) && !stepAside(walker, begin))
    return false;
  while (walker.times.back() < track_.times.back()) {
    if (isLeftBehind(walker) && appear(walker, walker.times.back()))
      continue;
    const double now = walker.times.back();
    if (!goOn(walker) && !waitAWhile(walker) && !appear(walker, now) &&
        !stepAside(walker, now))
      return false;
  }
  return true;
}

// The first way with enough time in motion, or else the way with the most.
std::optional<BodyWays::Walker>
BodyWays::liveliest(BodyKind kind, std::uint64_t seed) const
{
  const WayRules rules = wayRules(kind);
  const double span = track_.times.back() - track_.times.front();
  std::optional<Walker> best;
  for (std::uint64_t life = 0; life < kLives; ++life) {
    Random random(mixBits(mixBits(seed) ^ life));
    const double speed = random.uniform(rules.slowest, rules.fastest);
    Walker walker{kind, rules, speed, random};
    if (!complete(walker) || (best && walker.moving <= best->moving))
      continue;
    best = std::move(walker);
    if (best->moving >= kActive * span)
      break;
  }
  return best && best->moving > 0 ? best : std::nullopt;
}

MovingBody
BodyWays::add(BodyKind kind, std::uint64_t seed)
{
  const auto walker = liveliest(kind, seed);
  if (!walker)
    throw ComputeFailed(std::string("no room for one more ") + toString(kind) +
                        ": not enough free floor around the scanner's way");
  MovingBody body;
  body.name = toString(kind);
  body.follows_slope = kind == BodyKind::kCar;
  body.shape = kind == BodyKind::kPerson
                   ? simulation::personModel(Random(mixBits(~seed)).uniform(1.55, 1.95))
                   : simulation::carModel();
  body.times = walker->times;
  for (const auto& p : walker->places)
    body.way.emplace_back(p.x(), p.y(), map_.floor(p).value_or(0));
  others_.push_back({body, reachOf(walker->rules)});
  others_.back().body.shape = {};
  return body;
}

} // namespace pcl6d
