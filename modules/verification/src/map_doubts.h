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

/** The doubts about a map with tested links, and its verdict. */
class PCL6D_EXPORTS MapDoubts { // exported for its test
public:
  /** \param[in] scans, names, test_results results of the links' tests: all kept by reference */
  MapDoubts(const std::deque<VerifiedScan>& scans,
            const std::vector<std::string>& names,
            const std::vector<LinkTestResult>& test_results)
  : scans_(scans), names_(names), test_results_(test_results)
  {}

  /** \param[in,out] map with its links, its background, and its scans, whether connected, without
   * usable rays or ambiguous; gets doubts, the scans' reasons, and the verdict */
  void
  tell(MapVerification& map) const;

  /** \return whether tell() finds the map doubtful, whatever second poses there are
   * \param[in] map as for tell() */
  bool
  isDoubtful(const MapVerification& map) const;

private:
  /** Wrong links between connected scans. */
  struct Against {
    std::vector<std::size_t> proven; ///< contradict the map
    std::vector<std::size_t> alone;  ///< outvoted by most links of both scans
  };

  std::vector<Rejection>
  twins(const MapVerification& map) const;
  bool
  isLoose(std::size_t scan, const MapVerification& map) const;
  void
  tellNotSought(MapVerification& map) const;
  bool
  tellLoose(MapVerification& map) const;
  Against
  against(const MapVerification& map, bool is_silent) const;
  void
  tellContradicted(const std::vector<std::size_t>& links, MapVerification& map) const;
  bool
  tellAbstaining(MapVerification& map) const;
  Rejection
  reasonFor(std::size_t scan, const MapVerification& map) const;
  /** \return the scans of a link and its reason */
  Rejection
  told(const LinkCheck& link) const;

  const std::deque<VerifiedScan>& scans_;
  const std::vector<std::string>& names_;
  const std::vector<LinkTestResult>& test_results_;
};

} // namespace pcl6d::verification
