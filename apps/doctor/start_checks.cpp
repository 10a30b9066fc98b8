// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/checks.h"
#include "doctor/report/words.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d::app {

namespace {
/** Another start counts as better than the user's if its median distance is smaller by
 * this factor. */
constexpr double kClearly = 1.5;

bool
compare(const Eigen::Vector3f& a, const Eigen::Vector3f& b)
{
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/** \return number of source points, untransformed, that are also points of the target */
std::size_t
commonPoints(const DoctorPair& pair)
{
  const auto sorted = [](const DoctorCloud& cloud) {
    Points points;
    for (const std::size_t i : cloud.finiteRows(true))
      points.push_back(cloud.rows[i].cast<float>());
    std::sort(points.begin(), points.end(), compare);
    return points;
  };
  const Points a = sorted(pair.source), b = sorted(pair.target);
  Points common;
  std::set_intersection(
      a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common), compare);
  return common.size();
}

void
checkCopies(const DoctorPair& pair, Findings& findings)
{
  const std::size_t common = commonPoints(pair);
  if (2 * common <= pair.of_source.points)
    return;
  findings.push_back({Severity::kWarning,
                      "the clouds hold identical points",
                      shareText(common, pair.of_source.points) +
                          " points of SOURCE are points of TARGET",
                      "two measurements: a copy fits at the identity for any scene, "
                      "and tests no pose"});
}

void
checkOverlap(const DoctorPair& pair, Findings& findings)
{
  constexpr double kLittle = 0.1; // as RegistrationVerifier's least confirmation
  Eigen::AlignedBox3d box;
  for (const auto& p : pair.target_points)
    box.extend(p.cast<double>());
  const double near = 3 * pair.spacing; // to meet points beside the nearest
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(near);
  const Eigen::AlignedBox3d wide(Eigen::Vector3d(box.min() - reach),
                                 Eigen::Vector3d(box.max() + reach));
  const auto inside = static_cast<std::size_t>(
      std::count_if(pair.source_points.begin(),
                    pair.source_points.end(),
                    [&](const Eigen::Vector3f& p) {
                      return wide.contains(pair.start * p.cast<double>());
                    }));
  const std::string measured =
      shareText(inside, pair.of_source.points) +
      " points of SOURCE start in TARGET's box, " +
      percentText(pair.fitAt(pair.start, near).share) + " within " + metres(near) +
      " of a point; the median distance is " + metres(pair.at_start.median);
  const double box_share =
      static_cast<double>(inside) / static_cast<double>(pair.of_source.points);
  if (box_share < kLittle || pair.startsApart())
    findings.push_back(
        {Severity::kProblem,
         "the clouds hardly meet at the start",
         measured,
         "a guess with overlap, from pcl6d::searchByOverlap() or alignByFeatures()"});
}

void
checkSpacing(const DoctorPair& pair, Findings& findings)
{
  constexpr double kMuch = 3;
  const double a = pair.of_source.spacing, b = pair.of_target.spacing;
  if (std::min(a, b) <= 0 || std::max(a, b) < kMuch * std::min(a, b))
    return;
  findings.push_back(
      {Severity::kWarning,
       "the clouds differ much in density",
       "spacing " + metres(a) + " of SOURCE, " + metres(b) +
           " of TARGET: " + shortNumber(std::max(a, b) / std::min(a, b), 2) + " times",
       "reduce both with one leaf size, " + metres(pair.voxel) + " or more"});
}

/** Clouds whose ratio of sizes equals the ratio of two units. */
void
checkScale(const DoctorPair& pair, Findings& findings)
{
  const std::pair<double, const char*> units[] = {{1000, "millimetres and metres"},
                                                  {100, "centimetres and metres"},
                                                  {39.37, "inches and metres"},
                                                  {25.4, "millimetres and inches"},
                                                  {12, "inches and feet"},
                                                  {10, "millimetres and centimetres"},
                                                  {3.2808, "feet and metres"}};
  const double a = pair.of_source.spread, b = pair.of_target.spread;
  if (std::min(a, b) <= 0)
    return;
  const double ratio = std::max(a, b) / std::min(a, b);
  for (const auto& [factor, words] : units)
    // two views of an object may differ in size by this
    if (std::abs(ratio / factor - 1) < 0.1)
      findings.push_back({Severity::kWarning,
                          "the clouds may be in different units",
                          "the points spread " + metres(a) + " in SOURCE, " +
                              metres(b) + " in TARGET: " + shortNumber(ratio) +
                              " times, as of " + words,
                          "bring both to metres; a scale can be estimated by "
                          "pcl6d::ICP6D::setEstimateScale(true)"});
}

/** Compares the start with the inverse of the guess, no guess, and the VIEWPOINTs. */
void
checkGuess(const DoctorPair& pair, Findings& findings)
{
  const auto compareWith = [&](const Eigen::Isometry3d& full,
                               const std::string& what,
                               const std::string& advice) {
    const PoseFit fit = pair.fitAt(pair.toLocal(full), pair.max_distance);
    if (kClearly * fit.median >= pair.at_start.median ||
        pair.at_start.median < pair.spacing) // within the point spacing
      return;
    findings.push_back({Severity::kWarning,
                        what,
                        "the median distance to the target is then " +
                            metres(fit.median) + ", at the start " +
                            metres(pair.at_start.median),
                        advice});
  };
  const bool is_given = !pair.guess_given.isApprox(Eigen::Isometry3d::Identity(), 0);
  if (is_given) {
    compareWith(
        pair.guess_given.inverse(),
        "the guess seems to be the wrong way round",
        "pass the inverse: align() wants the pose of SOURCE in the frame of TARGET");
    compareWith(Eigen::Isometry3d::Identity(),
                "the guess is worse than the identity",
                "leave the guess out, or check the source of the guess");
  }
  if (pair.source.viewpoint || pair.target.viewpoint) {
    const Eigen::Isometry3d none = Eigen::Isometry3d::Identity();
    const Eigen::Isometry3d relative = pair.target.viewpoint.value_or(none).inverse() *
                                       pair.source.viewpoint.value_or(none);
    compareWith(relative,
                "the VIEWPOINTs are a better start",
                "pass them as guess: " + vectorText(relative.translation()) +
                    " [m] and the rotation; pcl_slam6d uses VIEWPOINTs by default");
  }
}
} // namespace

Findings
checkStart(const DoctorPair& pair)
{
  Findings findings;
  if (!pair.canBeMatched())
    return findings;
  checkCopies(pair, findings);
  checkOverlap(pair, findings);
  checkSpacing(pair, findings);
  checkScale(pair, findings);
  checkGuess(pair, findings);
  return findings;
}

} // namespace pcl6d::app
