// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/visibility/cube_faces.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What the rays of a scan say of a place. */
enum class Sight {
  kUnseen,    ///< no rays went near it
  kBehind,    ///< hidden: all rays around it ended before it
  kEdge,      ///< rays around it ended before and behind it: they say nothing
  kConfirmed, ///< a surface was measured there
  kFree       ///< all rays around it went on behind it: a surface there is contradicted
};

/** \return "unseen", "behind", "edge", "confirmed" or "free" */
const char*
toString(Sight sight);

/** \brief The answer of RayImage::look(). */
struct SightOfPlace {
  Sight sight = Sight::kUnseen;
  float beyond = 0; ///< [m] kFree: how far behind it the nearest ray around it ended
  float sigmas = 0; ///< the same in standard deviations of place and rays
};

/** \brief Knobs of RayImage. */
struct RayImageOptions {
  Eigen::Vector3f origin =
      Eigen::Vector3f::Zero(); ///< [m] of the rays, in the scan's frame; finite
  double noise = 0.01;         ///< [m] standard deviation of a range; finite, >= 0
  double finest = 0.0061; ///< [rad] smallest cell, 0.35 deg: the halo of such a cell
                          ///< covers the beam of common scanners; >= 0.0005
  double coarsest = 0.07; ///< [rad] largest cell, 4 deg; in [finest, 0.5]
  /** A cell answers only if something was measured on each of its four sides: for scans whose
   * lines lie apart (ScanSampling), which would else claim free space beyond the last line. */
  bool between_lines = false;

  /** \brief For places that are known by a fraction of a metre, as a placement or a link
   * that is yet to be believed, and for reduced points: cells from 1.1 to 9 deg, and no
   * noise, as the standard deviation of the places holds all of it. Made in a fifth of the
   * time, with a tenth of the memory. */
  static RayImageOptions
  coarse();

  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief A scan as rays from its origin: how near and how far it measured in each
 * direction, at the scan's own resolution, so that a place can be asked for.
 *
 * Six images on the faces of a cube, so that a direction needs no angle; several sizes of
 * cells, each 1.5 times the one before, of which the finest that is filled around the
 * place answers. A cell counts with its eight neighbours, which makes the edges of things
 * and the width of the beam harmless, across the edges of the cube, too. About 0.3 MB for
 * each face that the scan looks at.
 * \note Source: share/doc/trust.md; the halo and the pyramid are algorithms.md T.1.
 * \ingroup visibility */
class RayImage {
public:
  RayImage() = default;

  /** \param[in] measured all points of the scan, not the reduced ones, in its frame [m];
   * those that are not finite, or at the origin (within 1e-22 m), are left out
   * \throws BadArgument an option breaks its rule */
  explicit RayImage(const Points& measured, const RayImageOptions& options = {});

  /** \param[in] place in the scan's frame [m]
   * \param[in] sigma [m] standard deviation of the place relative to the scan */
  SightOfPlace
  look(const Eigen::Vector3f& place, float sigma) const;

  /** \brief The same of many places, in less time: cells are fetched ahead.
   * \param[in] sigmas one per place, or one for all
   * \throws BadArgument another number of them */
  std::vector<SightOfPlace>
  look(const Points& places, const std::vector<float>& sigmas) const;

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

  /** \brief All of it, for another process (packing.h). */
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
    visibility::Faces faces; ///< of each cell what was measured in it and around it

    template <typename Archive>
    friend void
    packFields(Archive& archive, Level& level)
    {
      archive(level.cell, level.side);
      for (auto& face : level.faces)
        archive(face);
    }
  };
  /** A place as the end of a ray. */
  struct Aim {
    visibility::OnCube direction;
    float range = 0; ///< [m] 0: nowhere
  };
  Aim
  aim(const Eigen::Vector3f& place) const;
  SightOfPlace
  lookAlong(const Aim& aim, float sigma) const;
  void
  fetch(const Aim& aim) const;

  /** \return the share of measured cells that have enough measured neighbours */
  static double
  fill(const std::vector<visibility::CodedRay>& rays, Level& level, bool enclosed);

  Eigen::Vector3f origin_ = Eigen::Vector3f::Zero();
  double noise_ = 0;
  std::vector<Level> levels_; ///< from fine to coarse
};

} // namespace pcl6d
