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

/** \brief The rule that links scans. */
enum class LinkRule {
  kOverlap, ///< scans that overlap
  kDistance ///< scans with near positions
};

/** \return overlap, distance */
std::vector<std::string>
linkRuleNames();
/** \throws BadArgument an unknown name; the message lists the valid names */
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
  double hysteresis = 0.1;    ///< share by which a link may miss its
                              ///< threshold before being dropped; in [0, 1)
  /** number of paired points of a scan; > 0. With more than 32 links per scan on average, each
   * link has fewer points, down to 200, as further pairs are redundant. */
  std::size_t points_per_link = 600;
  Metric metric = Metric::kPoint; ///< how the pairs are to be weighed
  double gicp_epsilon = 0.1;      ///< as IcpOptions::gicp_epsilon; in (0, 1]
  double last_gicp_epsilon = 0.1; ///< of pairsOfLastRound(); in (0, 1]
  unsigned int num_threads = 0;   ///< 0: a thread per core; never changes the result
  WorkSharing* sharing = nullptr; ///< between processes; null: one process
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Registration with dynamic network construction (book 6.3): chooses the links between
 * scans from the current poses before each round of relaxation, and finds their point pairs.
 * Links are chosen again only after a pose has moved by a fifth of max_distance.
 *
 * A link made at min_overlap (link_distance) is kept until its overlap (distance) misses the
 * threshold by more than the hysteresis, so that links do not come and go.
 * \code
 * ScanNetwork network(scans, usable, options);
 * GraphSlam().relax(poses, [&](const Poses& now) { return network.pairs(now); });
 * \endcode
 * \ingroup graph_relaxation */
class ScanNetwork {
public:
  /** \param[in] scans kept by reference
   * \param[in] usable per scan: false excludes the scan from every link, also from kept links
   * \throws BadArgument an invalid option; not one flag per scan; a scan without normals, where
   * the metric needs normals */
  ScanNetwork(const std::vector<NetworkScan>& scans,
              std::vector<bool> usable,
              const ScanNetworkOptions& options);

  /** \brief Adds a permanent link, such as a loop closure.
   * \param[in] trusted never switched off by GraphSlam
   * \throws BadArgument an index out of range, or a scan linked to itself */
  void
  keep(std::size_t a, std::size_t b, LinkKind kind, bool trusted);

  /** \return the links and their pairs at the poses; links in the order of their scans. Where
   * processes share the work, each process has the pairs of the links whose later scan is its
   * own */
  std::vector<LinkPairs>
  pairs(const Poses& poses);

  /** \brief The pairs of a last round: together as many points as all calls of pairs() looked
   * at, but at most a million, whose pairs take 100 MB. The last round so takes at most about as
   * long as the rounds before. Near points are not independent: LinkPairs::redundancy lets a link
   * have the weight of its pairs of pairs().
   * \return links and pairs as pairs() */
  std::vector<LinkPairs>
  pairsOfLastRound(const Poses& poses);

  /** \return the links of the last pairs(), with pairs, rms, overlap and condition, and the
   * rejected permanent links of unusable scans; in the order of their scans */
  std::vector<ScanLink>
  describe(const Poses& poses) const;

  /** \brief Cached partner of a point in the other scan: a round moves scans so little that
   * most partners stay, without a search. */
  struct RememberedPartner {
    Eigen::Vector3f at = Eigen::Vector3f::Constant(
        std::numeric_limits<float>::infinity()); ///< [m] point at the last search
    float others = 0; ///< [m] lower bound of the distance to every other point
    int index = -1;
  };

private:
  struct Kept {
    LinkKind kind;
    bool trusted;
  };

  struct Round {
    std::size_t points_per_link; ///< pointsPerLink(), or more
    double gicp_epsilon;
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
  /** \return the step through the points of the later scan of a link */
  std::size_t
  strideOf(const ScanPair& link, std::size_t points_per_link) const;
  /** \param[in,out] remembered of the points of pointsPerLink() */
  LinkPairs
  pairsOf(const ScanPair& link,
          const Poses& poses,
          const Round& round,
          std::vector<RememberedPartner>& remembered) const;
  std::vector<LinkPairs>
  pairsOfAll(const Poses& poses, const Round& round);

  const std::vector<NetworkScan>& scans_;
  std::vector<bool> usable_;
  ScanNetworkOptions options_;
  std::map<ScanPair, Kept> kept_;
  std::set<ScanPair> chosen_;
  Poses chosen_at_;
  std::size_t looked_at_ = 0; ///< points of all calls of pairs(), of all links
  std::map<ScanPair, std::vector<RememberedPartner>> remembered_; // of chosen links
};

} // namespace pcl6d
