// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp.h>

#include <memory>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Search of ICP for closest points (book 4.1.4). Every method but kApproximate is exact and
 * gives equal results; kFlann may choose another of several equally near points. */
enum class SearchMethod {
  kKdTree, ///< the k-d tree, searched from its root for each point in each iteration
  /** the cached k-d tree (A. Nüchter, K. Lingemann, J. Hertzberg, "Cached k-d tree search for
   * ICP algorithms", 3DIM 2007): searched for each point in each iteration, from the leaf of
   * its last neighbour */
  kCachedTree,
  /** the fastest, specific to this library: the k-d tree, searched only for points that may have a
   * new neighbour. Let a be the distance of a point to its neighbour at its last search, and b to
   * the second nearest. By the triangle inequality, after a motion by m the neighbour stays nearest
   * while its distance is below b - m, hence surely for m < (b - a) / 2. */
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
/** \brief Accepts "cached", too, the former word for remembered.
 * \throws BadArgument unknown name; the message lists the known names */
SearchMethod
searchMethodFromName(const std::string& name);
const char*
toString(SearchMethod method);

/** \brief Finds the nearest point within the root of a squared distance [m^2], exclusive: its
 * index and squared distance; index -1 without such a point. Safe to call from several
 * threads at once. */
using NearestSearch = std::function<Neighbour(const Eigen::Vector3f&, float)>;

/** \brief Makes the search over points [m], NaN allowed. The points need not outlive the call: the
 * search copies the needed data. */
using SearchMaker = std::function<NearestSearch(const Points&)>;

/** \brief A scan prepared for ICP, for use in a source or a part of a target: points, a search for
 * the closest, and normals if a metric needs them. Made once, matched often. */
class IcpModel {
public:
  struct Options {
    SearchMethod search = SearchMethod::kRemembered;
    SearchMaker make_search = {}; ///< a search of the caller's, in place of `search`
    bool normals = false;         ///< estimate normals, towards the
                                  ///< origin of the points
    std::size_t neighbours = 20;  ///< of a normal; in [3, 64]
    double normal_voxel = 0; ///< [m] normals are estimated from points reduced by this
                             ///< voxel: from a wider patch with averaged noise, in less
                             ///< time; 0: from the points themselves
    unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result
  };

  /** \param[in] points [m] in their own frame
   * \throws BadArgument an option is invalid */
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

  /** \return a view of the scan, the source of ICP. The views from source() and part() must not
   * outlive the model. */
  IcpSource
  source() const;
  /** \return a view of the scan, a part of the target of ICP, at a pose */
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
