// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/graph_relaxation/map_agreement.h>

#include <algorithm>

namespace pcl6d {

namespace {
/** Scans overlap if at least this share of the points of one has a partner. */
constexpr double kLeastOverlap = 0.05;
/** [voxels] Largest distance of partners. */
constexpr double kPartnerVoxels = 2;
/** Sampled points of a scan in each pair; with more pairs per scan than the given number,
 * fewer points each, at constant total time, down to the least number. */
constexpr std::size_t kSample = 700, kPairsPerScan = 40, kLeastSample = 100;

/** \return the number of tested points of a scan per pair */
std::size_t
sampleFor(std::size_t pairs, std::size_t scans)
{
  const std::size_t full = kPairsPerScan * scans;
  return pairs <= full ? kSample : std::max(kLeastSample, kSample * full / pairs);
}

} // namespace

double
agreementDistance(double voxel)
{
  return voxel / 2.5;
}

std::vector<ScanPair>
visiblePairs(const std::vector<NetworkScan>& scans,
             const Poses& poses,
             double voxel,
             unsigned int num_threads,
             WorkSharing* sharing)
{
  require(poses.size() == scans.size(), "poses", poses.size(), "one per scan");
  return overlappingPairs(
      scans,
      poses,
      kPartnerVoxels * voxel,
      [](const ScanPair&) { return kLeastOverlap; },
      num_threads,
      sharing);
}

MapAgreement
agreementOver(const std::vector<ScanPair>& pairs,
              const std::vector<NetworkScan>& scans,
              const Poses& poses,
              double voxel,
              unsigned int num_threads)
{
  require(poses.size() == scans.size(), "poses", poses.size(), "one per scan");
  for (const ScanPair& pair : pairs)
    require(std::max(pair.first, pair.second) < scans.size(),
            "scan of a pair",
            std::max(pair.first, pair.second),
            "one of the scans");
  const double distance = agreementDistance(voxel);
  const std::size_t sample = sampleFor(pairs.size(), scans.size());
  std::vector<PointVotes> votes(pairs.size());
  parallelFor(pairs.size(), num_threads, [&](std::size_t k) {
    const auto [a, b] = pairs[k];
    const Eigen::Isometry3d T_a_b = poses[a].inverse() * poses[b];
    const auto stride = [&](std::size_t scan) {
      return std::max<std::size_t>(1, scans[scan].model().points().size() / sample);
    };
    votes[k] = votesOf(scans[b], scans[a], T_a_b, distance, stride(b));
    votes[k] += votesOf(scans[a], scans[b], T_a_b.inverse(), distance, stride(a));
  });
  MapAgreement agreement;
  PointVotes all;
  std::vector<PointVotes> of_scan(scans.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    all += votes[k];
    of_scan[pairs[k].first] += votes[k];
    of_scan[pairs[k].second] += votes[k];
  }
  agreement.total = all.share();
  for (const PointVotes& one : of_scan)
    agreement.scans.push_back(one.share());
  return agreement;
}

} // namespace pcl6d
