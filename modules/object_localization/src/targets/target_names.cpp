// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/object_localization/target_names.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** Least tolerance [m] of a distance between targets: scanners have systematic errors, too. */
constexpr double kLeastTolerance = 0.002;
/** Largest number of steps of the search, after which the best set up to then is used:
 * control nets of 50 points with 12 targets need a tenth. */
constexpr std::size_t kMostSteps = 2000000;

/** A target and a control point as its possible name. */
struct Assignment {
  std::size_t target, point;
};

/** Largest sets of assignments with equal distances. */
class CongruentSets {
public:
  CongruentSets(const std::vector<FoundTarget>& targets,
                const std::vector<ControlPoint>& control,
                double default_sigma)
  : targets_(targets), control_(control), default_sigma_(default_sigma)
  {
    for (std::size_t i = 0; i < targets.size(); ++i)
      for (std::size_t k = 0; k < control.size(); ++k)
        all_.push_back({i, k});
  }

  /** \brief Finds every largest set. */
  void
  search()
  {
    std::vector<std::size_t> candidates(all_.size());
    for (std::size_t a = 0; a < all_.size(); ++a)
      candidates[a] = a;
    std::vector<std::size_t> chosen;
    extend(chosen, candidates);
  }

  const std::vector<std::vector<Assignment>>&
  best() const
  {
    return best_;
  }

private:
  double
  sigmaOf(const Assignment& a) const
  {
    return std::hypot(targets_[a.target].sigma,
                      control_[a.point].sigma.value_or(default_sigma_));
  }

  bool
  agree(const Assignment& a, const Assignment& b) const
  {
    if (a.target == b.target || a.point == b.point)
      return false;
    const double here = (targets_[a.target].centre - targets_[b.target].centre).norm();
    const double there =
        (control_[a.point].position - control_[b.point].position).norm();
    const double tolerance =
        std::max(kLeastTolerance, 3 * std::hypot(sigmaOf(a), sigmaOf(b)));
    return std::abs(here - there) <= tolerance;
  }

  /** \return whether a fourth assignment lies on the same side of the first three in both */
  bool
  isMirrored(const std::vector<std::size_t>& chosen, std::size_t next) const
  {
    if (chosen.size() < 3)
      return false;
    const auto volumeOf = [&](auto positionOf) {
      const Eigen::Vector3d origin = positionOf(all_[chosen[0]]);
      const Eigen::Vector3d u = positionOf(all_[chosen[1]]) - origin;
      const Eigen::Vector3d v = positionOf(all_[chosen[2]]) - origin;
      const Eigen::Vector3d normal = u.cross(v);
      const double size = normal.norm();
      return size > 0 ? normal.dot(positionOf(all_[next]) - origin) / size : 0.0;
    };
    const double here =
        volumeOf([&](const Assignment& a) { return targets_[a.target].centre; });
    const double there =
        volumeOf([&](const Assignment& a) { return control_[a.point].position; });
    const double tolerance = std::max(kLeastTolerance, 6 * sigmaOf(all_[next]));
    return here * there < 0 && std::abs(here - there) > 2 * tolerance;
  }

  void
  extend(std::vector<std::size_t>& chosen, const std::vector<std::size_t>& candidates)
  {
    if (++steps_ > kMostSteps)
      return;
    take(chosen);
    std::size_t open = 0; // targets that may still be named
    for (std::size_t k = 0; k < candidates.size(); ++k)
      open += k == 0 || all_[candidates[k]].target != all_[candidates[k - 1]].target;
    const std::size_t most = best_.empty() ? 0 : best_.front().size();
    if (chosen.size() + open < std::max<std::size_t>(most, 3))
      return;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const std::size_t next = candidates[k];
      if (isMirrored(chosen, next))
        continue;
      std::vector<std::size_t> rest;
      for (std::size_t l = k + 1; l < candidates.size(); ++l)
        if (agree(all_[next], all_[candidates[l]]))
          rest.push_back(candidates[l]);
      chosen.push_back(next);
      extend(chosen, rest);
      chosen.pop_back();
    }
  }

  void
  take(const std::vector<std::size_t>& chosen)
  {
    const std::size_t most = best_.empty() ? 3 : best_.front().size();
    if (chosen.size() < most || isOnLine(chosen))
      return;
    if (chosen.size() > most)
      best_.clear();
    std::vector<Assignment> set;
    for (const std::size_t a : chosen)
      set.push_back(all_[a]);
    best_.push_back(std::move(set));
  }

  bool
  isOnLine(const std::vector<std::size_t>& chosen) const
  {
    const Eigen::Vector3d origin = targets_[all_[chosen[0]].target].centre;
    Eigen::Vector3d longest = Eigen::Vector3d::Zero();
    for (const std::size_t a : chosen) {
      const Eigen::Vector3d way = targets_[all_[a].target].centre - origin;
      if (way.norm() > longest.norm())
        longest = way;
    }
    double across = 0;
    for (const std::size_t a : chosen)
      across = std::max(
          across,
          longest.normalized().cross(targets_[all_[a].target].centre - origin).norm());
    return across < 0.05 * longest.norm();
  }

  const std::vector<FoundTarget>& targets_;
  const std::vector<ControlPoint>& control_;
  double default_sigma_;
  std::vector<Assignment> all_;
  std::vector<std::vector<Assignment>> best_;
  std::size_t steps_ = 0;
};
} // namespace

TargetNames
namesByDistances(const std::vector<FoundTarget>& targets,
                 const std::vector<ControlPoint>& control,
                 double default_sigma)
{
  TargetNames named;
  named.names.resize(targets.size());
  if (targets.size() < 3) {
    named.doubt = "fewer than three targets";
    return named;
  }
  CongruentSets sets(targets, control, default_sigma);
  sets.search();
  if (sets.best().empty()) {
    named.doubt = "no three targets have the distances of control points";
    return named;
  }
  for (const auto& set : sets.best())
    for (const Assignment& a : set) {
      std::string& name = named.names[a.target];
      if (!name.empty() && name != control[a.point].name)
        named.doubt =
            "ambiguous: a target may be " + name + " or " + control[a.point].name;
      else
        name = control[a.point].name;
    }
  if (sets.best().size() > 1 && named.doubt.empty())
    named.doubt = "ambiguous: " + std::to_string(sets.best().size()) +
                  " sets of targets have the distances of control points";
  if (!named.doubt.empty())
    named.names.assign(targets.size(), "");
  return named;
}

} // namespace pcl6d
