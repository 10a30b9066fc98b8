// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>

#include <pcl/point_cloud.h>
#include <pcl/registration/correspondence_rejection.h>

#include <memory>
#include <string>
#include <typeinfo>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Base class of rejectors of pairs, with PCL's interface: the class of a rule
 * adds select().
 *
 * The remaining pairs keep the order of the input; input and output may be one vector. Pairs
 * without a partner (a negative index) or with a NaN distance are left out.
 * \ingroup registration */
class SelectingRejector : public pcl::registration::CorrespondenceRejector {
public:
  /** \brief The remaining pairs of the given pairs. \throws BadArgument see select() */
  void
  getRemainingCorrespondences(const pcl::Correspondences& original,
                              pcl::Correspondences& remaining) override
  {
    remaining = select(original);
  }

  /** \brief The remaining pairs of the input. PCL's method, still called through a pointer to PCL's
   * class, leaves the output unchanged for an empty input. \throws BadArgument no input is set */
  void
  getCorrespondences(pcl::Correspondences& correspondences)
  {
    if (!this->input_correspondences_)
      throw BadArgument(this->rejection_name_ + ": no input correspondences are set");
    correspondences = select(*this->input_correspondences_);
  }

protected:
  explicit SelectingRejector(const std::string& name) { this->rejection_name_ = name; }

  virtual pcl::Correspondences
  select(const pcl::Correspondences& original) = 0;

  void
  applyRejection(pcl::Correspondences& correspondences) override
  {
    correspondences = select(*this->input_correspondences_);
  }

  /** \throws BadArgument a pointer is null */
  template <typename Pointer>
  void
  requireGiven(const Pointer& pointer, const char* what) const
  {
    if (!pointer)
      throw BadArgument(this->rejection_name_ + ": " + what + " is null");
  }
};

namespace registration {

/** \return the usable pairs: with both indices and a distance */
pcl::Correspondences
usablePairs(const pcl::Correspondences& pairs);

/** \return the `count` closest pairs, in their order; ties: the smallest index of the source,
 * then of the target */
pcl::Correspondences
closestPairs(const pcl::Correspondences& pairs, std::size_t count);

/** \throws BadArgument an index of a pair is not below the number of points */
void
requireIndicesOfPairs(const pcl::Correspondences& pairs,
                      std::size_t num_source,
                      std::size_t num_target);

/** \brief A cloud of any point type, kept for a typed getter. */
class AnyCloud {
public:
  template <typename PointT>
  void
  set(const typename pcl::PointCloud<PointT>::ConstPtr& cloud)
  {
    cloud_ = cloud;
    type_ = &typeid(PointT);
  }

  /** \return null if no cloud was set \throws BadArgument the cloud has another point type */
  template <typename PointT>
  typename pcl::PointCloud<PointT>::ConstPtr
  get() const
  {
    if (cloud_ && *type_ != typeid(PointT))
      throw BadArgument("the cloud was set with another point type");
    return std::static_pointer_cast<const pcl::PointCloud<PointT>>(cloud_);
  }

private:
  std::shared_ptr<const void> cloud_;
  const std::type_info* type_ = nullptr;
};

} // namespace registration
} // namespace pcl6d
