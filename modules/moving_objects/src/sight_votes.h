// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/moving_objects/moving_points.h>

#include <cstdint>
#include <vector>

namespace pcl6d::moving_objects {

/** \brief What the judges say of a place, a bit for each of them. */
struct Votes {
  std::uint16_t misses = 0; ///< saw through it
  std::uint16_t hits = 0;   ///< measured a surface there

  int
  numMisses() const
  {
    return __builtin_popcount(misses);
  }
  int
  numHits() const
  {
    return __builtin_popcount(hits);
  }
};

/** \brief A scan that judges the places of another. */
class Judge {
public:
  /** Keeps references to the scans. */
  Judge(const SeenScan& judge, const SeenScan& judged);

  /** \return what its rays say of places in the frame of the judged scan */
  std::vector<SightOfPlace>
  look(const Points& places) const;

  /** \brief Whether a ray that passed a place would have ended farther behind it than rays do
   * that meet the surface of the place itself, within their cell, where they graze it.
   * \param[in] normal of the place, in the judged scan's frame; zero: not known */
  bool
  isMiss(const SightOfPlace& seen,
         const Eigen::Vector3f& place,
         const Eigen::Vector3f& normal) const;

  bool
  hasSurface() const
  {
    return judge_->surface != nullptr;
  }

  /** \return whether a place lies on one of its surfaces; true if it has none */
  bool
  supports(const Eigen::Vector3f& place) const;

private:
  float
  sigmaOf(const Eigen::Vector3f& place, const Eigen::Vector3f& seen) const;

  const SeenScan* judge_;
  Eigen::Isometry3f T_judge_judged_;
  double noise_;              ///< [m] of the judged points
  double variance_;           ///< [m^2] of both translations
  double turn_of_judged_;     ///< [rad] sigma
  double turn_of_judge_;      ///< [rad] sigma
};

/** \brief Chooses, of the scans that may see places, those that have most to say, so that
 * each place is seen by several.
 * \param[in] candidates \param[in] sample some of the places of the judged scan */
std::vector<Judge>
chooseJudges(const std::vector<Judge>& candidates,
             const Points& sample,
             std::size_t count);

/** \brief All judges look at all places of a scan. A hit counts where the place lies on a surface of
 * who measured it; this is asked where there is a miss, too. */
std::vector<Votes>
votesOf(const std::vector<Judge>& judges,
        const SeenScan& judged,
        const Points& places,
        unsigned int num_threads);

} // namespace pcl6d::moving_objects
