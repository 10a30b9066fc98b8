// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/pcl/correspondence_rejector.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Leaves a share of the pairs, the closest: drop-in for
 * pcl::registration::CorrespondenceRejectorTrimmed. The number of remaining pairs equals PCL's;
 * pairs stay in order (PCL: shuffled), ties by index.
 * \note Source: D. Chetverikov, D. Svirko, D. Stepanov, P. Krsek, "The trimmed iterative
 * closest point algorithm", ICPR 2002. \ingroup registration */
class CorrespondenceRejectorTrimmed : public SelectingRejector {
public:
  using Ptr = pcl::shared_ptr<CorrespondenceRejectorTrimmed>;
  using ConstPtr = pcl::shared_ptr<const CorrespondenceRejectorTrimmed>;

  CorrespondenceRejectorTrimmed() : SelectingRejector("CorrespondenceRejectorTrimmed")
  {}

  /** \brief The remaining share, at least 0 and at most 1; 0.5 unless set.
   * \throws BadArgument NaN */
  void
  setOverlapRatio(float ratio);
  float
  getOverlapRatio() const
  {
    return overlap_ratio_;
  }

  /** \brief Least number of remaining pairs, if the input has enough; 0 unless set. */
  void
  setMinCorrespondences(unsigned int count)
  {
    min_correspondences_ = count;
  }
  unsigned int
  getMinCorrespondences() const
  {
    return min_correspondences_;
  }

protected:
  pcl::Correspondences
  select(const pcl::Correspondences& original) override;

private:
  float overlap_ratio_ = 0.5f;
  unsigned int min_correspondences_ = 0;
};

} // namespace pcl6d
