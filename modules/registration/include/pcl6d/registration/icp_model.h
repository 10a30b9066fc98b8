// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp.h>

#include <memory>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How ICP looks for closest points (book 4.1.4). All but kApproximate are exact and
 * give the same result; kFlann up to which of several equally near points it takes. */
enum class SearchMethod {
  kKdTree, ///< the k-d tree, searched from its root for each point in each iteration
  /** the cached k-d tree (A. Nüchter, K. Lingemann, J. Hertzberg, "Cached k-d tree search for
   * ICP algorithms", 3DIM 2007): searched for each point in each iteration, from the leaf of
   * its last neighbour */
  kCachedTree,
  /** ours, the fastest: the k-d tree, searched only for points that may have a new
   * neighbour. One that has moved by m since its search, where its neighbour was at a
   * distance a and any other point at b at least, keeps its neighbour while it is nearer to
   * it than b - m, hence surely for m < (b - a) / 2, by the triangle inequality. */
  kRemembered,
  kApproximate, ///< the k-d tree; a neighbour may be farther by a tenth than the nearest
  kOctree,
  kBruteForce, ///< every point: the oracle of tests
  kFlann,      ///< FLANN's k-d tree, the engine of pcl::search::KdTree; see FlannTree
  kCached [[deprecated("it is kRemembered; the published one is kCachedTree")]] =
      kRemembered
};

/** \return kdtree, cached-tree, remembered, approximate, octree, brute-force, flann */
std::vector<std::string>
searchMethodNames();
/** \brief Also takes "cached", the former word for remembered.
 * \throws BadArgument no such name; the message lists all */
SearchMethod
searchMethodFromName(const std::string& name);
const char*
toString(SearchMethod method);

/** \brief Finds the nearest point within the root of a squared distance [m^2], exclusive:
 * its place among the points and its squared distance; index -1 if there is none. Several
 * threads may ask at once. */
using NearestSearch = std::function<Neighbour(const Eigen::Vector3f&, float)>;

/** \brief Makes the search over some points [m], which may hold NaN. The points are gone
 * afterwards: what the search needs of them it copies. */
using SearchMaker = std::function<NearestSearch(const Points&)>;

/** \brief A scan made ready for ICP, as source or as part of a target: points, what finds
 * the closest of them, and normals if a metric needs them. Made once, matched often. */
class IcpModel {
public:
  struct Options {
    SearchMethod search = SearchMethod::kRemembered;
    SearchMaker make_search = {}; ///< a search of the caller's, in place of `search`
    bool normals = false;         ///< estimate them; towards the origin of the points
    std::size_t neighbours = 20;  ///< of a normal; in [3, 64]
    double normal_voxel = 0; ///< [m] normals are those of the points reduced by this
                             ///< voxel: from a wider patch, whose noise is averaged,
                             ///< in less time; 0: of the points themselves
    unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  };

  /** \param[in] points [m] in their own frame
   * \throws BadArgument an option breaks its rule */
  IcpModel(Points points, const Options& options);
  /** \param[in] normals one per point, given
   * \throws BadArgument their number differs */
  IcpModel(Points points, Normals normals, const Options& options);

  const Points&
  points() const
  {
    return points_;
  }
  const Normals&
  normals() const
  {
    return normals_;
  }
  const PointTree&
  tree() const
  {
    return *tree_;
  }

  /** \return itself as the data of ICP. Both views must not outlive the model. */
  IcpSource
  source() const;
  /** \return itself as a part of the model of ICP, at a pose */
  IcpTargetPart
  part(const Eigen::Isometry3d& T_target_part = Eigen::Isometry3d::Identity()) const;

private:
  void
  build(const Options& options);
  Normals
  makeNormals(const Options& options) const;

  Points points_;
  Normals normals_;
  bool has_normals_;
  std::shared_ptr<const PointTree> tree_;
  SearchMemory memory_ = SearchMemory::kNone;
  NearestSearch search_;
};

} // namespace pcl6d
