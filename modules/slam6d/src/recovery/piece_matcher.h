// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/kept_scans.h"
#include "matching/scan_matcher.h"
#include "recovery/recovery.h"

#include <pcl6d/global_registration/scan_joiner.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace pcl6d::slam6d {

/** \return the scans of a piece that a bounded search compares with other scans: up to four, evenly
 * chosen, with the first and the last */
std::vector<std::size_t>
comparedOfPiece(const std::vector<std::size_t>& piece);

/** \brief Matches consecutive lost scans with each other: pieces beside the map. */
class PieceMatcher {
public:
  /** All arguments are kept by reference. */
  PieceMatcher(const Slam6DOptions& options,
               const Slam6DParameters& parameters,
               const KeptScans& scans,
               Recovery& recovery);

  /** \brief Takes the next scan, in order from the first. A registered scan ends a piece; a lost scan
   * continues the piece of the scan before, or begins a piece.
   * \param[in] scan its result in the map
   * \return whether the scan is lost, and continues a piece */
  bool
  take(const ScanResult& scan);

  /** \return the pieces: single lost scans, or consecutive lost scans matched with each other */
  const std::vector<std::vector<std::size_t>>&
  pieces() const
  {
    return pieces_;
  }

  /** \return for each taken scan its pose in its piece of several scans; pieces are groups 1, 2, ...
   */
  std::vector<std::optional<KnownPlace>>
  places() const;

  /** \return the scans taken, lost scans at their poses in the frames of their pieces */
  const std::vector<ScanResult>&
  own() const
  {
    return own_;
  }

private:
  bool
  follow(std::size_t scan);

  const Slam6DOptions& options_;
  const Slam6DParameters& parameters_;
  const KeptScans& scans_;
  Recovery& recovery_;
  std::optional<ScanMatcher> matcher_; ///< of the last piece
  std::vector<std::vector<std::size_t>> pieces_;
  std::vector<ScanResult> own_;
};

} // namespace pcl6d::slam6d
