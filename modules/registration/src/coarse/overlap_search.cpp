// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/feature_scan.h"
#include "coarse/octree_level.h"
#include "coarse/placement_distance.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/registration/overlap_search.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl6d {
using namespace registration;

namespace {
using Vector6d = Eigen::Matrix<double, 6, 1>; // x, y, z [m], roll, pitch, yaw [rad]

constexpr std::array<int, 6> kSteps = {5, 5, 3, 3, 3, 5};
constexpr std::size_t kTuples = 5 * 5 * 3 * 3 * 3 * 5;
constexpr std::size_t kSearchedBlock = 125; // tuples; independent of the threads

Eigen::IOFormat
oneLine()
{
  return Eigen::IOFormat(Eigen::StreamPrecision, Eigen::DontAlignCols, " ", "; ");
}

std::array<int, 6>
stepsOf(std::size_t tuple)
{
  std::array<int, 6> steps{};
  for (int i = 5; i >= 0; --i) {
    steps[i] = static_cast<int>(tuple % kSteps[i]);
    tuple /= kSteps[i];
  }
  return steps;
}

/** \return the offsets of a tuple in units of the window, in [-1, 1] */
Vector6d
offsetOf(std::size_t tuple)
{
  const auto steps = stepsOf(tuple);
  Vector6d offset;
  for (int i = 0; i < 6; ++i)
    offset[i] = 2.0 * steps[i] / (kSteps[i] - 1) - 1;
  return offset;
}

/** \return whether no tuple one step away along one axis is better */
bool
isLocalMaximum(const int* scores, std::size_t tuple)
{
  const auto steps = stepsOf(tuple);
  std::size_t stride = 1;
  for (int i = 5; i >= 0; --i) {
    if (steps[i] > 0 && scores[tuple - stride] > scores[tuple])
      return false;
    if (steps[i] + 1 < kSteps[i] && scores[tuple + stride] > scores[tuple])
      return false;
    stride *= static_cast<std::size_t>(kSteps[i]);
  }
  return true;
}

/** A placement by its offsets from the guess, with its share of cubes in
 * occupied cubes.
 */
struct Candidate {
  Vector6d offset = Vector6d::Zero();
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  double score = 0;
  double motion_sq = 0; ///< squared size of the last step, in windows
};

/** Window and cubes, from options or derived. */
struct Scale {
  double first_cube, last_cube; ///< [m]
  Vector6d window;
};

Eigen::Vector3d
centroidOf(const Points& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : points)
    sum += p.cast<double>();
  return sum / static_cast<double>(points.size());
}

/** Six cubes to the median distance: 10 m give the cubes of the paper from the
 * second level on. */
Scale
deriveScale(const Points& target,
            const Eigen::Vector3d& centre,
            const OverlapSearchOptions& options)
{
  std::vector<double> distances;
  for (const auto& p : target)
    distances.push_back((p.cast<double>() - centre).norm());
  const double derived =
      std::max(upperMedian(std::move(distances)) / 6, 8 * distinctSpacing(target));
  Scale scale;
  const Eigen::Vector3d wide =
      options.translation_window.value_or(derived * Eigen::Vector3d(1.25, 1.25, 0.375));
  scale.window << wide, options.rotation_window;
  // Cubes no smaller than 1.6 steps in x and y, 0.8 in z: else the grid would miss.
  scale.first_cube = options.first_cube.value_or(
      std::max({derived, 0.8 * wide.head<2>().maxCoeff(), 0.8 * wide.z()}));
  scale.last_cube = std::min(options.last_cube.value_or(derived / 4), scale.first_cube);
  return scale;
}

class Search {
public:
  Search(const Points& target,
         const Points& source,
         const Eigen::Isometry3d& guess,
         const OverlapSearchOptions& options)
  : target_(target)
  , source_(source)
  , guess_(guess)
  , o_(options)
  , target_centre_(centroidOf(target))
  , source_centre_(centroidOf(source))
  , turning_point_(guess * source_centre_)
  , distance_(source)
  , scale_(deriveScale(target, target_centre_, options))
  {}

  CoarseEstimate
  run() const
  {
    CoarseEstimate estimate;
    estimate.T_target_source = guess_;
    if (!(scale_.last_cube > 0))
      return estimate;
    std::vector<Candidate> candidates(1);
    Vector6d window = scale_.window;
    for (double edge = scale_.first_cube; edge > 0.75 * scale_.last_cube; edge /= 2) {
      const OctreeLevel target(target_, target_centre_, edge);
      const auto cubes = OctreeLevel(source_, source_centre_, edge)
                             .centres(static_cast<std::size_t>(o_.max_cubes));
      if (cubes.size() < 3)
        return estimate;
      candidates = distinct(refined(candidates, window, target, cubes));
      window /= 2;
    }
    return evaluated(candidates);
  }

private:
  Eigen::Isometry3d
  placement(const Vector6d& offset) const
  {
    const Eigen::Vector3d shift = offset.head<3>();
    const Eigen::Isometry3d turn = poseFromEuler(
        Eigen::Vector3d::Zero(), EulerAngles{offset[3], offset[4], offset[5]});
    return Eigen::Translation3d(turning_point_ + shift) * turn *
           Eigen::Translation3d(-turning_point_) * guess_;
  }

  /** One level: the local maxima of the grids about the candidates. */
  std::vector<Candidate>
  refined(const std::vector<Candidate>& candidates,
          const Vector6d& window,
          const OctreeLevel& target,
          const std::vector<Eigen::Vector3d>& cubes) const
  {
    const auto placeOf = [&](std::size_t i) {
      return Vector6d(candidates[i / kTuples].offset +
                      window.cwiseProduct(offsetOf(i % kTuples)));
    };
    std::vector<int> scores(candidates.size() * kTuples);
    parallelBlocks(
        scores.size(), kSearchedBlock, o_.num_threads, [&](const Block& block) {
          for (std::size_t i = block.begin; i < block.end; ++i)
            scores[i] = target.count(cubes, placement(placeOf(i)));
        });
    std::vector<Candidate> found;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      if (!isLocalMaximum(&scores[i - i % kTuples], i % kTuples))
        continue;
      const Vector6d offset = placeOf(i);
      found.push_back(
          {offset,
           placement(offset),
           static_cast<double>(scores[i]) / static_cast<double>(cubes.size()),
           offsetOf(i % kTuples).squaredNorm()});
    }
    return found;
  }

  /** The best candidates, any two farther apart than the first cube. */
  std::vector<Candidate>
  distinct(std::vector<Candidate> found) const
  {
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return a.score > b.score || (a.score == b.score && a.motion_sq < b.motion_sq);
    });
    return firstDistinct(found,
                         distance_,
                         scale_.first_cube,
                         static_cast<std::size_t>(o_.max_candidates));
  }

  CoarseEstimate
  evaluated(const std::vector<Candidate>& candidates) const
  {
    CoarseEstimate estimate;
    estimate.T_target_source = guess_;
    estimate.score = candidates.front().score;
    if (candidates.size() > 1)
      estimate.second_score = candidates[1].score;
    if (!(estimate.score >= o_.min_score && estimate.score > 0))
      return estimate;
    estimate.T_target_source = candidates.front().T_target_source;
    estimate.status =
        estimate.ambiguity() > o_.max_ambiguity ? Status::kRankDeficient : Status::kOk;
    return estimate;
  }

  const Points& target_;
  const Points& source_;
  Eigen::Isometry3d guess_;
  const OverlapSearchOptions& o_;
  Eigen::Vector3d target_centre_, source_centre_, turning_point_;
  PlacementDistance distance_;
  Scale scale_;
};
} // namespace

void
OverlapSearchOptions::validate() const
{
  const auto requireWindow = [](const Eigen::Vector3d& w, const char* name) {
    require(w.allFinite() && w.minCoeff() > 0,
            name,
            w.transpose().format(oneLine()),
            "finite and > 0");
  };
  const auto requireCube = [](const std::optional<double>& edge, const char* name) {
    if (edge)
      require(*edge > 0 && std::isfinite(*edge), name, *edge, "finite and > 0");
  };
  const auto requireShare = [](double share, const char* name) {
    require(share >= 0 && share <= 1, name, share, "in [0, 1]");
  };
  if (translation_window)
    requireWindow(*translation_window, "translation_window");
  requireWindow(rotation_window, "rotation_window");
  require(rotation_window.maxCoeff() <= M_PI,
          "rotation_window",
          rotation_window.transpose().format(oneLine()),
          "<= pi");
  requireCube(first_cube, "first_cube");
  requireCube(last_cube, "last_cube");
  require(max_cubes >= 3, "max_cubes", max_cubes, ">= 3");
  require(max_candidates >= 2, "max_candidates", max_candidates, ">= 2");
  requireShare(min_score, "min_score");
  requireShare(max_ambiguity, "max_ambiguity");
}

CoarseEstimate
searchByOverlap(const Points& target,
                const Points& source,
                const Eigen::Isometry3d& guess,
                const OverlapSearchOptions& options)
{
  options.validate();
  require(isRigid(guess), "guess", guess.matrix().format(oneLine()), "a rigid motion");
  constexpr double kAnyRange = std::numeric_limits<double>::infinity();
  const Points seen_target = gateByRange(target, 0, kAnyRange); // finite points
  const Points seen_source = gateByRange(source, 0, kAnyRange);
  if (seen_target.empty() || seen_source.empty()) {
    CoarseEstimate nothing;
    nothing.T_target_source = guess;
    return nothing;
  }
  return Search(seen_target, seen_source, guess, options).run();
}

} // namespace pcl6d
