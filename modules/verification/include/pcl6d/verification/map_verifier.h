// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>
#include <pcl6d/verification/link_evidence.h>
#include <pcl6d/verification/verified_scan.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

class WorkSharing;
namespace verification {
struct Ties;
}

/** \brief The evidence of the links of a verdict, by the indices of their scans. A further verdict on
 * the same scans takes over the links whose scans have kept their relative pose, bit by bit. */
using LinkMemory = std::map<std::pair<std::size_t, std::size_t>, LinkEvidence>;

/** \brief Knobs of MapVerifier. */
struct MapVerifierOptions {
  /** number of tested links from each scan to earlier scans, in addition to the previous scan: the
   * links with the most informative rays; > 0 */
  std::size_t links_per_scan = 4;
  /** for each scan: registered without a prior pose, e.g. by features, which requires a search for
   * a second pose, as long as it decides the verdict: not in a map that is doubted anyway. Scans that
   * were left out are named; empty: no scan */
  std::vector<bool> unsure;
  /** for each scan: could not be matched, and its pose is a prediction. Its links are tested, but
   * the scan does not count as connected; empty: no scan */
  std::vector<bool> unregistered;
  /** matches were refined, as between lines of a scan that lie far apart: LinkCheck::pull and
   * covariance are those of refined links, see refineEvidence(); changes no verdict */
  bool refined = false;
  /** displaces the most certain link of each scan, to find the detectable shift */
  bool probe = true;
  /** asked whether the map is kept, given for each scan whether it is connected. If not, the
   * verifier neither searches for second poses nor probes; empty: the map is kept */
  std::function<bool(const std::vector<bool>& connected)> is_kept;
  LinkMemory* memory = nullptr; ///< of the verdict before on the same scans; null: none
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  WorkSharing* sharing = nullptr; ///< between processes; null: none
  /** \throws BadArgument naming the first invalid field, with its value */
  void
  validate() const;
};

/** \brief The verdict on a map: overlapping scans, tests of their relative poses, connected scans,
 * and contradictions.
 *
 * Links are chosen by the information in their rays, not by the agreement of the scans, and
 * independently of the links used to register them: the verdict applies to maps of any program.
 * \code
 * pcl6d::MapVerifier verifier(scans, names);
 * const pcl6d::MapVerification verdict = verifier.verify(poses);
 * \endcode \ingroup verification */
class MapVerifier {
public:
  /** \param[in] scans kept by reference
   * \param[in] names of the scans, for people; one per scan
   * \throws BadArgument an option is invalid, or the numbers of names and scans differ */
  MapVerifier(const std::deque<VerifiedScan>& scans,
              std::vector<std::string> names,
              const MapVerifierOptions& options = {});

  /** \param[in] T_world_scan one per scan
   * \throws BadArgument the numbers of poses and scans differ, or a pose is not a rigid motion */
  MapVerification
  verify(const std::vector<Eigen::Isometry3d>& T_world_scan);

  /** \return the evidence of the links of the last verify(), in order */
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
  checkScans(const verification::Ties& ties, MapVerification& map) const;
  const LinkEvidence*
  knownEvidence(const Pair& pair) const;
  void
  collectEvidence(const std::vector<Pair>& pairs,
                  const std::vector<Eigen::Isometry3d>& poses);
  void
  remember(const std::vector<Pair>& pairs);
  void
  refineLinks(MapVerification& map);
  void
  findTwins(const std::vector<Eigen::Isometry3d>& poses, MapVerification& map) const;
  std::vector<std::size_t>
  unsureScans(const MapVerification& map) const;
  Rejection
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
  std::vector<LinkTestResult> test_results_; ///< one per link
};

} // namespace pcl6d
