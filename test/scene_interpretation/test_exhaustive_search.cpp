// SPDX-License-Identifier: BSD-3-Clause
/* The labelling by branch and bound against every possible labelling. */
#include "support/box_room.h"

#include <pcl6d/common/rotation.h>
#include <pcl6d/scene_interpretation/interpretation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {
using pcl6d::Interpretation;
using pcl6d::LabelRules;
using pcl6d::ScenePlane;
using pcl6d::test::TruePlane;

bool
fits(const ScenePlane& plane, const pcl6d::LabelRule& rule)
{
  const double tau = pcl6d::RelationTolerances().angle;
  if (rule.orientation == pcl6d::Orientation::kHorizontal && plane.inclination >= tau)
    return false;
  if (rule.orientation == pcl6d::Orientation::kVertical &&
      plane.inclination <= M_PI_2 - tau)
    return false;
  if (plane.side_known && rule.seen_from != pcl6d::SeenFrom::kAnywhere &&
      (plane.normal.z() > 0) != (rule.seen_from == pcl6d::SeenFrom::kAbove))
    return false;
  return std::all_of(rule.conditions.begin(), rule.conditions.end(), [&](auto& c) {
    const auto value = measured(c.measure, plane);
    return !value || (*value >= c.low && *value <= c.high);
  });
}

/* Tries every label for every plane, in the order in which the first of equally good
 * labellings is the one wanted. */
class ExhaustiveSearch {
public:
  ExhaustiveSearch(std::vector<ScenePlane> planes, const LabelRules& rules)
  : planes_(std::move(planes)), rules_(rules), labels_(planes_.size(), none())
  {
    order_.resize(planes_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return worth(a) > worth(b);
    });
  }

  std::vector<std::string>
  run()
  {
    tryAll(0);
    std::vector<std::string> names;
    for (const auto label : best_)
      names.push_back(label == none() ? "none" : rules_.labels[label].name);
    return names;
  }

  std::int64_t
  bestWorth() const
  {
    return best_worth_;
  }

private:
  std::size_t
  none() const
  {
    return rules_.labels.size();
  }

  std::int64_t
  worth(std::size_t plane) const
  {
    return std::llround(1e6 * planes_[plane].area);
  }

  void
  tryAll(std::size_t depth)
  {
    if (depth == order_.size()) {
      evaluate();
      return;
    }
    for (std::size_t label = 0; label <= none(); ++label)
      if (label == none() || fits(planes_[order_[depth]], rules_.labels[label])) {
        labels_[order_[depth]] = label;
        tryAll(depth + 1);
      }
  }

  void
  evaluate()
  {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < planes_.size(); ++i)
      sum += labels_[i] == none() ? 0 : worth(i);
    if (sum > best_worth_ && isConsistent()) {
      best_worth_ = sum;
      best_ = labels_;
    }
  }

  bool
  isConsistent() const
  {
    for (std::size_t i = 0; i < planes_.size(); ++i)
      for (std::size_t j = 0; j < planes_.size(); ++j)
        for (const auto& pair : rules_.pairs)
          if (i != j && labels_[i] != none() && labels_[j] != none() &&
              pair.binds(labels_[i], labels_[j]) &&
              !holds(pair.rule, planes_[i], planes_[j], {}))
            return false;
    for (std::size_t i = 0; i < planes_.size(); ++i)
      for (const auto& need : rules_.needs)
        if (labels_[i] == need.label && !isMet(need, i))
          return false;
    return true;
  }

  bool
  isMet(const pcl6d::NeedRule& need, std::size_t i) const
  {
    for (std::size_t j = 0; j < planes_.size(); ++j)
      if (j != i && labels_[j] == need.partner &&
          holds(need.rule, planes_[i], planes_[j], {}))
        return true;
    return false;
  }

  std::vector<ScenePlane> planes_;
  const LabelRules& rules_;
  std::vector<std::size_t> order_;
  std::vector<std::size_t> labels_, best_;
  std::int64_t best_worth_ = -1;
};

std::vector<ScenePlane>
scenePlanes(const std::vector<TruePlane>& planes,
            const Interpretation& found,
            bool with_sides)
{
  std::vector<ScenePlane> scene;
  for (const auto& [plane, side] : planes) {
    scene.push_back(levelledPlane(plane,
                                  Eigen::Matrix3d::Identity(),
                                  with_sides ? side : Eigen::Vector3d::Zero().eval()));
    scene.back().floor = found.storeys.front().floor;
    scene.back().ceiling = found.storeys.front().ceiling;
  }
  return scene;
}

std::vector<TruePlane>
randomRoom(pcl6d::Random& random)
{
  pcl6d::test::BoxRoom room;
  room.length = random.uniform(3, 8);
  room.width = random.uniform(2.5, 6);
  room.height = random.uniform(2.3, 3.2);
  room.base = random.uniform(-1, 1);
  room.door_place = random.uniform(0.1, 0.9);
  return room.planes();
}

// Places and tilts at random what is drawn, so that labels contradict each other.
void
disturb(std::vector<TruePlane>& planes, pcl6d::Random& random)
{
  for (auto& plane : planes) {
    if (random.uniform() < 0.5)
      continue;
    const double angle = random.uniform() < 0.3 ? 0.5 : 0.15; // [rad]
    const Eigen::Vector3d axis =
        random.uniform(-angle, angle) * Eigen::Vector3d::UnitX() +
        random.uniform(-angle, angle) * Eigen::Vector3d::UnitZ();
    plane = pcl6d::test::turned({plane}, pcl6d::rotationFromVector(axis)).front();
    plane.plane.area *= random.uniform(0.3, 1);
  }
}
} // namespace

TEST(LabelsOfRandomRooms, AreRightAndThoseOfExhaustiveSearch)
{
  pcl6d::Random random(29);
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(trial);
    const auto room = randomRoom(random);
    const auto found = interpretPlanes(planesOf(room), sidesOf(room));
    EXPECT_EQ(found.labels, labelsOf(room));
    EXPECT_EQ(found.status, pcl6d::Status::kOk);
    ASSERT_EQ(found.storeys.size(), 1u);
    EXPECT_EQ(
        found.labels,
        ExhaustiveSearch(scenePlanes(room, found, true), pcl6d::bookRules()).run());
  }
}

TEST(LabelsOfDisturbedRooms, AreThoseOfExhaustiveSearchWithAndWithoutSides)
{
  pcl6d::Random random(7);
  int checked = 0, forbidden = 0;
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    auto room = randomRoom(random);
    disturb(room, random);
    const bool with_sides = trial % 2 == 0;
    const auto found = interpretPlanes(
        planesOf(room), with_sides ? sidesOf(room) : std::vector<Eigen::Vector3d>{});
    if (found.storeys.size() != 1)
      continue; // the oracle knows of one storey
    ExhaustiveSearch oracle(scenePlanes(room, found, with_sides), pcl6d::bookRules());
    EXPECT_EQ(found.labels, oracle.run());
    ++checked;
    for (const auto& explanation : found.explanations)
      for (const auto& rejection : explanation.rejections)
        forbidden += rejection.partner ? 1 : 0;
  }
  EXPECT_GE(checked, 60);
  EXPECT_GE(forbidden,
            60); // labels that a partner ruled out: the trials were no easy ones
}
