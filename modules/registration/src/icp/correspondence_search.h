// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/parallel.h>
#include <pcl6d/registration/icp.h>

#include <vector>

namespace pcl6d::registration {

/** The neighbour of a source point in the target; one cache line. */
struct alignas(64) Partner {
  Eigen::Vector3f point = Eigen::Vector3f::Zero();  ///< the neighbour, target's frame
  Eigen::Vector3f normal = Eigen::Vector3f::Zero(); ///< at the neighbour, of
                                                    ///< unit length, for the
                                                    ///< metrics with normals
  Eigen::Vector3f searched_at = Eigen::Vector3f::Constant(
      std::numeric_limits<float>::infinity()); ///< position of the source point at
                                               ///< its last search
  float others = 0; ///< [m] least distance of any other point to searched_at
  int index = -1;   ///< of the neighbour in its part; -1: no point within `others`
  int part = -1;
  float distance_sq = 0; ///< [m^2] at the last pose
  float weight = 0;      ///< of the pair at the last pose; 0: no pair
  bool usable = false;   ///< neighbour and normal satisfy the metric
};

/** Where ICP has the source: at a pose, scaled beforehand. */
struct Placement {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity(); ///< to the target's frame
  double scale = 1;

  /** \return where a source point is; with scale 1 the bits of T * p */
  Eigen::Vector3d
  operator()(const Eigen::Vector3f& p) const
  {
    return T * (scale * p.cast<double>());
  }
};

/** The closest pairs at successive poses. With SearchMemory::kNeighbours no search is needed while
 * a source point has moved by less than half the difference of its distances to the nearest and
 * second nearest point: exact. */
class CorrespondenceSearch {
public:
  static constexpr std::size_t kBlockSize = 256; ///< source points

  CorrespondenceSearch(const IcpTarget& target,
                       const IcpSource& source,
                       const IcpOptions& options);

  /** Finds the pairs at a pose.
   * \param[in] limit [m] largest distance of a pair, exclusive
   * \param[in] next_motion [m] how far points are likely to move in further iterations
   * \param[in] stride only every n-th source point is used */
  void
  update(const Placement& source, double limit, double next_motion, int stride);

  /** Takes the pairs of a caller instead. \throws BadArgument an index is out of range */
  void
  setPairs(const std::vector<IcpPair>& pairs);

  /** \return the pairs in use */
  std::vector<IcpPair>
  pairs() const;

  std::vector<Partner>&
  partners()
  {
    return partners_;
  }

  /** \return their number */
  std::size_t
  count() const;

  /** The searches of an update(). */
  struct Searches {
    std::size_t all = 0;       ///< source points with a new search
    std::size_t from_leaf = 0; ///< searches from a remembered leaf
  };

  /** \return the searches of the last update() */
  Searches
  searches() const;

private:
  /** A pose with the data for searches at this pose. */
  struct Look;
  Searches
  updateBlock(const Look& look, const Block& block);
  void
  search(const Look& look, std::size_t i, const Eigen::Vector3f& p, float own);
  /** \return whether the next search of a source point starts at a leaf */
  bool
  knowsLeaf(std::size_t i) const;
  /** \return whether best is now a point of the part (true for the candidate, too) */
  bool
  searchPart(const Look& look,
             std::size_t i,
             int place,
             int candidate,
             TwoNearest& best);
  void
  setPartner(std::size_t i, int part, int index);
  bool
  isUsable(std::size_t i) const;
  bool
  facesAlike(const Look& look, std::size_t i) const;

  const IcpTarget& target_;
  const Points& source_;
  const Normals* source_normals_; ///< null unless needed by the metric
  const IcpOptions& options_;
  float frames_ = 0;              ///< [m] largest distance of a part's origin from the
                                  ///< target's origin
  bool remembers_;                ///< neighbours, see SearchMemory
  std::vector<char> is_identity_; ///< T_target_part, per part
  std::vector<Partner> partners_;
  /** per part and source point, the leaf of its last search, -1: not known; empty for parts without
   * SearchMemory::kLeaves */
  std::vector<std::vector<int>> leaves_;
  std::vector<Searches> searches_; ///< per block
};

} // namespace pcl6d::registration
