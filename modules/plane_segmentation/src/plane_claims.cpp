// SPDX-License-Identifier: BSD-3-Clause
#include "plane_claims.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
constexpr std::size_t kBlockSize = 512; // surfels

/** Which parts have points in each surfel. */
class PartsInside {
public:
  PartsInside(const PlaneCloud& cloud, const std::vector<PlanePart>& parts)
  {
    const Surfels& surfels = cloud.surfels();
    std::vector<std::uint32_t> owners(cloud.points().size(), kNoPart);
    for (std::uint32_t part = 0; part < parts.size(); ++part)
      for (const auto i : parts[part].points)
        owners[i] = part;
    begin_.push_back(0);
    for (std::size_t i = 0; i < surfels.size(); ++i) {
      for (std::size_t m = surfels.begin[i]; m < surfels.begin[i + 1]; ++m)
        insert(owners[surfels.members[m]], begin_.back(), parts_);
      begin_.push_back(parts_.size());
    }
  }

  /** \brief Collects the parts of a surfel. */
  void
  collect(std::size_t surfel, std::vector<std::uint32_t>& parts) const
  {
    for (std::size_t k = begin_[surfel]; k < begin_[surfel + 1]; ++k)
      insert(parts_[k], 0, parts);
  }

private:
  static void
  insert(std::uint32_t part, std::size_t begin, std::vector<std::uint32_t>& parts)
  {
    if (part != kNoPart && std::find(parts.begin() + static_cast<std::ptrdiff_t>(begin),
                                     parts.end(),
                                     part) == parts.end())
      parts.push_back(part);
  }

  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> parts_;
};

class Claims {
public:
  Claims(const PlaneCloud& cloud,
         const std::vector<PlanePart>& parts,
         const PlaneOptions& options)
  : cloud_(cloud)
  , parts_(parts)
  , max_distance_(options.max_plane_distance)
  , least_cosine_(std::cos(options.max_angle))
  {}

  /** \return the part that a point belongs to, of those around it */
  std::uint32_t
  ownerOf(std::uint32_t i, const std::vector<std::uint32_t>& around) const
  {
    const std::uint32_t surfel = cloud_.surfels().of_point[i];
    const Eigen::Vector3d place = cloud_.points()[i].cast<double>();
    const Eigen::Vector3d ray = cloud_.viewpoint(i).cast<double>() - place;
    const Eigen::Vector3d normal = cloud_.normals()[i].cast<double>();
    double nearest = max_distance_ * cloud_.surfels().noise[surfel];
    std::uint32_t owner = kNoPart;
    for (const auto part : around) {
      const PlaneFit& plane = parts_[part].plane;
      const double distance = std::abs(plane.distance(place));
      if (distance < nearest && plane.normal.dot(ray) > 0 &&
          (!cloud_.surfels().smooth[surfel] ||
           plane.normal.dot(normal) > least_cosine_)) {
        nearest = distance;
        owner = part;
      }
    }
    return owner;
  }

private:
  const PlaneCloud& cloud_;
  const std::vector<PlanePart>& parts_;
  const double max_distance_; // [sigma]
  const double least_cosine_;
};
} // namespace

std::vector<std::uint32_t>
claimPoints(const PlaneCloud& cloud,
            const std::vector<PlanePart>& parts,
            const PlaneOptions& options)
{
  const Surfels& surfels = cloud.surfels();
  const PartsInside inside(cloud, parts);
  const Claims claims(cloud, parts, options);
  std::vector<std::uint32_t> owners(cloud.points().size(), kNoPart);
  parallelBlocks(
      surfels.size(), kBlockSize, cloud.numThreads(), [&](const Block& block) {
        std::vector<std::uint32_t> around;
        for (std::size_t i = block.begin; i < block.end; ++i) {
          around.clear();
          for (std::size_t k = surfels.link_begin[i]; k < surfels.link_begin[i + 1];
               ++k)
            inside.collect(surfels.links[k], around);
          std::sort(around.begin(), around.end());
          for (std::size_t m = surfels.begin[i]; m < surfels.begin[i + 1]; ++m)
            owners[surfels.members[m]] = claims.ownerOf(surfels.members[m], around);
        }
      });
  return owners;
}

} // namespace pcl6d
