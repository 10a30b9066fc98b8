// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/components.h>
#include <pcl6d/common/voxel_key.h>
#include <pcl6d/object_localization/object_proposals.h>

#include <algorithm>
#include <map>
#include <unordered_map>
#include <vector>

namespace pcl6d::test {

/** \brief The true points of one object, ascending, and how well proposals cover them. */
struct ObjectCover {
  std::uint32_t id = 0;
  std::vector<std::uint32_t> points;
  double iou = 0;       ///< of the best proposal, over sets of points
  double whole_iou = 0; ///< of those that are no part of another
  double leaf_iou = 0;  ///< of those that have no parts
};

/** \return the largest piece of points that hang together, with cells of an edge [m] next
 * to each other */
inline std::vector<std::uint32_t>
largestPiece(const Points& points,
             const std::vector<std::uint32_t>& chosen,
             double cell)
{
  std::unordered_map<VoxelKey, std::size_t> cells;
  Components components(chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Eigen::Vector3f& place = points[chosen[i]];
    for (int n = 0; n < 27; ++n) {
      const Eigen::Vector3f step(n % 3 - 1.F, n / 3 % 3 - 1.F, n / 9 - 1.F);
      const auto found =
          cells.find(voxelKey(place + static_cast<float>(cell) * step, cell));
      if (found != cells.end())
        components.join(i, found->second);
    }
    cells.emplace(voxelKey(place, cell), i);
  }
  std::map<std::size_t, std::vector<std::uint32_t>> pieces;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    pieces[components.firstOf(i)].push_back(chosen[i]);
  return std::max_element(pieces.begin(),
                          pieces.end(),
                          [](const auto& a, const auto& b) {
                            return a.second.size() < b.second.size();
                          })
      ->second;
}

/** \return the points in both over the points in either; both ascending */
inline double
intersectionOverUnion(const std::vector<std::uint32_t>& a,
                      const std::vector<std::uint32_t>& b)
{
  std::vector<std::uint32_t> both;
  std::set_intersection(
      a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return static_cast<double>(both.size()) /
         static_cast<double>(a.size() + b.size() - both.size());
}

/** \param[in] object_of of each point its object, 0: none
 * \param[in] min_points of an object to count
 * \param[in] cell [m] see largestPiece(): an object that others cut in two counts as a
 * whole or with its larger piece, whichever is covered better */
inline std::vector<ObjectCover>
coverOf(const Points& points,
        const std::vector<std::uint32_t>& object_of,
        const std::vector<ObjectProposal>& proposals,
        std::size_t min_points,
        double cell)
{
  std::map<std::uint32_t, std::vector<std::uint32_t>> objects;
  for (std::uint32_t i = 0; i < object_of.size(); ++i)
    if (object_of[i] != 0)
      objects[object_of[i]].push_back(i);
  std::vector<char> has_parts(proposals.size(), 0);
  for (const auto& proposal : proposals)
    if (proposal.part_of)
      has_parts[*proposal.part_of] = 1;
  std::vector<ObjectCover> covers;
  for (auto& [id, truth] : objects) {
    if (truth.size() < min_points)
      continue;
    ObjectCover cover;
    cover.id = id;
    const auto piece = largestPiece(points, truth, cell);
    for (std::size_t k = 0; k < proposals.size(); ++k) {
      const double iou = std::max(intersectionOverUnion(truth, proposals[k].points),
                                  intersectionOverUnion(piece, proposals[k].points));
      cover.iou = std::max(cover.iou, iou);
      if (!proposals[k].part_of)
        cover.whole_iou = std::max(cover.whole_iou, iou);
      if (!has_parts[k])
        cover.leaf_iou = std::max(cover.leaf_iou, iou);
    }
    cover.points = std::move(truth);
    covers.push_back(std::move(cover));
  }
  return covers;
}

} // namespace pcl6d::test
