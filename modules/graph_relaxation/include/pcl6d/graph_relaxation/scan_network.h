// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/graph_relaxation/link_sums.h>
#include <pcl6d/graph_relaxation/network_scan.h>
#include <pcl6d/graph_relaxation/scan_link.h>

#include <limits>
#include <map>
#include <set>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

class WorkSharing;

/** \brief Which scans are linked. */
enum class LinkRule {
  kOverlap, ///< those that see the same places
  kDistance ///< those whose positions are near
};

/** \return overlap, distance */
std::vector<std::string>
linkRuleNames();
/** \throws BadArgument no such name; the message lists all */
LinkRule
linkRuleFromName(const std::string& name);
const char*
toString(LinkRule rule);

/** \brief Knobs of ScanNetwork. */
struct ScanNetworkOptions {
  LinkRule rule = LinkRule::kOverlap;
  double max_distance = 0.25; ///< [m] largest distance of paired points; > 0
  double min_overlap = 0.6; ///< of kOverlap: share of points with a partner; in [0, 1]
  double link_distance = 7.5; ///< [m] of kDistance: between the positions; > 0
  double hysteresis =
      0.1; ///< share by which a link may fall short of what made it before it
           ///< is dropped; in [0, 1)
  /** so many points of a scan are paired; > 0. Of more than 32 links to a scan, on average,
   * fewer, down to 200, as all of them together say the same. */
  std::size_t points_per_link = 600;
  Metric metric = Metric::kPoint; ///< how the pairs are to be weighed
  double gicp_epsilon = 0.1;      ///< as IcpOptions::gicp_epsilon; in (0, 1]
  unsigned int num_threads = 0;   ///< 0: one per core; never changes the result
  WorkSharing* sharing = nullptr; ///< of the work between processes; null: none
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Registration with dynamic network construction (book 6.3): the links between
 * scans, chosen anew from the current poses before every round of relaxation, and the
 * pairs of points that each of them has. They are chosen when a pose has moved by a fifth
 * of max_distance since, as otherwise they are the same.
 *
 * A link made at min_overlap (link_distance) is kept until it falls below (is beyond) by
 * more than the hysteresis, so that links do not come and go. \code
 * ScanNetwork network(scans, usable, options);
 * GraphSlam().relax(poses, [&](const Poses& now) { return network.pairs(now); });
 * \endcode \ingroup graph_relaxation */
class ScanNetwork {
public:
  /** \param[in] scans kept by reference
   * \param[in] usable per scan: false keeps it without links, also kept ones
   * \throws BadArgument an option breaks its rule; not one flag per scan; a scan without
   * normals, where the metric needs them */
  ScanNetwork(const std::vector<NetworkScan>& scans,
              std::vector<bool> usable,
              const ScanNetworkOptions& options);

  /** \brief A link that is always there, such as a closed loop.
   * \param[in] trusted never switched off by GraphSlam
   * \throws BadArgument no such scan, or a scan linked to itself */
  void
  keep(std::size_t a, std::size_t b, LinkKind kind, bool trusted);

  /** \return the links and their pairs at the poses; links in the order of their scans.
   * Where processes share the work, each has the pairs of its own links: those whose later
   * scan it owns */
  std::vector<LinkPairs>
  pairs(const Poses& poses);

  /** \return the links of the last pairs(), with pairs, rms, overlap and condition, and
   * the kept ones of scans that are not usable, refused; in the order of their scans */
  std::vector<ScanLink>
  describe(const Poses& poses) const;

  /** \brief What a point knows of its partner in the other scan: rounds move scans by so
   * little that most partners stay, which needs no search. */
  struct RememberedPartner {
    Eigen::Vector3f at = Eigen::Vector3f::Constant(
        std::numeric_limits<float>::infinity()); ///< [m] where the point was then
    float others = 0; ///< [m] all other points were no nearer than this
    int index = -1;
  };

private:
  struct Kept {
    LinkKind kind;
    bool trusted;
  };

  double
  slack(const ScanPair& link) const;
  std::set<ScanPair>
  byOverlap(const Poses& poses) const;
  std::set<ScanPair>
  byDistance(const Poses& poses) const;
  void
  choose(const Poses& poses);
  ScanLink
  describeLink(const ScanPair& pair, const Poses& poses) const;
  std::size_t
  pointsPerLink() const;
  LinkPairs
  pairsOf(const ScanPair& link,
          const Poses& poses,
          std::vector<RememberedPartner>& remembered) const;

  const std::vector<NetworkScan>& scans_;
  std::vector<bool> usable_;
  ScanNetworkOptions options_;
  std::map<ScanPair, Kept> kept_;
  std::set<ScanPair> chosen_;
  Poses chosen_at_;
  std::map<ScanPair, std::vector<RememberedPartner>> remembered_; // of chosen links
};

} // namespace pcl6d
