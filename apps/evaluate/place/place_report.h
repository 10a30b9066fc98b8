// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"

#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/global_registration/place_search.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/verification/verified_scan.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The command line of `pcl_slam6d_evaluate place`. */
struct PlaceSettings {
  std::string scan_a, scan_b; ///< with a run: the scan, and the run
  std::string output, picture;
  ScanFormat format = ScanFormat::kAuto;
  ScanParameterOptions parameters;
  PlaceSearchOptions search = PlaceSearchOptions::forTwoScans();
  bool quiet = false;

  /** \return whether a scan is looked for in a run */
  bool
  isInRun() const;
};

/** \brief Result of the link between a scan of a run and a found pose. */
struct LinkWords {
  std::string file; ///< name of the scan
  int index = 0;    ///< NNN of its files
  LinkCheck link;
};

/** \brief A found pose. */
struct FoundPlace {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity(); ///< for points as in the file
  double score = 0, overlap = 0, contradiction = 0;
  std::string evaluated;        ///< by points and rays, in a word
  Rejection rejection;          ///< why it is not accepted
  PlaceCandidate candidate;     ///< of a pair
  std::vector<LinkWords> links; ///< of a run
  Eigen::Isometry3d T_drawn_scan = Eigen::Isometry3d::Identity(); ///< on the picture
};

/** \brief Accuracy of a pose in a run, from its links. */
struct PlaceExactness {
  Eigen::Matrix<double, 6, 6> covariance; ///< of x y z roll pitch yaw [m, rad]
  double bound = 0;                       ///< [m] of the position, with 95 %
};

/** \brief Result of place recognition for messages, files and pictures. */
struct PlaceReport {
  PlaceAnswer answer = PlaceAnswer::kNone;
  Rejection rejection; ///< why it is not unique
  double ambiguity = 0;
  double voxel = 0; ///< [m]
  std::vector<FoundPlace> places;
  std::string of_what; ///< "of B from A": meaning of the poses
  std::vector<std::string> notes;
  std::optional<PlaceExactness> exactness; ///< of the best pose in a run
  std::string same_as;                     ///< scan of the run with identical points
  std::size_t compared = 0, placed = 0;    ///< scans of a run
  Points drawn_scan, drawn_map; ///< upright surfaces of both, for the picture
};

/** \return where B was taken, seen from A
 * \throws IoFailed, ComputeFailed a scan cannot be read, or has too few points */
PlaceReport
placeOfPair(const PlaceSettings& settings, ProgressBar& bar);

/** \return the pose of a scan in a run; empty if interrupted
 * \throws IoFailed the folder contains no finished run, a file has changed since the
 * run, or the scan is in other units \throws ComputeFailed too few points */
std::optional<PlaceReport>
placeInRun(const PlaceSettings& settings, ProgressBar& bar);

/** \brief Prints the candidates, unless quiet, and the answer to stdout. */
void
printPlaces(const PlaceSettings& settings, const PlaceReport& report);

/** \throws IoFailed the file cannot be written */
void
writePlaces(const PlaceSettings& settings, const PlaceReport& report);

/** \brief Draws the best poses side by side.
 * \return false: drawing failed; a warning has told the reason */
bool
drawPlaces(const PlaceSettings& settings, const PlaceReport& report, ProgressBar& bar);

/** \return points on upright surfaces of a scan, or every point if the upright points
 * are few
 * \param[in] up unit vector in the scan's frame */
Points
uprightPoints(const VerifiedScan& scan, const Eigen::Vector3d& up);

} // namespace pcl6d::app
