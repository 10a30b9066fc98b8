// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/search/neighbour.h>

#include <pcl/search/kdtree.h>
#include <pcl/search/search.h>

#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Origin for the coordinates of a cloud: zero, unless nearly all points lie farther than
 * 8 km from zero and within 8 km of each other; then their median, rounded to multiples of 1024 m,
 * which float subtracts without rounding. Distances to points in UTM coordinates thereby keep the
 * digits of a query in double. */
Eigen::Vector3f
localOrigin(const Points& points);

/** \brief Return type of PCL's setInputCloud(): void up to 1.13, bool since 1.14. */
template <typename Base>
using SetInputCloudResult =
    decltype(std::declval<Base&>().setInputCloud(nullptr, nullptr));

/** \brief For constructors that reject a number where PCL's take a bool. */
template <typename Number>
using OnlyNumbers = std::enable_if_t<std::is_arithmetic<Number>::value &&
                                     !std::is_same<Number, bool>::value>;

/** \brief Base class of searches: PCL's interface on top of a core free of point types.
 *
 * Converts clouds, indices and results; the class of one structure adds build() and its
 * peculiarities. Distances are over the coordinates x, y, z [m]; point representations of the base
 * class are not used. Results are always sorted, ties by index. Indices refer to the input cloud,
 * also when only a part of its points is searched. Searches of one object may run in parallel.
 * \tparam Core structure free of point types, like PointTree
 * \tparam Base pcl::search::KdTree<PointT>, the only type accepted by pcl::Registration (the FLANN
 * part stays empty), or pcl::search::Search<PointT> \ingroup search */
template <typename PointT, typename Core, typename Base>
class CoreSearch : public Base {
public:
  using Base::nearestKSearch;
  using Base::radiusSearch;
  using PointCloudConstPtr = typename pcl::PointCloud<PointT>::ConstPtr;

  /** \brief Builds the structure. \param[in] indices the points to search; null: every point
   * \return true, where PCL's class returns a bool
   * \throws BadArgument the cloud is null, or an index is out of range */
  SetInputCloudResult<Base>
  setInputCloud(const PointCloudConstPtr& cloud,
                const pcl::IndicesConstPtr& indices = nullptr) override;

  /** \return the number of neighbours found: k, or the number of points if smaller. With 0, the
   * vectors still hold one entry, index -1 and an infinite distance, since PCL's own callers read
   * the first entry unchecked */
  int
  nearestKSearch(const PointT& point,
                 int k,
                 pcl::Indices& k_indices,
                 std::vector<float>& k_sqr_distances) const override;

  /** \return the number of points nearer than radius [m]
   * \param[in] max_nn keep at most max_nn of the nearest; 0: no limit */
  int
  radiusSearch(const PointT& point,
               double radius,
               pcl::Indices& k_indices,
               std::vector<float>& k_sqr_distances,
               unsigned int max_nn = 0) const override;

  /** \return the origin of the core's coordinates [m], see localOrigin() */
  const Eigen::Vector3f&
  origin() const
  {
    return origin_;
  }

  /** \brief Limited search: the nearest point within a distance, without vectors.
   * \param[in] max_distance [m]; a point at exactly this distance is not accepted
   * \return index in the input cloud, -1: not found */
  Neighbour
  nearest(const PointT& point, double max_distance) const;

protected:
  /** \param[in] name returned by getName() */
  explicit CoreSearch(const std::string& name)
  {
    this->name_ = name;
    this->sorted_results_ = true;
  }

  /** \return the structure over the points to be searched */
  virtual std::shared_ptr<const Core>
  build(const Points& points) = 0;

  // Indices found refer to the points given to build().
  virtual Neighbour
  findNearest(const Eigen::Vector3f& query, float max_distance_sq) const
  {
    return core_->nearest(query, max_distance_sq);
  }
  virtual std::vector<Neighbour>
  findK(const Eigen::Vector3f& query, std::size_t k) const
  {
    return core_->nearestK(query, k);
  }

  /** \return the neighbour with its index in the input cloud */
  Neighbour
  inCloud(Neighbour found) const
  {
    if (this->indices_ && found.index >= 0)
      found.index = (*this->indices_)[found.index];
    return found;
  }

  /** \brief Writes the result of a search for k points in the form expected by PCL's callers. */
  int
  toPcl(const Neighbour& found,
        pcl::Indices& indices,
        std::vector<float>& sqr_distances) const;
  int
  toPcl(const std::vector<Neighbour>& found,
        pcl::Indices& indices,
        std::vector<float>& sqr_distances) const;

  /** \return the coordinates of a point relative to the core's origin */
  Eigen::Vector3f
  local(const PointT& point) const
  {
    return point.getVector3fMap() - origin_;
  }

  Eigen::Vector3f origin_ = Eigen::Vector3f::Zero();
  std::shared_ptr<const Core> core_ = std::make_shared<Core>(); ///< at first empty
};

/** \return the square of a distance [m] for the cores; infinite on overflow of float; 0, which no
 * point is nearer than, for a negative distance or NaN */
inline float
squaredLimit(double distance)
{
  constexpr double kMost = std::numeric_limits<float>::max();
  const double sq = distance > 0 ? distance * distance : 0;
  return sq > kMost ? std::numeric_limits<float>::infinity() : static_cast<float>(sq);
}

} // namespace pcl6d
#include <pcl6d/search/pcl/impl/core_search.hpp>
