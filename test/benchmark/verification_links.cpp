// SPDX-License-Identifier: BSD-3-Clause
#include "verification_links.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/trajectory_io.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d::bench {

namespace {
constexpr double kPi = 3.141592653589793;

/** Farther from the reference, a polished pose is no right one. */
constexpr double kRightWay = 0.3, kRightTurn = 0.05;
/** Nearer to it, what ICP finds from elsewhere is no other place. */
constexpr double kWrongWay = 0.5, kWrongTurn = 0.09;

Points
gated(const Points& points, const ScanParameters& parameters)
{
  Points kept;
  for (const auto& p : points)
    if (p.allFinite() && p.norm() >= parameters.min_range.value &&
        p.norm() <= parameters.max_range.value)
      kept.push_back(p);
  return kept;
}

Eigen::Isometry3d
randomMotion(Random& random, double way, double turn)
{
  const double heading = random.uniform(-kPi, kPi);
  return poseFromEuler(
      {way * std::cos(heading), way * std::sin(heading), 0.1 * way * random.normal()},
      {0.02 * random.normal(), 0.02 * random.normal(), turn});
}

/** A link at a pose, with its distance from the reference. */
TestedLink
linkAt(const LinkSet& set,
       const std::string& kind,
       std::size_t first,
       std::size_t second,
       const Eigen::Isometry3d& T,
       const Eigen::Isometry3d& reference)
{
  TestedLink link{kind, first, second, T, 0, 0};
  const MotionSize off = distanceBetween(reference, T);
  link.off = off.translation;
  link.turn = off.rotation;
  (void)set;
  return link;
}

IcpResult
matched(const LinkSet& set,
        std::size_t first,
        std::size_t second,
        const Eigen::Isometry3d& guess)
{
  return icp({set.models[first].part()}, set.models[second].source(), guess, set.icp);
}

/** What ICP finds from other starts. */
void
addMinima(const LinkSet& set,
          std::size_t i,
          std::size_t j,
          const Eigen::Isometry3d& reference,
          Random& random,
          std::vector<TestedLink>& links)
{
  for (int trial = 0; trial < 4; ++trial) {
    const bool is_fold = trial == 3;
    const Eigen::Isometry3d start =
        reference * randomMotion(random,
                                 random.uniform(0.5, 4),
                                 is_fold ? kPi : random.uniform(-0.6, 0.6));
    const IcpResult found = matched(set, i, j, start);
    if (found.pairs < 50)
      continue;
    const TestedLink link = linkAt(
        set, is_fold ? "fold" : "minimum", i, j, found.T_target_source, reference);
    if (link.off > kWrongWay || link.turn > kWrongTurn)
      links.push_back(link);
  }
}

void
addShifts(const LinkSet& set,
          const TestedLink& right,
          Random& random,
          std::vector<TestedLink>& links)
{
  const Eigen::Isometry3d reference = right.T_first_second;
  for (const double way : {0.05, 0.1, 0.2, 0.5}) {
    Eigen::Vector3d to(random.normal(), random.normal(), random.normal());
    Eigen::Isometry3d T = reference;
    T.pretranslate(way * to.normalized());
    links.push_back(linkAt(set,
                           "shift " + std::to_string(std::lround(100 * way)) + " cm",
                           right.first,
                           right.second,
                           T,
                           reference));
  }
  for (const double degrees : {0.5, 1.0, 2.0, 5.0}) {
    Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
    Eigen::Isometry3d T = reference;
    T.rotate(Eigen::AngleAxisd(degrees * kPi / 180, axis.normalized()));
    links.push_back(
        linkAt(set,
               "turn " + std::to_string(std::lround(10 * degrees)) + " tenths",
               right.first,
               right.second,
               T,
               reference));
  }
}

/** Two scans that are far apart, brought together. */
void
addApart(const LinkSet& set,
         std::size_t i,
         Random& random,
         std::vector<TestedLink>& links)
{
  const std::size_t n = set.scans.size();
  const auto j = static_cast<std::size_t>(random.uniform() * static_cast<double>(n));
  const Eigen::Isometry3d reference =
      set.T_world_scan[i].inverse() * set.T_world_scan[j];
  if (j == i || reference.translation().norm() < 8)
    return;
  const IcpResult found =
      matched(set, i, j, randomMotion(random, 1.5, random.uniform(-kPi, kPi)));
  const TestedLink link = linkAt(set, "apart", i, j, found.T_target_source, reference);
  if (found.pairs >= 50 && (link.off > kWrongWay || link.turn > kWrongTurn))
    links.push_back(link);
}
} // namespace

LinkSet
readLinkSet(const std::filesystem::path& folder, int every, std::size_t most)
{
  ScanFolderOptions selection;
  selection.every = every;
  const ScanFolder scans(folder, selection);
  const auto truth = folder / "groundtruth.txt";
  const bool has_truth = std::filesystem::exists(truth);
  Trajectory reference;
  if (has_truth)
    reference = readTrajectory(truth);
  LinkSet set;
  set.name = folder.filename();
  std::vector<Points> measured;
  for (std::size_t i = 0; i < std::min(most, scans.size()); ++i) {
    measured.push_back(scans.read(i).points);
    set.T_world_scan.push_back(
        has_truth ? reference.poses.at(static_cast<std::size_t>(scans.index(i)))
                  : scans.initialPose(i));
  }
  const ScanParameters parameters = deriveScanParameters({}, measured);
  set.voxel = parameters.voxel.value;
  set.min_range = parameters.min_range.value;
  set.max_range = parameters.max_range.value;
  ReductionOptions reduction;
  reduction.voxel = set.voxel;
  IcpModel::Options model;
  model.normals = true;
  model.neighbours = 10;
  model.normal_voxel = 3 * set.voxel;
  for (auto& points : measured) {
    points = gated(points, parameters);
    set.models.emplace_back(reducePoints(points, reduction), model);
    set.scans.emplace_back(points, set.models.back(), set.voxel);
  }
  set.measured = std::move(measured);
  set.icp.metric = Metric::kGicp;
  set.icp.gicp_epsilon = 0.01;
  set.icp.facing_normals = true;
  set.icp.max_iterations = 100;
  set.icp.max_distance = 1.7 * set.voxel;
  set.icp.max_distance_start = 12 * set.voxel;
  set.icp.distance_decay = 0.75;
  return set;
}

std::vector<TestedLink>
makeLinks(const LinkSet& set, std::size_t gap, std::size_t most_pairs, unsigned seed)
{
  Random random(seed);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < set.scans.size(); ++i)
    for (std::size_t j = i + 1; j < std::min(set.scans.size(), i + gap + 1); ++j)
      pairs.emplace_back(i, j);
  const std::size_t stride = std::max<std::size_t>(1, pairs.size() / most_pairs);
  std::vector<TestedLink> links;
  for (std::size_t k = 0; k < pairs.size(); k += stride) {
    const auto [i, j] = pairs[k];
    const Eigen::Isometry3d reference =
        set.T_world_scan[i].inverse() * set.T_world_scan[j];
    const IcpResult polished = matched(set, i, j, reference);
    const TestedLink right =
        linkAt(set, "right", i, j, polished.T_target_source, reference);
    addApart(set, i, random, links);
    if (polished.overlap < 0.2 || polished.pairs < 100 || right.off > kRightWay ||
        right.turn > kRightTurn)
      continue;
    links.push_back(right);
    links.push_back(linkAt(set, "truth", i, j, reference, reference));
    addMinima(set, i, j, reference, random, links);
    addShifts(set, right, random, links);
  }
  return links;
}

} // namespace pcl6d::bench
