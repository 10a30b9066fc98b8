// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/map_entropy.h>
#include <pcl6d/benchmarking/plane_thickness.h>
#include <pcl6d/benchmarking/surface_distance.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/progress.h>

#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Options of measureMap(). \ingroup benchmarking */
struct MapQualityOptions {
  double voxel = 0.1; ///< [m] of the reduction for agreement and normals; finite, > 0
  std::optional<double> radius; ///< [m] of the entropy, > 0; empty: 2 voxels
  std::optional<double>
      /** [m] largest distance of corresponding points, > 0; empty: 3 voxels */
      max_distance;
  /** [m] of share_within, > 0; empty: agreementDistance() */
  std::optional<double> within;
  std::optional<std::size_t>
      /** least index difference of a revisit; >= 2; empty: a quarter of the scans, at
       * least 5 */
      revisit_gap;
  double outlier = 3.5;         ///< robust z-score of an outlier scan; > 0
  bool planes = true;           ///< measure their thickness
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  ProgressCallback progress;    ///< may be empty

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Quality of one scan in the map. NaN: not measurable. */
struct ScanQuality {
  std::size_t neighbours = 0; ///< number of overlapping scans
  double agreement = 0;       ///< MapAgreement; in [-1, 1]
  double entropy = 0;         ///< [nat] mean over the scan's points
  double plane_variance = 0;  ///< [m^2] mean over the scan's points
  double thickness = 0;       ///< [m] rms of the scan's points on planes
  SurfaceDistances others;    ///< of the scan's points to each overlapping scan
  SurfaceDistances reference; ///< to the reference cloud; empty without reference
  /** measures with an outlying value, worst first: "agreement", "entropy", "thickness",
   * "distance to others", "distance to reference" */
  std::vector<std::string> stands_out;
  double worst_score = 0; ///< largest robust z-score, bad is positive; NaN without any
};

/** \brief How good a map is, without knowing the true poses. */
struct MapQuality {
  std::size_t pairs = 0;         ///< of overlapping scans
  double agreement = 0;          ///< MapAgreement::total; NaN without pairs
  double entropy = 0;            ///< [nat] mean map entropy
  double plane_variance = 0;     ///< [m^2] mean plane variance
  std::size_t spread_points = 0; ///< points behind these two
  PlaneThickness thickness;      ///< of the planes of single scans
  SurfaceDistances others;       ///< between overlapping scans, both ways
  SurfaceDistances steps;        ///< likewise, only neighbours in the sequence
  /** likewise, only revisits: scans far apart in the sequence */
  SurfaceDistances revisits;
  std::size_t revisit_pairs = 0;
  /** crispness around revisits: rms along the normal of revisits over the rms of steps;
   * 1: as sharp as between neighbours. NaN if either is missing */
  double revisit_blur = 0;
  /** every scan to the reference cloud; empty without reference */
  SurfaceDistances reference;
  std::vector<ScanQuality> scans;

  /** \return the scans, worst first: by worst_score, scans without score last */
  std::vector<std::size_t>
  worstFirst() const;

  /** \return one sentence with the names of the outlier scans, or saying that no scan
   * stands out
   * \param[in] names one per scan \throws BadArgument not one name per scan */
  std::string
  verdict(const std::vector<std::string>& names) const;
};

/** \brief Measures the quality of the map that scans form at their poses. Measures use
 * samples of the points, one per voxel of each scan, and are equal for any number of
 * threads. Formulas: share/doc/measures.md.
 * \param[in] scans measured points [m], each in its own frame; points that are not finite
 * are left out
 * \param[in] poses T_world_scan, one per scan
 * \param[in] reference a cloud in the world [m]; may be empty
 * \throws BadArgument an option is invalid, not one rigid pose per scan, fewer than two
 * scans, or a scan with fewer than 3 finite points or too large for the grid of the voxel */
MapQuality
measureMap(const std::vector<Points>& scans,
           const std::vector<Eigen::Isometry3d>& poses,
           const MapQualityOptions& options = MapQualityOptions(),
           const Points& reference = {});

} // namespace pcl6d
