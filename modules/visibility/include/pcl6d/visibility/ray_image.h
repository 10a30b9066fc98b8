// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/visibility/cube_faces.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The result of a free-space test of a point with the rays of a scan. */
enum class Sight {
  kUnseen,    ///< no rays passed nearby
  kBehind,    ///< hidden: all rays around the point ended before it
  kEdge,      ///< rays around the point ended before and behind it: inconclusive
  kConfirmed, ///< a surface was measured at the point
  kFree       ///< all rays around the point ended behind it: a surface there is
              ///< contradicted
};

/** \return "unseen", "behind", "edge", "confirmed" or "free" */
const char*
toString(Sight sight);

/** \brief The answer of RayImage::look(). */
struct SightOfPlace {
  Sight sight = Sight::kUnseen;
  float beyond = 0; ///< [m] kFree: distance from the point to the end of the nearest
                    ///< ray behind it
  float sigmas = 0; ///< beyond, in standard deviations of point and rays
};

/** \brief Knobs of RayImage. */
struct RayImageOptions {
  Eigen::Vector3f origin =
      Eigen::Vector3f::Zero(); ///< [m] of the rays, in the scan's frame; finite
  double noise = 0.01;         ///< [m] standard deviation of a range; finite, >= 0
  double finest = 0.0061; ///< [rad] smallest cell, 0.35 deg: the halo of a cell of this
                          ///< size covers the beam of common scanners; >= 0.0005
  double coarsest = 0.07; ///< [rad] largest cell, 4 deg; in [finest, 0.5]
  /** A cell is used only if each of its four sides has measurements: for scans with separate lines
   * (ScanSampling), which would otherwise claim free space beyond the last line. */
  bool between_lines = false;

  /** \brief For positions with an uncertainty of a fraction of a metre, e.g. in place recognition
   * or in links before their test, and for reduced points. Cells are 1.1 to 9 deg; the noise is 0,
   * because it is part of the standard deviation of the positions. Takes a fifth of the time and a
   * tenth of the memory. */
  static RayImageOptions
  coarse();

  /** \throws BadArgument naming the first invalid field, with its value */
  void
  validate() const;
};

/** \brief A scan as rays from its origin: the nearest and the farthest range measured in each
 * direction, at the resolution of the scan, for free-space tests of points.
 *
 * The rays are stored in six images on the faces of a cube, which needs no angles. Several levels
 * have cells each 1.5 times larger than in the level before; the finest level filled around the
 * point gives the result. A cell is merged with its eight neighbours, also across the edges of the
 * cube, to be robust against object edges and the width of the beam. About 0.3 MB for each face
 * with measurements.
 * \note Source: share/doc/trust.md, A scan as rays.
 * \ingroup visibility */
class RayImage {
public:
  RayImage() = default;

  /** \param[in] measured all points of the scan, not reduced, in its frame [m]; points that are not
   * finite, or at the origin (within 1e-22 m), are ignored
   * \throws BadArgument an option is invalid */
  explicit RayImage(const Points& measured, const RayImageOptions& options = {});

  /** \param[in] place position in the scan's frame [m]
   * \param[in] sigma [m] standard deviation of the position relative to the scan */
  SightOfPlace
  look(const Eigen::Vector3f& place, float sigma) const;

  /** \brief Tests many points in less time: cells are prefetched.
   * \param[in] sigmas one per place, or one for all
   * \throws BadArgument wrong number of sigmas */
  std::vector<SightOfPlace>
  look(const Points& places, const std::vector<float>& sigmas) const;

  /** \return [rad] the cells that answer for a direction: the width of a direction that rays are at
   * most apart. Wider than resolution() where lines are far apart; 0: no rays there
   * \param[in] place in that direction, in the scan's frame [m] */
  double
  cellAt(const Eigen::Vector3f& place) const;

  /** \return [m] standard deviation of a range */
  double
  noise() const
  {
    return noise_;
  }
  const Eigen::Vector3f&
  origin() const
  {
    return origin_;
  }
  /** \return [rad] the finest cells in use; 0 if the points are too few to fill any */
  double
  resolution() const
  {
    return levels_.empty() ? 0 : levels_.front().cell;
  }

  /** \brief All members, for another process (packing.h). */
  template <typename Archive>
  friend void
  packFields(Archive& archive, RayImage& image)
  {
    archive(image.origin_, image.noise_, image.levels_);
  }

private:
  struct Level {
    double cell = 0;         ///< [rad]
    int side = 0;            ///< cells along an edge of a face
    visibility::Faces faces; ///< for each cell: ranges measured in and around it

    template <typename Archive>
    friend void
    packFields(Archive& archive, Level& level)
    {
      archive(level.cell, level.side);
      for (auto& face : level.faces)
        archive(face);
    }
  };
  /** A point as the end of a ray. */
  struct Aim {
    visibility::OnCube direction;
    float range = 0; ///< [m] 0: nowhere
  };
  Aim
  aim(const Eigen::Vector3f& place) const;
  const Level*
  levelAt(const visibility::OnCube& direction) const;
  SightOfPlace
  lookAlong(const Aim& aim, float sigma) const;
  void
  fetch(const Aim& aim) const;

  /** \return the share of measured cells with enough measured neighbours */
  static double
  fill(const std::vector<visibility::CodedRay>& rays, Level& level, bool enclosed);

  Eigen::Vector3f origin_ = Eigen::Vector3f::Zero();
  double noise_ = 0;
  std::vector<Level> levels_; ///< from fine to coarse
};

} // namespace pcl6d
