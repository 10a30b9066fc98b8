// SPDX-License-Identifier: BSD-3-Clause
#include "icp/sampled_localizability.h"

#include <pcl6d/common/decompositions.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::registration {

namespace {
constexpr std::size_t kSample = 400; ///< pairs: a few per cent of error, under 1 ms
constexpr std::size_t kNeighbours = 10;

/** Of a surface sampled twice, a share of pi / 100 of the points has a partner nearer than a tenth
 * of the distance to the next point; a share of one half means identical points. */
constexpr float kSamePoint = 0.1f;

/** The rounding of float coordinates, also after a rotation; measured scans are never this flat. */
constexpr double kFlat = 1e-5;

/** Ratio of the spreads across and along a line: ten points of a patch are less elongated, except
 * in one patch of a thousand. */
constexpr double kLine = 0.1;

/** \return the k-th of count places in [0, size): multiples of the golden section, which avoid
 * aliasing with scan lines or alternating faces; every place if count is size */
std::size_t
spread(std::size_t k, std::size_t count, std::size_t size)
{
  if (count == size)
    return k;
  constexpr double kGolden = 0.6180339887498949;
  const double share = kGolden * static_cast<double>(k);
  return static_cast<std::size_t>((share - std::floor(share)) *
                                  static_cast<double>(size));
}

/** A pair of the sample. */
struct Spot {
  Eigen::Vector3d source; ///< moved [m]
  const Partner* partner;
  const IcpTargetPart* part;
  std::vector<Neighbour> around; ///< the partner and its neighbours, if known

  Eigen::Vector3d
  place() const
  {
    return partner->point.cast<double>();
  }
};

bool
canSearch(const IcpTargetPart& part)
{
  return part.tree || part.search_k;
}

std::vector<Neighbour>
pointsAround(const IcpTargetPart& part, const Partner& partner)
{
  const Eigen::Vector3f& point = (*part.points)[partner.index];
  return part.tree ? part.tree->nearestK(point, kNeighbours)
                   : part.search_k(point, kNeighbours);
}

/** \return the scatter of the points around a spot, in the target's frame */
Eigen::Matrix3d
scatterAround(const Spot& spot)
{
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Points& points = *spot.part->points;
  const Eigen::Vector3f& centre = points[spot.partner->index];
  for (const auto& near : spot.around) {
    const Eigen::Vector3d d = (points[near.index] - centre).cast<double>();
    sum += d;
    scatter += d * d.transpose();
  }
  scatter -= sum * sum.transpose() / static_cast<double>(spot.around.size());
  const Eigen::Matrix3d R = spot.part->T_target_part.linear();
  return R * scatter * R.transpose();
}

bool
areSamePoints(const std::vector<Spot>& spots)
{
  const auto lies_on_it = [](const Spot& spot) {
    return spot.around.size() > 1 &&
           (spot.source - spot.place()).squaredNorm() <
               kSamePoint * kSamePoint * spot.around[1].distance_sq;
  };
  const auto count = std::count_if(spots.begin(), spots.end(), lies_on_it);
  return 2 * static_cast<std::size_t>(count) > spots.size();
}

/** \return the normal of the common plane of the spots, if any */
std::optional<Eigen::Vector3d>
commonPlane(const std::vector<Spot>& spots)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& spot : spots)
    mean += spot.place() / static_cast<double>(spots.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& spot : spots)
    scatter += (spot.place() - mean) * (spot.place() - mean).transpose();
  const auto eigen = symmetricEigen<3>(scatter);
  if (!(eigen.values(0) < kFlat * kFlat * eigen.values(2)))
    return std::nullopt;
  return Eigen::Vector3d(eigen.vectors.col(0));
}

/** \return the directions fixed by a point of a flat scan: its height, and the side of its line */
Eigen::Matrix3d
holdInPlane(const Spot& spot, const Eigen::Vector3d& normal)
{
  const Eigen::Matrix3d across = normal * normal.transpose();
  const Eigen::Matrix3d within = Eigen::Matrix3d::Identity() - across;
  const auto eigen = symmetricEigen<3>(within * scatterAround(spot) * within);
  if (!(eigen.values(1) < kLine * kLine * eigen.values(2)))
    return across;
  const Eigen::Vector3d side = normal.cross(eigen.vectors.col(2)).normalized();
  return across + side * side.transpose();
}

/** \return the normal at a partner, in the target's frame */
Eigen::Vector3d
normalAtPartner(const Spot& spot)
{
  const IcpTargetPart& part = *spot.part;
  const Eigen::Vector3f normal =
      part.normals
          ? (*part.normals)[spot.partner->index]
          : normalOf((*part.points)[spot.partner->index], spot.around, *part.points);
  return part.T_target_part.linear() * normal.cast<double>();
}

/** \return the sample; empty if a part is neither searched nor has normals */
std::vector<Spot>
sampleOf(const IcpTarget& target,
         const Points& source,
         const Placement& at,
         const std::vector<Partner>& partners,
         Metric metric)
{
  std::vector<std::size_t> paired;
  for (std::size_t i = 0; i < partners.size(); ++i)
    if (partners[i].weight > 0)
      paired.push_back(i);
  const std::size_t count = std::min(kSample, paired.size());
  std::vector<Spot> spots;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = paired[spread(k, count, paired.size())];
    const IcpTargetPart& part = target[partners[i].part];
    if (!part.normals && !canSearch(part))
      return {};
    spots.push_back({at(source[i]), &partners[i], &part, {}});
    if (canSearch(part) && (!part.normals || metric == Metric::kPoint))
      spots.back().around = pointsAround(part, partners[i]);
  }
  return spots;
}
} // namespace

std::optional<Localizability>
sampledLocalizability(const IcpTarget& target,
                      const Points& source,
                      const Placement& at,
                      const std::vector<Partner>& partners,
                      Metric metric)
{
  const std::vector<Spot> spots = sampleOf(target, source, at, partners, metric);
  const bool of_points = metric == Metric::kPoint;
  const bool same_points = of_points && areSamePoints(spots);
  const auto plane =
      of_points && !same_points && !spots.empty() ? commonPlane(spots) : std::nullopt;
  PlaneAccumulator sums;
  for (const auto& spot : spots) {
    if (same_points)
      sums.addNorm(spot.source, spot.place(), Eigen::Matrix3d::Identity());
    else if (plane && spot.around.size() > 2)
      sums.addNorm(spot.source, spot.place(), holdInPlane(spot, *plane));
    else
      sums.add(spot.source, spot.place(), normalAtPartner(spot));
  }
  if (sums.sums().count == 0)
    return std::nullopt;
  return localizabilityOf(sums.sums());
}

} // namespace pcl6d::registration
