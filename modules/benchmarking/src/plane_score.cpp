// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/plane_score.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pcl6d {

namespace {
/** How many points found and true planes have, and share. */
struct Overlaps {
  std::vector<std::size_t> found, truth;                                 // by number
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> common; // found, truth

  Overlaps(const PlaneNumbers& found_numbers,
           std::size_t num_found,
           const PlaneNumbers& true_numbers,
           std::size_t num_true)
  : found(num_found + 1, 0), truth(num_true + 1, 0)
  {
    for (std::size_t i = 0; i < found_numbers.size(); ++i) {
      ++found[found_numbers[i]];
      ++truth[true_numbers[i]];
      if (found_numbers[i] > 0 && true_numbers[i] > 0)
        ++common[{found_numbers[i], true_numbers[i]}];
    }
  }
};

bool
isShare(std::size_t part, std::size_t whole, double share)
{
  return static_cast<double>(part) >= share * static_cast<double>(whole);
}

/** Partners of a plane in the other segmentation that lie on this plane. */
struct Partners {
  std::vector<std::uint32_t> planes;
  std::size_t points = 0;

  void
  add(std::uint32_t plane, std::size_t common)
  {
    planes.push_back(plane);
    points += common;
  }
};

class Scorer {
public:
  Scorer(Overlaps overlaps, const PlaneScoreOptions& options)
  : overlaps_(std::move(overlaps))
  , options_(options)
  , found_done_(overlaps_.found.size(), false)
  , truth_done_(overlaps_.truth.size(), false)
  {}

  PlaneScore
  score()
  {
    for (std::uint32_t t = 1; t < overlaps_.truth.size(); ++t)
      if (isAsked(t))
        ++score_.asked;
    findCorrect();
    findOverSegmented();
    findUnderSegmented();
    countRest();
    return score_;
  }

private:
  bool
  isAsked(std::uint32_t truth) const
  {
    return overlaps_.truth[truth] >= options_.min_points;
  }

  bool
  coversFound(std::uint32_t found, std::size_t common) const
  {
    return isShare(common, overlaps_.found[found], options_.overlap);
  }

  bool
  coversTruth(std::uint32_t truth, std::size_t common) const
  {
    return isShare(common, overlaps_.truth[truth], options_.overlap);
  }

  void
  findCorrect()
  {
    for (const auto& [pair, common] : overlaps_.common) {
      const auto [found, truth] = pair;
      if (!isAsked(truth) || !coversFound(found, common) || !coversTruth(truth, common))
        continue;
      score_.correct.push_back({found, truth});
      found_done_[found] = truth_done_[truth] = true;
    }
    std::sort(
        score_.correct.begin(),
        score_.correct.end(),
        [](const PlaneMatch& a, const PlaneMatch& b) { return a.truth < b.truth; });
  }

  void
  findOverSegmented()
  {
    std::map<std::uint32_t, Partners> pieces; // of a true plane
    for (const auto& [pair, common] : overlaps_.common)
      if (isAsked(pair.second) && !found_done_[pair.first] &&
          coversFound(pair.first, common))
        pieces[pair.second].add(pair.first, common);
    for (const auto& [truth, partners] : pieces) {
      if (truth_done_[truth] || partners.planes.size() < 2 ||
          !coversTruth(truth, partners.points))
        continue;
      ++score_.over_segmented;
      truth_done_[truth] = true;
      for (const auto found : partners.planes)
        found_done_[found] = true;
    }
  }

  void
  findUnderSegmented()
  {
    std::map<std::uint32_t, Partners> wholes; // in a found plane
    for (const auto& [pair, common] : overlaps_.common)
      if (isAsked(pair.second) && !truth_done_[pair.second] &&
          coversTruth(pair.second, common))
        wholes[pair.first].add(pair.second, common);
    for (const auto& [found, partners] : wholes) {
      if (found_done_[found] || partners.planes.size() < 2 ||
          !coversFound(found, partners.points))
        continue;
      ++score_.under_segmented;
      score_.joined += partners.planes.size();
      found_done_[found] = true;
      for (const auto truth : partners.planes)
        truth_done_[truth] = true;
    }
  }

  void
  countRest()
  {
    std::vector<std::size_t> on_small(overlaps_.found.size(), 0);
    for (const auto& [pair, common] : overlaps_.common)
      if (!isAsked(pair.second))
        on_small[pair.first] += common;
    for (std::uint32_t truth = 1; truth < overlaps_.truth.size(); ++truth)
      score_.missed += isAsked(truth) && !truth_done_[truth] ? 1 : 0;
    for (std::uint32_t found = 1; found < overlaps_.found.size(); ++found) {
      if (found_done_[found])
        continue;
      const bool evaluated = 2 * on_small[found] < overlaps_.found[found];
      ++(evaluated ? score_.noise : score_.not_evaluated);
    }
  }

  Overlaps overlaps_;
  PlaneScoreOptions options_;
  std::vector<char> found_done_, truth_done_;
  PlaneScore score_;
};

void
requireNumbers(const char* name, const PlaneNumbers& numbers, std::size_t num_planes)
{
  for (const auto number : numbers)
    require(number <= num_planes,
            name,
            number,
            "at most the number of planes, " + std::to_string(num_planes));
}

void
setErrors(PlaneMatch& match, const Plane& found, const Plane& truth)
{
  const double sine = found.normal.cross(truth.normal).norm();
  match.normal_error = portableAtan2(sine, std::abs(found.normal.dot(truth.normal)));
  Eigen::Vector3d middle = truth.offset * truth.normal;
  if (!truth.hull.empty()) {
    middle.setZero();
    for (const auto& corner : truth.hull)
      middle += corner / static_cast<double>(truth.hull.size());
  }
  match.offset_error = std::abs(found.normal.dot(middle) - found.offset);
}

double
medianOf(const std::vector<PlaneMatch>& matches, double PlaneMatch::*error)
{
  std::vector<double> errors;
  for (const auto& match : matches)
    errors.push_back(match.*error);
  return upperMedian(errors);
}
} // namespace

void
PlaneScoreOptions::validate() const
{
  require(overlap > 0.5 && overlap <= 1, "overlap", overlap, "in (0.5, 1]");
  require(min_points >= 1, "min_points", min_points, ">= 1");
}

double
PlaneScore::correctShare() const
{
  return asked == 0 ? 1
                    : static_cast<double>(correct.size()) / static_cast<double>(asked);
}

double
PlaneScore::medianNormalError() const
{
  return medianOf(correct, &PlaneMatch::normal_error);
}

double
PlaneScore::medianOffsetError() const
{
  return medianOf(correct, &PlaneMatch::offset_error);
}

PlaneScore
scorePlanes(const PlaneNumbers& found,
            const std::vector<Plane>& found_planes,
            const PlaneNumbers& truth,
            const std::vector<Plane>& true_planes,
            const PlaneScoreOptions& options)
{
  options.validate();
  require(found.size() == truth.size(),
          "number of points",
          found.size(),
          "that of the truth, " + std::to_string(truth.size()));
  requireNumbers("found plane", found, found_planes.size());
  requireNumbers("true plane", truth, true_planes.size());
  const Overlaps overlaps(found, found_planes.size(), truth, true_planes.size());
  PlaneScore score = Scorer(overlaps, options).score();
  for (auto& match : score.correct)
    setErrors(match, found_planes[match.found - 1], true_planes[match.truth - 1]);
  return score;
}

} // namespace pcl6d
