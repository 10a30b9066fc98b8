// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>
#include <pcl6d/verification/link_evidence.h>
#include <pcl6d/verification/verified_scan.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <deque>
#include <string>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

class WorkSharing;

/** \brief Knobs of MapVerifier. */
struct MapVerifierOptions {
  /** so many links of each scan with earlier ones are judged, besides that with the scan
   * before: those whose rays have most to say; > 0 */
  std::size_t links_per_scan = 4;
  /** per scan: its place was found without a prior pose, by features say, so that a second
   * one is looked for; empty: none was */
  std::vector<bool> unsure;
  /** displaces the link of each scan that sees most, to find which errors it would notice */
  bool probe = true;
  unsigned int num_threads = 0;   ///< 0: one per core; never changes the result
  WorkSharing* sharing = nullptr; ///< of the work between processes; null: none
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief The verdict on a map: which scans see each other, what they say of their relative
 * poses, which are tied to the rest, and what contradicts the map.
 *
 * Links are chosen by how much the rays have to say, not by how well the scans agree, and
 * not by the links that the map was made of: so it judges maps of any program.
 * \code
 * pcl6d::MapVerifier verifier(scans, names);
 * const pcl6d::MapVerification verdict = verifier.verify(poses);
 * \endcode \ingroup verification */
class MapVerifier {
public:
  /** \param[in] scans kept by reference
   * \param[in] names of the scans, for people; one per scan
   * \throws BadArgument an option breaks its rule, or not one name per scan */
  MapVerifier(const std::deque<VerifiedScan>& scans,
              std::vector<std::string> names,
              const MapVerifierOptions& options = {});

  /** \param[in] T_world_scan one per scan
   * \throws BadArgument not one pose per scan, or one is not a rigid motion */
  MapVerification
  verify(const std::vector<Eigen::Isometry3d>& T_world_scan);

  /** \return the evidence of the links of the last verify(), in their order */
  const std::vector<LinkEvidence>&
  evidence() const
  {
    return evidence_;
  }

private:
  using Pair = std::pair<std::size_t, std::size_t>;

  std::vector<Pair>
  choosePairs(const std::vector<Eigen::Isometry3d>& poses) const;
  std::size_t
  speaking(const Pair& pair, const std::vector<Eigen::Isometry3d>& poses) const;
  void
  findTwins(const std::vector<Eigen::Isometry3d>& poses, MapVerification& map) const;
  std::string
  twinOf(std::size_t scan,
         const std::vector<Eigen::Isometry3d>& poses,
         const MapVerification& map) const;
  bool
  fitsElsewhere(std::size_t scan,
                std::size_t beside,
                const Eigen::Isometry3d& T_world_scan,
                const std::vector<Eigen::Isometry3d>& poses,
                const MapVerification& map) const;
  void
  probe(const std::vector<Eigen::Isometry3d>& poses, MapVerification& map) const;

  const std::deque<VerifiedScan>& scans_;
  std::vector<std::string> names_;
  MapVerifierOptions options_;
  std::vector<Eigen::Vector3d> centres_; ///< [m] of the points, in their scan's frame
  std::vector<LinkEvidence> evidence_;
  std::vector<LinkOpinion> opinions_; ///< one per link
};

} // namespace pcl6d
