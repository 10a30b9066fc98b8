// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/work_sharing.h>
#include <pcl6d/graph_relaxation/network_scan.h>
#include <pcl6d/visibility/ray_origin.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
constexpr std::size_t kSampledPoints = 250; ///< sampled to estimate an overlap

/** Number of earlier scans, the nearest, compared with a scan. On a long drive many scans see
 * each place, and further pairs add no information. */
constexpr std::size_t kCompared = 64;

/** Standard deviation of a point, relative to the distance within which points are near: three
 * standard deviations are twice the distance. */
constexpr double kPlaceSigma = 2.0 / 3;

/** The points of a scan for the estimate of an overlap: each stride-th point. */
struct Sample {
  explicit Sample(const Points& all)
  : points(all)
  , stride(std::max<std::size_t>(1, all.size() / kSampledPoints))
  , size((all.size() + stride - 1) / stride)
  {}

  double
  share(std::size_t near) const
  {
    return size > 0 ? static_cast<double>(near) / static_cast<double>(size) : 0;
  }

  const Points& points;
  std::size_t stride, size;
};

/** The share of the sampled points with a partner.
 * \param[in] is_decided from the least and the largest possible final share: whether to
 * stop early \return the share, or the least possible share when stopped */
template <typename IsDecided>
double
sampledShare(const NetworkScan& scan,
             const NetworkScan& other,
             const Eigen::Isometry3d& T_other_scan,
             double distance,
             IsDecided is_decided)
{
  const Sample sample(scan.model().points());
  const auto limit_sq = static_cast<float>(distance * distance);
  std::size_t looked = 0, near = 0;
  for (std::size_t i = 0; looked < sample.size; i += sample.stride) {
    const Eigen::Vector3f p =
        (T_other_scan * sample.points[i].cast<double>()).cast<float>();
    near += other.model().tree().hasNeighbour(p, limit_sq) ? 1 : 0;
    ++looked;
    if (is_decided(sample.share(near), sample.share(near + sample.size - looked)))
      break;
  }
  return sample.share(near);
}

/** \return whether overlapOf() reaches the limit; one direction may be enough */
bool
overlapBy(double enough,
          const NetworkScan& a,
          const NetworkScan& b,
          const Eigen::Isometry3d& T_a_b,
          double distance)
{
  const auto isDecided = [enough](double least, double most) {
    return least >= enough || !(most >= enough);
  };
  // In b first: its tree stays in the cache while a changes.
  return sampledShare(a, b, T_a_b.inverse(), distance, isDecided) >= enough ||
         sampledShare(b, a, T_a_b, distance, isDecided) >= enough;
}

/** \return the earlier scans with bounding spheres that meet the sphere of b, in order; if
 * there are many, the nearest */
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
: model_(&model), rays_(plausibleRays(model.points(), RayImageOptions::coarse()))
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
  Points apart; // points of the scan beyond the distance
  const Points& points = scan.model().points();
  const auto limit_sq = static_cast<float>(distance * distance);
  const auto sigma = static_cast<float>(kPlaceSigma * distance);
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const Eigen::Vector3f p = (T_other_scan * points[i].cast<double>()).cast<float>();
    ++votes.points;
    if (other.model().tree().hasNeighbour(p, limit_sq))
      ++votes.near;
    else
      apart.push_back(p);
  }
  for (const SightOfPlace& seen : other.rays().look(apart, {sigma}))
    votes.empty += seen.sight == Sight::kFree ? 1 : 0;
  return votes;
}

double
overlapOf(const NetworkScan& a,
          const NetworkScan& b,
          const Eigen::Isometry3d& T_a_b,
          double distance)
{
  const auto lookAtAll = [](double, double) { return false; };
  return std::max(sampledShare(b, a, T_a_b, distance, lookAtAll),
                  sampledShare(a, b, T_a_b.inverse(), distance, lookAtAll));
}

std::vector<ScanPair>
overlappingPairs(const std::vector<NetworkScan>& scans,
                 const Poses& poses,
                 double distance,
                 const std::function<double(const ScanPair&)>& min_overlap,
                 unsigned int num_threads,
                 WorkSharing* sharing)
{
  std::vector<Eigen::Vector3d> centres;
  for (std::size_t i = 0; i < scans.size(); ++i)
    centres.emplace_back(poses[i] * scans[i].centre());
  std::vector<std::vector<ScanPair>> found(scans.size()); // of each second scan
  sharedFor(sharing, num_threads, found, [&](std::size_t b) {
    for (const std::size_t a : candidatesOf(b, scans, centres, distance))
      if (overlapBy(min_overlap({a, b}),
                    scans[a],
                    scans[b],
                    poses[a].inverse() * poses[b],
                    distance))
        found[b].emplace_back(a, b);
  });
  std::vector<ScanPair> pairs;
  for (const auto& of_one : found)
    pairs.insert(pairs.end(), of_one.begin(), of_one.end());
  return pairs;
}

} // namespace pcl6d
