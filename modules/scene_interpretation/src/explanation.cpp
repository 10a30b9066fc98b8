// SPDX-License-Identifier: BSD-3-Clause
#include "label_network.h"

#include <pcl6d/common/angle.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl6d {
using namespace scene_interpretation;

namespace {
std::string
rounded(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

std::string
unitOf(Measure measure)
{
  return measure == Measure::kArea          ? " m^2"
         : measure == Measure::kInclination ? " deg"
                                            : " m";
}

std::string
misfitText(const Condition& condition, double value)
{
  const double unit = condition.measure == Measure::kInclination ? kDegree : 1;
  const auto bound = [&](double b) {
    return std::isfinite(b) ? rounded(b / unit) : std::string("any");
  };
  std::string name = toString(condition.measure);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name + " " + rounded(value / unit) + unitOf(condition.measure) +
         ", but must be in [" + bound(condition.low) + ", " + bound(condition.high) +
         "]";
}

/* Explains, for one plane of a labelled scene, why each other label is rejected. */
class Explainer {
public:
  Explainer(const LabelProblem& problem,
            const std::vector<std::size_t>& labels,
            std::size_t plane)
  : problem_(problem), rules_(problem.rules()), labels_(labels), plane_(plane)
  {}

  LabelExplanation
  explanation() const
  {
    LabelExplanation explanation;
    for (std::size_t label = 0; label < rules_.labels.size(); ++label)
      if (label != labels_[plane_])
        explanation.rejections.push_back(rejection(label));
    explanation.reason = reason();
    return explanation;
  }

private:
  std::string
  nameOf(std::size_t plane) const
  {
    return rules_.labels[labels_[plane]].name + " (plane " + std::to_string(plane + 1) +
           ")";
  }

  bool
  hasLabel(std::size_t plane) const
  {
    return labels_[plane] < rules_.labels.size();
  }

  std::string
  reason() const
  {
    if (!hasLabel(plane_))
      return "no label is consistent with the rest";
    std::string text = "the first label that is consistent with the rest";
    for (const auto& need : rules_.needs)
      if (need.label == labels_[plane_])
        if (const auto partner = partnerFor(need))
          text += "; it has " + nameOf(*partner) + " for '" + toString(need.rule) + "'";
    return text;
  }

  std::optional<std::size_t>
  partnerFor(const NeedRule& need) const
  {
    for (std::size_t j = 0; j < labels_.size(); ++j)
      if (j != plane_ && labels_[j] == need.partner && problem_.meets(need, plane_, j))
        return j;
    return {};
  }

  // Another plane whose need is met only by this plane with its present label.
  std::optional<std::size_t>
  dependant() const
  {
    for (std::size_t i = 0; i < labels_.size(); ++i)
      for (const auto& need : rules_.needs) {
        if (i == plane_ || need.label != labels_[i] ||
            need.partner != labels_[plane_] || !problem_.meets(need, i, plane_))
          continue;
        bool has_other = false;
        for (std::size_t j = 0; j < labels_.size() && !has_other; ++j)
          has_other = j != i && j != plane_ && labels_[j] == need.partner &&
                      problem_.meets(need, i, j);
        if (!has_other)
          return i;
      }
    return {};
  }

  RejectedLabel
  rejection(std::size_t label) const
  {
    const std::string& name = rules_.labels[label].name;
    if (const auto misfit = problem_.misfit(plane_, label))
      return {name, *misfit, {}};
    for (std::size_t j = 0; j < labels_.size(); ++j)
      if (j != plane_ && hasLabel(j))
        if (const PairRule* const rule = problem_.forbids(plane_, label, j, labels_[j]))
          return {name, "not '" + toString(rule->rule) + "' beside " + nameOf(j), j};
    for (const auto& need : rules_.needs)
      if (need.label == label && !partnerFor(need))
        return {name,
                "no " + rules_.labels[need.partner].name + " for '" +
                    toString(need.rule) + "'",
                {}};
    if (const auto other = dependant())
      return {name, nameOf(*other) + " needs this label", other};
    if (hasLabel(plane_) && labels_[plane_] < label)
      return {name, rules_.labels[labels_[plane_]].name + " comes first", {}};
    return {name, "a better labelling has another label here, or was not found", {}};
  }

  const LabelProblem& problem_;
  const LabelRules& rules_;
  const std::vector<std::size_t>& labels_;
  std::size_t plane_;
};
} // namespace

std::optional<std::string>
LabelProblem::misfit(std::size_t plane, std::size_t label) const
{
  const ScenePlane& scene = planes_[plane];
  const LabelRule& rule = rules_.labels[label];
  constexpr double kQuarter = 1.5707963267948966; // [rad] 90 deg
  const std::string inclination = rounded(scene.inclination / kDegree) + " deg";
  if (rule.orientation == Orientation::kHorizontal &&
      scene.inclination >= tolerances_.angle)
    return "not horizontal: inclination " + inclination;
  if (rule.orientation == Orientation::kVertical &&
      scene.inclination <= kQuarter - tolerances_.angle)
    return "not vertical: inclination " + inclination;
  if (scene.side_known && rule.seen_from == SeenFrom::kAbove && scene.normal.z() < 0)
    return std::string("seen from below");
  if (scene.side_known && rule.seen_from == SeenFrom::kBelow && scene.normal.z() > 0)
    return std::string("seen from above");
  for (const auto& condition : rule.conditions) {
    const auto value = measured(condition.measure, scene);
    if (value && (*value < condition.low || *value > condition.high))
      return misfitText(condition, *value);
  }
  return {};
}

const PairRule*
LabelProblem::forbids(std::size_t i, std::size_t a, std::size_t j, std::size_t b) const
{
  if (storey_of_[i] != storey_of_[j])
    return nullptr;
  for (const auto& pair : rules_.pairs) {
    if (pair.binds(a, b) && !holds(pair.rule, planes_[i], planes_[j], tolerances_))
      return &pair;
    if (pair.binds(b, a) && !holds(pair.rule, planes_[j], planes_[i], tolerances_))
      return &pair;
  }
  return nullptr;
}

bool
LabelProblem::meets(const NeedRule& need, std::size_t i, std::size_t j) const
{
  return holds(need.rule, planes_[i], planes_[j], tolerances_);
}

std::vector<LabelExplanation>
scene_interpretation::explain(const LabelProblem& problem,
                              const std::vector<std::size_t>& labels)
{
  std::vector<LabelExplanation> explanations;
  for (std::size_t plane = 0; plane < problem.size(); ++plane)
    explanations.push_back(Explainer(problem, labels, plane).explanation());
  return explanations;
}

std::string
explanationText(const Interpretation& interpretation, std::size_t plane)
{
  const LabelExplanation& explanation = interpretation.explanations.at(plane);
  std::string text = "plane " + std::to_string(plane + 1) + ": " +
                     interpretation.labels.at(plane) + ": " + explanation.reason + "\n";
  for (const auto& rejection : explanation.rejections)
    text += "  not " + rejection.label + ": " + rejection.reason + "\n";
  return text;
}

} // namespace pcl6d
