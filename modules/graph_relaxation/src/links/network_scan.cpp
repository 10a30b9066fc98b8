// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/graph_relaxation/network_scan.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
constexpr std::size_t kSample = 250; ///< points that tell an overlap

/** Of the scans before it, a scan is compared with so many: the nearest. On a long drive all
 * places are seen by many scans, and more pairs of them say nothing new. */
constexpr std::size_t kCompared = 64;

/** Standard deviation of a point, of the distance within which points are near: three of
 * it are twice that distance. */
constexpr double kPlaceSigma = 2.0 / 3;

/** The share of a sample of points that have a partner. */
double
sampledShare(const NetworkScan& scan,
             const NetworkScan& other,
             const Eigen::Isometry3d& T_other_scan,
             double distance)
{
  const Points& points = scan.model().points();
  const auto limit_sq = static_cast<float>(distance * distance);
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSample);
  std::size_t looked = 0, near = 0;
  for (std::size_t i = 0; i < points.size(); i += stride, ++looked) {
    const Eigen::Vector3f p = (T_other_scan * points[i].cast<double>()).cast<float>();
    near += other.model().tree().nearest(p, limit_sq).index >= 0;
  }
  return looked > 0 ? static_cast<double>(near) / static_cast<double>(looked) : 0;
}

/** \return the earlier scans whose bounding spheres meet that of b, in their order; of many
 * the nearest */
std::vector<std::size_t>
candidatesOf(std::size_t b,
             const std::vector<NetworkScan>& scans,
             const std::vector<Eigen::Vector3d>& centres,
             double distance)
{
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t a = 0; a < b; ++a) {
    const double apart = (centres[a] - centres[b]).norm();
    if (apart <= scans[a].radius() + scans[b].radius() + distance)
      near.emplace_back(apart, a);
  }
  if (near.size() > kCompared) {
    std::nth_element(near.begin(), near.begin() + kCompared, near.end());
    near.resize(kCompared);
  }
  std::vector<std::size_t> candidates;
  for (const auto& [apart, a] : near)
    candidates.push_back(a);
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}
} // namespace

NetworkScan::NetworkScan(const IcpModel& model)
: model_(&model), rays_(model.points(), RayImageOptions::coarse())
{
  const Points& points = model.points();
  if (points.empty())
    return;
  Eigen::Vector3f low = points.front(), high = low;
  for (const auto& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  centre_ = 0.5 * (low + high).cast<double>();
  for (const auto& p : points)
    radius_ = std::max(radius_, (p.cast<double>() - centre_).norm());
}

PointVotes&
PointVotes::operator+=(const PointVotes& other)
{
  points += other.points;
  near += other.near;
  empty += other.empty;
  return *this;
}

double
PointVotes::share() const
{
  return points > 0 ? (static_cast<double>(near) - static_cast<double>(empty)) /
                          static_cast<double>(points)
                    : 0;
}

PointVotes
votesOf(const NetworkScan& scan,
        const NetworkScan& other,
        const Eigen::Isometry3d& T_other_scan,
        double distance,
        std::size_t stride)
{
  PointVotes votes;
  const Points& points = scan.model().points();
  const auto limit_sq = static_cast<float>(distance * distance);
  const auto sigma = static_cast<float>(kPlaceSigma * distance);
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const Eigen::Vector3f p = (T_other_scan * points[i].cast<double>()).cast<float>();
    ++votes.points;
    if (other.model().tree().nearest(p, limit_sq).index >= 0)
      ++votes.near;
    else if (other.rays().look(p, sigma).sight == Sight::kFree)
      ++votes.empty;
  }
  return votes;
}

double
overlapOf(const NetworkScan& a,
          const NetworkScan& b,
          const Eigen::Isometry3d& T_a_b,
          double distance)
{
  return std::max(sampledShare(b, a, T_a_b, distance),
                  sampledShare(a, b, T_a_b.inverse(), distance));
}

std::vector<ScanPair>
overlappingPairs(const std::vector<NetworkScan>& scans,
                 const Poses& poses,
                 double distance,
                 const std::function<double(const ScanPair&)>& min_overlap,
                 unsigned int num_threads)
{
  std::vector<Eigen::Vector3d> centres;
  for (std::size_t i = 0; i < scans.size(); ++i)
    centres.emplace_back(poses[i] * scans[i].centre());
  std::vector<std::vector<ScanPair>> found(scans.size()); // of each second scan
  parallelFor(scans.size(), num_threads, [&](std::size_t b) {
    for (const std::size_t a : candidatesOf(b, scans, centres, distance))
      if (overlapOf(scans[a], scans[b], poses[a].inverse() * poses[b], distance) >=
          min_overlap({a, b}))
        found[b].emplace_back(a, b);
  });
  std::vector<ScanPair> pairs;
  for (const auto& of_one : found)
    pairs.insert(pairs.end(), of_one.begin(), of_one.end());
  return pairs;
}

} // namespace pcl6d
