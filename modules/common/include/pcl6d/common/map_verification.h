// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/** \file How far a map is to be trusted, in plain data: the module verification fills it,
 * the module run reads and writes it. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief What is to be made of a link between two scans. */
enum class LinkTrust {
  kGood,       ///< it ties its scans
  kWeak,       ///< too little is seen to say, or an error along an open motion is not
  kUnverified, ///< the rays abstain; the surfaces have nothing against it
  kWrong       ///< the scans contradict it
};

/** \return "good", "weak", "unverified" or "wrong" */
const char*
toString(LinkTrust trust);
/** \throws BadArgument no such name; the message lists all */
LinkTrust
linkTrustFromName(const std::string& name);

/** \brief From how far on an error of a place would have been noticed: the minimum
 * detectable error. Infinite: no error in that direction would. */
struct NoticedError {
  double least = std::numeric_limits<double>::infinity(); ///< [m] where it is seen best
  double most = std::numeric_limits<double>::infinity();  ///< [m] along `weakest`
  double turn = std::numeric_limits<double>::infinity(); ///< [rad] about the worst axis
  /** unit; in the axes of the first scan of a link, of the world for a scan */
  Eigen::Vector3d weakest = Eigen::Vector3d::UnitX();
};

/** \brief What two scans of a map say of their places. */
struct LinkCheck {
  std::size_t from = 0; ///< place of a scan
  std::size_t to = 0;   ///< place of a scan
  LinkTrust trust = LinkTrust::kWeak;
  double probability_wrong = 1; ///< in [0, 1]
  double elsewhere = 1; ///< of this: that of another place, by the rays; not of a shift
  std::size_t patches = 0; ///< of surface, of which the rays of the other scan speak
  std::size_t contradicted = 0; ///< of these: the rays went through
  double shift = 0;             ///< [m] by which the surfaces would move the scan
  double deviation = 0;         ///< [m] standard deviation of its place by the surfaces
  int open_directions = 0;      ///< motions that the surfaces do not fix
  std::string reason;           ///< in words; empty for a good link
  /** of the second scan's pose seen from the first, as a small motion (translation [m],
   * rotation [rad]) about the second scan's origin in its axes; zero if there is none */
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  /** the motion by which the surfaces would move the second scan, in the same terms */
  Eigen::Matrix<double, 6, 1> pull = Eigen::Matrix<double, 6, 1>::Zero();
  std::optional<NoticedError> noticed; ///< of good links that were asked
};

/** \brief What verification says of a scan. */
struct ScanCheck {
  bool tied = false;     ///< good links join it to the rest of the map
  bool abstains = false; ///< its rays contradict its own points, and say nothing
  /** of the pose relative to the first scan, as a small motion about its origin in its
   * axes, by the good links of the map; none if they do not join it to the first scan */
  std::optional<Eigen::Matrix<double, 6, 6>> covariance;
  /** [m] with 95 % the position relative to the first scan is known so well: the longest
   * half axis of its ellipsoid */
  std::optional<double> bound;
  std::optional<NoticedError> noticed; ///< by the good link of it that sees most
  std::string doubt;                   ///< in words; empty if there is none
};

/** \brief How far a map is to be trusted. */
enum class MapTrust {
  kGood,      ///< every scan is tied, and nothing contradicts the map
  kDoubtful,  ///< some scans are not tied, or contradict each other
  kAmbiguous, ///< a scan fits at two places
  kUnverified ///< nothing contradicts the map, but scans abstain, or there is but one
};

/** \return "good", "doubtful", "ambiguous" or "unverified" */
const char*
toString(MapTrust trust);
/** \throws BadArgument no such name; the message lists all */
MapTrust
mapTrustFromName(const std::string& name);

/** \brief The verdict on a map by its scans' points and rays. \ingroup common */
struct MapVerification {
  MapTrust trust = MapTrust::kUnverified;
  double background = 0; ///< share of patches that right links of this map contradict
  std::vector<LinkCheck> links;
  std::vector<ScanCheck> scans;    ///< one per scan
  std::vector<std::string> doubts; ///< in words, each with what to do

  /** \return whether the map may be used: it is not doubtful and not ambiguous */
  bool
  trusted() const
  {
    return trust == MapTrust::kGood || trust == MapTrust::kUnverified;
  }
  /** \return the number of links with a trust */
  std::size_t
  count(LinkTrust trust_of_link) const;
};

} // namespace pcl6d
