// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evidence_parts.h"

#include <pcl6d/common/map_verification.h>
#include <pcl6d/verification/ties.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace pcl6d::verification {

/** \brief The joint evidence of the links across a cut against these links, each with its
 * background. The ray part of each link is stored for several backgrounds. */
class CutEvidence {
public:
  /** \param[in] links kept by reference */
  CutEvidence(const std::vector<LinkCheck>& links, const CutConstants& constants);

  /** \return the log likelihood ratios. Links are correlated: m links count as sqrt(m) independent
   * links, each with their mean. \param[in] backgrounds one per link of the cut */
  RaysAgainst
  against(const std::vector<std::size_t>& cut, const std::vector<double>& backgrounds);

private:
  const RaysAgainst&
  raysOf(std::size_t link, std::size_t level);
  std::size_t
  levelOf(double background) const;
  double
  backgroundOf(std::size_t level) const;

  const std::vector<LinkCheck>& links_;
  CutConstants constants_;
  std::vector<std::optional<RaysAgainst>> known_; ///< for each link: one per background
};

} // namespace pcl6d::verification
