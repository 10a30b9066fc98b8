// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/feature_consensus.h"
#include "coarse/placement_support.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/registration/feature_alignment.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/visibility/ray_origin.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace registration;

namespace {
constexpr std::size_t kMaxPoints = 5000; // of a reduced scan, about
constexpr std::size_t kMaxMatches = 2000;
constexpr std::size_t kShortList = 400; // placements scored by their points
constexpr std::size_t kRefined = 16;    // placements refined by ICP
constexpr std::size_t kStep = 4;        // step of the points in the scores of
                                        // the short list

// In voxels:
constexpr double kFeatureRadius = 7;
constexpr double kMatchTolerance = 2; // corners of a voxel are 1.7 apart
constexpr double kMinLength = 4;
constexpr double kMeetingDistance = 1.5;
constexpr double kDistinct = 4; // placements farther apart are clearly different

class Alignment {
public:
  Alignment(const PlacedScan& target,
            const PlacedScan& source,
            double voxel,
            const FeatureAlignmentOptions& options)
  : target_(target)
  , source_(source)
  , voxel_(voxel)
  , o_(options)
  , distance_(source.scan.points)
  {}

  CoarseEstimate
  run() const
  {
    const auto hypotheses = refined(evaluated(drawn()));
    if (hypotheses.empty())
      return {};
    const auto distinct =
        keepDistinct(hypotheses, distance_, kDistinct * voxel_, hypotheses.size());
    CoarseEstimate estimate;
    estimate.T_target_source = distinct.front().T_target_source;
    estimate.score = distinct.front().score;
    estimate.second_score = besideScore(estimate.T_target_source);
    if (distinct.size() > 1)
      estimate.second_score = std::max(estimate.second_score, distinct[1].score);
    estimate.second_score = std::min(estimate.second_score, estimate.score);
    estimate.status = verdict(estimate);
    if (estimate.status == Status::kTooFewPairs)
      estimate.T_target_source.setIdentity();
    return estimate;
  }

private:
  std::vector<Hypothesis>
  drawn() const
  {
    const double radius = o_.feature_radius.value_or(kFeatureRadius * voxel_);
    const auto matches =
        matchFeatures(computeFpfh(target_.scan, radius, o_.num_threads),
                      computeFpfh(source_.scan, radius, o_.num_threads),
                      kMaxMatches,
                      o_.num_threads);
    ConsensusOptions consensus;
    consensus.tolerance = kMatchTolerance * voxel_;
    consensus.min_length = kMinLength * voxel_;
    consensus.seed = o_.seed;
    consensus.num_threads = o_.num_threads;
    return keepDistinct(drawHypotheses(target_.scan, source_.scan, matches, consensus),
                        distance_,
                        kMatchTolerance * voxel_,
                        kShortList);
  }

  PlacementSupport
  supportAt(const Eigen::Isometry3d& T, std::size_t step = 1) const
  {
    return supportOf(target_, source_, T, kMeetingDistance * voxel_, step);
  }

  /** The best hypotheses by the support of a quarter of the points. */
  std::vector<Hypothesis>
  evaluated(std::vector<Hypothesis> hypotheses) const
  {
    parallelFor(hypotheses.size(), o_.num_threads, [&](std::size_t i) {
      hypotheses[i].score = supportAt(hypotheses[i].T_target_source, kStep).value();
    });
    return keepDistinct(
        std::move(hypotheses), distance_, kMatchTolerance * voxel_, kRefined);
  }

  std::vector<Hypothesis>
  refined(std::vector<Hypothesis> hypotheses) const
  {
    IcpOptions icp_options;
    icp_options.metric = Metric::kGicp; // slides where points would lock into points
    icp_options.max_iterations = 30;
    icp_options.max_distance = kMeetingDistance * voxel_;
    icp_options.max_distance_start = 2 * icp_options.max_distance;
    icp_options.distance_decay = 0.8;
    icp_options.translation_epsilon = 0.02 * voxel_;
    icp_options.rotation_epsilon = 1e-3;
    icp_options.num_threads = 1;
    const IcpTarget target = {
        {&target_.scan.tree, &target_.scan.points, &target_.scan.normals}};
    const IcpSource from = {&source_.scan.points, &source_.scan.normals};
    parallelFor(hypotheses.size(), o_.num_threads, [&](std::size_t i) {
      auto& h = hypotheses[i];
      h.T_target_source =
          icp(target, from, h.T_target_source, icp_options).T_target_source;
      h.score = supportAt(h.T_target_source).value();
    });
    return hypotheses;
  }

  /** The best score of the placements next to T, moved along the directions least
   * fixed by surfaces. */
  double
  besideScore(const Eigen::Isometry3d& T) const
  {
    const auto moved =
        looselyHeld(target_, source_, T, kMeetingDistance * voxel_, kDistinct * voxel_);
    std::vector<double> scores(moved.size());
    parallelFor(moved.size(), o_.num_threads, [&](std::size_t i) {
      scores[i] = supportAt(moved[i]).value();
    });
    return scores.empty() ? 0 : *std::max_element(scores.begin(), scores.end());
  }

  Status
  verdict(const CoarseEstimate& estimate) const
  {
    const PlacementSupport support = supportAt(estimate.T_target_source);
    if (support.overlap() < o_.min_overlap ||
        support.consistency() < o_.min_consistency)
      return Status::kTooFewPairs;
    return estimate.ambiguity() > o_.max_ambiguity ? Status::kRankDeficient
                                                   : Status::kOk;
  }

  const PlacedScan& target_;
  const PlacedScan& source_;
  double voxel_;
  const FeatureAlignmentOptions& o_;
  PlacementDistance distance_;
};

PlacedScan
placed(const Points& measured, double voxel, unsigned int num_threads)
{
  return {makeFeatureScan(measured, voxel, num_threads),
          plausibleRays(measured, RayImageOptions::coarse())};
}

void
requireShare(double value, const char* name)
{
  require(value >= 0 && value <= 1, name, value, "in [0, 1]");
}
} // namespace

void
FeatureAlignmentOptions::validate() const
{
  for (const auto& [length, name] :
       {std::pair(voxel, "voxel"), std::pair(feature_radius, "feature_radius")})
    if (length)
      require(*length > 0 && std::isfinite(*length), name, *length, "finite and > 0");
  requireShare(min_overlap, "min_overlap");
  requireShare(min_consistency, "min_consistency");
  requireShare(max_ambiguity, "max_ambiguity");
}

CoarseEstimate
alignByFeatures(const Points& target,
                const Points& source,
                const FeatureAlignmentOptions& options)
{
  options.validate();
  const Points seen_target = measuredPoints(target);
  const Points seen_source = measuredPoints(source);
  const double voxel = options.voxel ? *options.voxel
                                     : std::max(featureVoxel(seen_target, kMaxPoints),
                                                featureVoxel(seen_source, kMaxPoints));
  if (seen_target.size() < 3 || seen_source.size() < 3 || !(voxel > 0))
    return {};
  const PlacedScan placed_target = placed(seen_target, voxel, options.num_threads);
  const PlacedScan placed_source = placed(seen_source, voxel, options.num_threads);
  return Alignment(placed_target, placed_source, voxel, options).run();
}

} // namespace pcl6d
