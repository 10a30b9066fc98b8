// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/filters/surface_patch.h>
#include <pcl6d/search/point_tree.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief When a patch with its points on one line grows across lines. */
enum class LineGrowth {
  kAuto,  ///< in a scan of lines or rings (samplingOf())
  kNever, ///< the nearest points make the patch, whatever their shape, like in PCL
  kAlways ///< wherever the nearest points lie on one line
};

/** \return whether patches of a scan grow across lines
 * \param[in] points [m] \param[in] scanner [m] its position, in the frame of the points */
bool
growsAcrossLines(const Points& points,
                 const Eigen::Vector3f& scanner,
                 LineGrowth growth);

/** \brief The surface of a scan for patches that grow across lines: points reduced to about the
 * distance of the lines, and a tree over the reduced points.
 *
 * On a ring of a spinning lidar the nearest points lie on one line, and their direction of least
 * spread is noise. Among the reduced points the neighbours along the line are no nearer than the
 * neighbours across. \note Source: none known; thresholds of estimateSurfaceNormals(). */
class LineSurface {
public:
  /** \param[in] points [m] of one scan; points that are not finite are left out
   * \param[in] scanner [m] its position, in the frame of the points
   * \param[in] num_threads 0: a thread per core */
  LineSurface(const Points& points,
              const Eigen::Vector3f& scanner,
              LineGrowth growth,
              unsigned int num_threads = 0);

  /** \return false: the nearest points make the patches, whatever their shape */
  bool
  grows() const
  {
    return tree_.has_value();
  }

  /** \return the smallest patch of 16, 24, 40 or 64 reduced points with a width of at least half
   * its length, up to a width of 0.15 of the range or 8 times the distance of the reduced points;
   * a patch without normal if no size qualifies, or grows() is false */
  SurfacePatch
  patchAt(const Eigen::Vector3f& place) const;

private:
  Eigen::Vector3f scanner_;
  double spacing_ = 0; ///< [m] of the reduced points
  Points reduced_;
  std::optional<PointTree> tree_;
};

/** \brief Patches whose points lie on one line (second standard deviation at most 0.3 of the first)
 * are replaced by grown patches, if grows().
 * \param[in] places [m] of the patches \param[in,out] patches one per place
 * \throws BadArgument their number differs */
void
growLines(const Points& places,
          const LineSurface& surface,
          std::vector<SurfacePatch>& patches,
          unsigned int num_threads = 0);

/** \brief Knobs of estimateScanNormals(). */
struct ScanNormals {
  std::size_t neighbours = 20; ///< nearest points of a patch; in [3, 64]
  LineGrowth growth = LineGrowth::kAuto;

  bool
  operator==(const ScanNormals& other) const
  {
    return neighbours == other.neighbours && growth == other.growth;
  }
};

/** \brief Normals at the points of a scan: estimateNormals(), but where the nearest points lie on
 * one line (see growLines()), the normal of the patch grown across lines; zero where the grown
 * patch is still a line. Bit-identical to estimateNormals() for a scan of even sampling under
 * LineGrowth::kAuto.
 * \param[in] points [m] in the frame of the scanner \param[in] tree over the points
 * \throws BadArgument neighbours is outside [3, 64] */
Normals
estimateScanNormals(const Points& points,
                    const PointTree& tree,
                    const ScanNormals& options = {},
                    unsigned int num_threads = 0);

} // namespace pcl6d
