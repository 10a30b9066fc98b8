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

/** \brief Knobs of measureMap(). \ingroup benchmarking */
struct MapQualityOptions {
  double voxel = 0.1; ///< [m] of the reduction for agreement and normals; finite, > 0
  std::optional<double> radius; ///< [m] of the entropy, > 0; none: 2 voxels
  std::optional<double>
      max_distance; ///< [m] beyond which points do not belong together, > 0; none: 3 voxels
  std::optional<double> within; ///< [m] of share_within, > 0; none: agreementDistance()
  std::optional<std::size_t>
      revisit_gap;      ///< scans so far apart in their order meet again; >= 2; none: a
                        ///< quarter of all, at least 5
  double outlier = 3.5; ///< robust z-score from which a scan stands out; > 0
  bool planes = true;   ///< measure their thickness
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  ProgressCallback progress;    ///< may be empty

  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief What one scan says of the map. NaN: nothing to measure. */
struct ScanQuality {
  std::size_t neighbours = 0; ///< scans that see the same places
  double agreement = 0;       ///< MapAgreement; in [-1, 1]
  double entropy = 0;         ///< [nat] mean over its points
  double plane_variance = 0;  ///< [m^2] mean over its points
  double thickness = 0;       ///< [m] rms of its points on planes
  SurfaceDistances others;    ///< of its points to the overlapping scans, one by one
  SurfaceDistances reference; ///< to the reference cloud; empty without one
  /** measures by which it stands out, worst first: "agreement", "entropy", "thickness",
   * "distance to others", "distance to reference" */
  std::vector<std::string> stands_out;
  double worst_score = 0; ///< largest robust z-score, bad is positive; NaN without any
};

/** \brief How good a map is, without knowing the true poses. */
struct MapQuality {
  std::size_t pairs = 0;         ///< of scans that see the same places
  double agreement = 0;          ///< MapAgreement::total; NaN without pairs
  double entropy = 0;            ///< [nat] mean map entropy
  double plane_variance = 0;     ///< [m^2] mean plane variance
  std::size_t spread_points = 0; ///< points behind these two
  PlaneThickness thickness;      ///< of the planes of single scans
  SurfaceDistances others;       ///< between all overlapping scans, both ways
  SurfaceDistances steps;        ///< the same between neighbours in the order
  SurfaceDistances revisits;     ///< the same where scans far apart in the order meet
  std::size_t revisit_pairs = 0;
  /** crispness around revisited places: rms along the normal of revisits over that of
   * steps; 1: as sharp as between neighbours. NaN without one of both */
  double revisit_blur = 0;
  SurfaceDistances reference; ///< all scans to the reference cloud; empty without one
  std::vector<ScanQuality> scans;

  /** \return the scans, worst first: by worst_score, those without one last */
  std::vector<std::size_t>
  worstFirst() const;

  /** \return one sentence that names the scans that stand out, or says that none does
   * \param[in] names one per scan \throws BadArgument not one name per scan */
  std::string
  verdict(const std::vector<std::string>& names) const;
};

/** \brief Measures the map that scans make at their poses. Everything is judged from
 * samples of the points, one per voxel of each scan: the same for any number of threads.
 * Formulas: share/doc/measures.md.
 * \param[in] scans measured points [m], each in its own frame; what is not finite is left
 * out
 * \param[in] poses T_world_scan, one per scan
 * \param[in] reference a cloud in the world [m]; empty: none
 * \throws BadArgument an option breaks its rule, not one rigid pose per scan, fewer than
 * two scans, or a scan without 3 finite points or too large for the grid of the voxel */
MapQuality
measureMap(const std::vector<Points>& scans,
           const std::vector<Eigen::Isometry3d>& poses,
           const MapQualityOptions& options = MapQualityOptions(),
           const Points& reference = {});

} // namespace pcl6d
