// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>
#include <pcl6d/verification/link_evidence.h>
#include <pcl6d/verification/verified_scan.h>

#include <deque>
#include <string>
#include <vector>

namespace pcl6d::verification {

/** What is said of a map whose links are judged: its doubts in words, and its trust. */
class PCL6D_EXPORTS MapDoubts { // shown to its test
public:
  /** \param[in] scans, names, opinions of the links: kept by reference */
  MapDoubts(const std::deque<VerifiedScan>& scans,
            const std::vector<std::string>& names,
            const std::vector<LinkOpinion>& opinions)
  : scans_(scans), names_(names), opinions_(opinions)
  {}

  /** \param[in,out] map with its links, its background, and the scans that are tied, abstain or
   * have a second place; gets doubts, the scans' reasons, and trust */
  void
  tell(MapVerification& map) const;

private:
  /** Wrong links between scans that are both tied. */
  struct Against {
    std::vector<std::size_t> proven; ///< they contradict the map
    std::vector<std::size_t> alone;  ///< most other links of both scans say otherwise
  };

  std::vector<std::string>
  twins(const MapVerification& map) const;
  bool
  tellLoose(MapVerification& map) const;
  Against
  against(const MapVerification& map, bool is_silent) const;
  void
  tellContradicted(const std::vector<std::size_t>& links, MapVerification& map) const;
  bool
  tellAbstaining(MapVerification& map) const;
  std::string
  reasonFor(std::size_t scan, const MapVerification& map) const;
  /** \return the scans of a link and its reason */
  std::string
  told(const LinkCheck& link) const;

  const std::deque<VerifiedScan>& scans_;
  const std::vector<std::string>& names_;
  const std::vector<LinkOpinion>& opinions_;
};

} // namespace pcl6d::verification
