// SPDX-License-Identifier: BSD-3-Clause
#include "change_box.h"
#include "moved_things.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace pcl6d::moving_objects {

namespace {
/** [voxels] Largest difference of the edges of similar boxes, half for the error of each end;
 * in addition the hidden share, on one side only. */
constexpr double kEdgeVoxels = 2;
constexpr double kEdgeShare = 0.25;

/** Objects with fewer voxels have no recognisable shape. */
constexpr std::size_t kLeastOfShape = 20;

/** Least share of points within a voxel of the second object, for the less visible object ... */
constexpr double kLeastOfLess = 0.9;
/** ... and for the more visible: of two views of a box, from three sides and from two, two
 * thirds overlap. */
constexpr double kLeastOfMore = 0.65;

/** Number of matched points of an object, from starts every 15 degrees about the vertical. */
constexpr std::size_t kPoints = 400;
constexpr int kTurnsTried = 24;
constexpr std::size_t kPolished = 4; ///< number of best starts that are refined
constexpr int kSteps = 20;           ///< iterations of matching

/** An object prepared for matching. */
struct Shape {
  explicit Shape(const Change& thing) : box(thing.box)
  {
    const std::size_t stride = std::max<std::size_t>(1, thing.points.size() / kPoints);
    for (std::size_t i = 0; i < thing.points.size(); i += stride)
      points.push_back(thing.points[i]);
    tree = PointTree(thing.points, 1);
    all = &thing.points;
  }

  ChangeBox box;
  Points points;
  const Points* all;
  PointTree tree;
};

/** \return whether two edges of the boxes are equal; one side of the third may be hidden */
bool
areAlike(const ChangeBox& a, const ChangeBox& b, double voxel)
{
  const auto isEqual = [&](double first, double second) {
    return std::abs(first - second) <=
           std::max(kEdgeVoxels * voxel, kEdgeShare * std::max(first, second));
  };
  Eigen::Vector3d first = a.size, second = b.size;
  std::sort(first.data(), first.data() + 3);
  std::sort(second.data(), second.data() + 3);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) // the excluded edges
      if (isEqual(first[i == 0 ? 1 : 0], second[k == 0 ? 1 : 0]) &&
          isEqual(first[i == 2 ? 1 : 2], second[k == 2 ? 1 : 2]))
        return true;
  return false;
}

/** \return the share of points with a partner after a motion */
double
meeting(const Shape& of, const Shape& on, const Eigen::Isometry3d& motion, double reach)
{
  std::size_t met = 0;
  for (const auto& p : of.points)
    met += on.tree.hasNeighbour((motion * p.cast<double>()).cast<float>(),
                                static_cast<float>(reach * reach))
               ? 1
               : 0;
  return static_cast<double>(met) / static_cast<double>(of.points.size());
}

/** A motion and the quality of its fit. */
struct Fit {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  double less = 0, more = 0; ///< the smaller and the larger share of paired points

  double
  agreement() const
  {
    return (less + more) / 2;
  }
  bool
  isOneThing() const
  {
    return less >= kLeastOfMore && more >= kLeastOfLess;
  }
};

Fit
fitAt(const Shape& from, const Shape& to, const Eigen::Isometry3d& motion, double reach)
{
  const double there = meeting(from, to, motion, reach);
  const double back = meeting(to, from, motion.inverse(), reach);
  return {motion, std::min(there, back), std::max(there, back)};
}

/** Pairs of points in both directions, by nearest neighbour. */
struct MetPairs {
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> pairs; ///< from, to

  void
  add(const Shape& of,
      const Shape& on,
      const Eigen::Isometry3d& motion,
      double reach,
      bool is_forward)
  {
    for (const auto& p : of.points) {
      const Eigen::Vector3f place = (motion * p.cast<double>()).cast<float>();
      const Neighbour near = on.tree.nearest(place, static_cast<float>(reach * reach));
      if (near.index < 0)
        continue;
      const Eigen::Vector3d own = p.cast<double>();
      const Eigen::Vector3d other =
          (*on.all)[static_cast<std::size_t>(near.index)].cast<double>();
      pairs.emplace_back(is_forward ? own : other, is_forward ? other : own);
    }
  }
};

/** Point to point, both ways, by the singular values of Arun et al. (1987). */
Eigen::Isometry3d
polished(const Shape& from, const Shape& to, Eigen::Isometry3d motion, double voxel)
{
  double reach = 4 * voxel;
  for (int k = 0; k < kSteps; ++k) {
    MetPairs met;
    met.add(from, to, motion, reach, true);
    met.add(to, from, motion.inverse(), reach, false);
    constexpr std::size_t kLeastPairs = 6;
    if (met.pairs.size() < kLeastPairs)
      return motion;
    Eigen::Vector3d mean_from = Eigen::Vector3d::Zero(),
                    mean_to = Eigen::Vector3d::Zero();
    for (const auto& [p, q] : met.pairs) {
      mean_from += p / static_cast<double>(met.pairs.size());
      mean_to += q / static_cast<double>(met.pairs.size());
    }
    Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
    for (const auto& [p, q] : met.pairs)
      S += (q - mean_to) * (p - mean_from).transpose();
    motion.linear() = nearestRotation(S);
    motion.translation() = mean_to - motion.linear() * mean_from;
    reach = std::max(1.5 * voxel, 0.85 * reach);
  }
  return motion;
}

/** \return start motions: turns about the vertical, and every orientation of one box in the
 * other, because objects fall over */
std::vector<Eigen::Isometry3d>
startsOf(const Shape& from, const Shape& to, const Eigen::Vector3d& up)
{
  std::vector<Eigen::Matrix3d> turns;
  turns.reserve(kTurnsTried + 24); // a box has 24 orientations in itself
  for (int k = 0; k < kTurnsTried; ++k)
    turns.push_back(rotationFromVector(radians(360.0 * k / kTurnsTried) * up));
  const Eigen::Matrix3d from_box = from.box.T_world_box.linear().transpose();
  std::array<int, 3> order{0, 1, 2};
  do
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d laid = Eigen::Matrix3d::Zero();
      for (int k = 0; k < 3; ++k)
        laid(order[static_cast<std::size_t>(k)], k) = (signs >> k & 1) != 0 ? -1 : 1;
      if (laid.determinant() > 0)
        turns.push_back(to.box.T_world_box.linear() * laid * from_box);
    }
  while (std::next_permutation(order.begin(), order.end()));
  std::vector<Eigen::Isometry3d> starts;
  for (const Eigen::Matrix3d& turn : turns) {
    Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
    start.linear() = turn;
    start.translation() =
        to.box.T_world_box.translation() - turn * from.box.T_world_box.translation();
    starts.push_back(start);
  }
  return starts;
}

Fit
fitOf(const Change& vanished, const Change& appeared, const RunChangesOptions& options)
{
  const Shape from(vanished), to(appeared);
  std::vector<Fit> starts;
  for (const Eigen::Isometry3d& start : startsOf(from, to, options.up))
    starts.push_back(fitAt(from, to, start, 2 * options.voxel));
  std::stable_sort(starts.begin(), starts.end(), [](const Fit& a, const Fit& b) {
    return a.agreement() > b.agreement();
  });
  Fit best;
  for (std::size_t k = 0; k < std::min(kPolished, starts.size()); ++k) {
    const auto motion = polished(from, to, starts[k].motion, options.voxel);
    const Fit fit = fitAt(from, to, motion, options.voxel);
    if (fit.agreement() > best.agreement())
      best = fit;
  }
  return best;
}

/** A vanished and an appeared object that may be one object. */
struct Pair {
  std::size_t vanished, appeared;
  Fit fit;
};

Change
movedThing(Change before, Change after, const Fit& fit)
{
  after.kind = ChangeKind::kMoved;
  after.confidence = std::min(before.confidence, after.confidence);
  after.num_observers = std::min(before.num_observers, after.num_observers);
  after.before = before.box;
  after.points_before = std::move(before.points);
  after.motion = fit.motion;
  after.agreement = fit.agreement();
  return after;
}
} // namespace

std::vector<Change>
takeMoved(std::vector<Change>& vanished,
          std::vector<Change>& appeared,
          const RunChangesOptions& options)
{
  std::vector<Pair> pairs;
  for (std::size_t v = 0; v < vanished.size(); ++v)
    for (std::size_t a = 0; a < appeared.size(); ++a)
      if (std::min(vanished[v].points.size(), appeared[a].points.size()) >=
              kLeastOfShape &&
          areAlike(vanished[v].box, appeared[a].box, options.voxel))
        pairs.push_back({v, a, {}});
  parallelFor(pairs.size(), options.num_threads, [&](std::size_t k) {
    pairs[k].fit =
        fitOf(vanished[pairs[k].vanished], appeared[pairs[k].appeared], options);
  });
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return a.fit.agreement() > b.fit.agreement();
  });
  std::vector<char> is_taken_v(vanished.size()), is_taken_a(appeared.size());
  std::vector<Change> moved;
  for (const Pair& pair : pairs) {
    if (!pair.fit.isOneThing() || is_taken_v[pair.vanished] ||
        is_taken_a[pair.appeared])
      continue;
    is_taken_v[pair.vanished] = is_taken_a[pair.appeared] = 1;
    moved.push_back(
        movedThing(vanished[pair.vanished], appeared[pair.appeared], pair.fit));
  }
  const auto leave = [](const std::vector<char>& taken, std::vector<Change>& things) {
    std::vector<Change> rest;
    for (std::size_t i = 0; i < things.size(); ++i)
      if (!taken[i])
        rest.push_back(std::move(things[i]));
    things = std::move(rest);
  };
  leave(is_taken_v, vanished);
  leave(is_taken_a, appeared);
  return moved;
}

} // namespace pcl6d::moving_objects
