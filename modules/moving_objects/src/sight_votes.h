// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/moving_objects/moving_points.h>

#include <cstddef>
#include <cstdint>
#include <optional>
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
  /** Keeps references to the scans. \param[in] later how many scans after the judged one it
   * was measured; negative: before */
  Judge(const SeenScan& judge, const SeenScan& judged, std::ptrdiff_t later);

  std::ptrdiff_t
  later() const
  {
    return later_;
  }

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

  /** \return [m] between its rays at a place in the frame of the judged scan */
  double
  gapAt(const Eigen::Vector3f& place) const
  {
    const Eigen::Vector3f ray = T_judge_judged_ * place - judge_->rays->origin();
    return judge_->rays->resolution() * ray.norm();
  }

  /** \brief Finds how far the surfaces of both scans are apart where they meet, which tells how
   * exactly their relative pose, their surfaces and their points are known: from now on places
   * are taken to be as inexact. \param[in] sample of places of the judged scan */
  void
  calibrate(const Points& sample);

  /** \return whether its rays know where they ended near a place at least as exactly as its
   * reduced surface: from far, a hit says that something is near, not that it is there */
  bool
  tellsWhere(const Eigen::Vector3f& place) const;

  /** \return whether a place lies on one of its surfaces; true if it has none */
  bool
  supports(const Eigen::Vector3f& place) const;

private:
  std::optional<float>
  distanceToSurface(const Eigen::Vector3f& seen) const;
  float
  sigmaOf(const Eigen::Vector3f& place, const Eigen::Vector3f& seen) const;

  const SeenScan* judge_;
  std::ptrdiff_t later_;
  Eigen::Isometry3f T_judge_judged_;
  double noise_;          ///< [m] of the judged points
  double variance_;       ///< [m^2] of both translations
  double turn_of_judged_; ///< [rad] sigma
  double turn_of_judge_;  ///< [rad] sigma
};

/** \return the normal of the surface of a scan at one of its places; zero: not known */
Eigen::Vector3f
normalOf(const SeenScan& scan, const Eigen::Vector3f& place);

/** \brief The scans that judge the places of one scan, at most 16, and what they say. */
class Jury {
public:
  /** Keeps references. \param[in] candidates who may be asked
   * \param[in] judged whose places are judged \param[in] places [m] in its frame */
  Jury(std::vector<Judge> candidates,
       const SeenScan& judged,
       const Points& places,
       unsigned int num_threads);

  /** \brief Takes in more judges: those of the candidates that have most to say of some places,
   * so that each is seen by several. \return how many there are now */
  std::size_t
  choose(const std::vector<std::uint32_t>& which, std::size_t count);

  /** \brief Some judges look at some places. A hit counts where the place lies on a surface of
   * who measured it; this is asked where there is a miss, too, or where the rays alone cannot
   * tell. */
  void
  ask(const std::vector<std::uint32_t>& which, std::size_t first, std::size_t end);

  /** \return the scan whose places they judge */
  const SeenScan&
  judged() const
  {
    return judged_;
  }

  /** \return one per place */
  const std::vector<Votes>&
  votes() const
  {
    return votes_;
  }
  /** \brief Hits by judges who saw the place after, or before, another saw through it, counted
   * in time from the judged scan on: what is there, is gone and is there again is hit or missed
   * by chance, as a thin thing. Hits before the first miss tell no more than that the thing
   * stayed for a while. \return a bit for each of them */
  std::uint16_t
  lastingHits(std::size_t place) const;

  /** \return in the order of the bits of votes */
  const std::vector<Judge>&
  judges() const
  {
    return judges_;
  }

private:
  void
  orderInTime(std::size_t first);
  struct Bench { ///< judges [first, end)
    std::size_t first, end;
  };
  void
  look(const std::vector<std::uint32_t>& which,
       std::size_t begin,
       std::size_t end,
       Bench bench);
  void
  checkSurfaces(std::size_t place, Bench bench);

  std::vector<Judge> candidates_;
  const SeenScan& judged_;
  const Points& places_;
  unsigned int num_threads_;
  std::vector<Judge> judges_;
  std::vector<std::size_t> before_, after_; ///< judges, those near in time first
  std::vector<Votes> votes_;
};

} // namespace pcl6d::moving_objects
