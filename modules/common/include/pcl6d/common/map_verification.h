// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/rejection.h>

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/** \file Reliability of a map, in plain data: the module verification fills the structs, the
 * module run reads and writes them. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Result of the test of a link between two scans. */
enum class LinkTrust {
  kGood,       ///< consistent: the link connects the scans
  kWeak,       ///< too few data, or an error along an open motion is not detectable
  kUnverified, ///< free-space test inconclusive; no contradiction by the surfaces
  kWrong       ///< inconsistent: the scans contradict the link
};

/** \return "good", "weak", "unverified" or "wrong" */
const char*
toString(LinkTrust trust);
/** \throws BadArgument another name; the message lists the valid names */
LinkTrust
linkTrustFromName(const std::string& name);

/** \brief Detectable errors of a pose: the minimum detectable bias. Infinite: no error in the
 * direction is detectable. */
struct NoticedError {
  double least = std::numeric_limits<double>::infinity(); ///< [m] in the best direction
  double most = std::numeric_limits<double>::infinity();  ///< [m] along `weakest`
  double turn = std::numeric_limits<double>::infinity(); ///< [rad] about the worst axis
  /** unit; in the axes of the first scan of a link, of the world for a scan */
  Eigen::Vector3d weakest = Eigen::Vector3d::UnitX();
};

/** \brief Test of the relative pose of two scans of a map. */
struct LinkCheck {
  std::size_t from = 0; ///< index into MapVerification::scans
  std::size_t to = 0;   ///< index into MapVerification::scans
  LinkTrust trust = LinkTrust::kWeak;
  double probability_wrong = 1; ///< in [0, 1]
  double elsewhere = 1; ///< part of probability_wrong: the scan belongs to a different
                        ///< position, by the free-space test; excludes small shifts
  std::size_t patches = 0;      ///< surface patches tested by rays of the other scan
  std::size_t contradicted = 0; ///< patches with a free-space violation
  double shift = 0;             ///< [m] shift that the surfaces ask for
  double deviation = 0;         ///< [m] standard deviation of the shift
  int open_directions = 0;      ///< motions not fixed by the surfaces
  Rejection rejection;          ///< why the link is not good
  /** of the second scan's pose seen from the first, as a small motion (translation [m], rotation
   * [rad]) about the second scan's origin in the second scan's axes; zero if not known */
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  /** correction of the second scan's pose that the surfaces ask for, in the frame of covariance */
  Eigen::Matrix<double, 6, 1> pull = Eigen::Matrix<double, 6, 1>::Zero();
  bool refined = false; ///< covariance and pull are those of refined matches
  std::optional<NoticedError> noticed; ///< of tested good links
};

/** \brief Result of the verification of a scan. */
struct ScanCheck {
  bool tied = false;     ///< good links connect the scan with the rest of the map
  bool abstains = false; ///< the scan's rays contradict its own points: not used
  /** the origin is not the position of a scanner (a cut-out in a common frame): no free-space
   * tests */
  bool off_centre = false;
  /** of the pose relative to the first scan, as a small motion about the scan's origin in the
   * scan's axes, by the good links of the map; empty if not connected with the first scan */
  std::optional<Eigen::Matrix<double, 6, 6>> covariance;
  /** [m] 95 % bound of the position relative to the first scan: the radius of the sphere about the
   * position that holds the true one with 95 % */
  std::optional<double> bound;
  std::optional<NoticedError> noticed; ///< by the scan's most sensitive good link
  Rejection doubt;                     ///< about the pose; none: accepted
};

/** \brief How far a map is to be trusted. */
enum class MapTrust {
  kGood,      ///< every scan is connected, without contradictions
  kDoubtful,  ///< scans are disconnected, or contradict each other
  kAmbiguous, ///< a second pose of a scan fits about as well
  kUnverified ///< no contradictions, but missing free-space tests, or a single scan
};

/** \return "good", "doubtful", "ambiguous" or "unverified" */
const char*
toString(MapTrust trust);
/** \throws BadArgument another name; the message lists the valid names */
MapTrust
mapTrustFromName(const std::string& name);

/** \brief The verdict on a map from the points and rays of the scans. \ingroup common */
struct MapVerification {
  MapTrust trust = MapTrust::kUnverified;
  double background = 0; ///< share of patches contradicted in correct links of the map
  std::vector<LinkCheck> links;
  std::vector<ScanCheck> scans;  ///< one per scan
  std::vector<Rejection> doubts; ///< about the map

  /** \return whether the map may be used: neither doubtful nor ambiguous */
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
