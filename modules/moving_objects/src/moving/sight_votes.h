// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/moving_objects/moving_points.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pcl6d::moving_objects {

/** \brief Results of the observers at a place, a bit for each observer. */
struct Votes {
  std::uint16_t misses = 0; ///< rays passed through
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

/** \brief An observer of another scan. */
class Observer {
public:
  /** Keeps references to the scans.
   * \param[in] later number of scans from the observed scan to the observer; negative: before */
  Observer(const SeenScan& observer, const SeenScan& observed, std::ptrdiff_t later);

  std::ptrdiff_t
  later() const
  {
    return later_;
  }

  /** \return the ray test of places in the frame of the observed scan
   * \param[in] deviations [m] of each place, beyond the noise of its scan; empty: none */
  std::vector<SightOfPlace>
  look(const Points& places, const std::vector<float>& deviations = {}) const;

  /** \brief Whether a ray that passed a place ended too far behind to have met the surface of
   * the place within its cell at a grazing angle.
   * \param[in] normal of the place, in the frame of the observed scan; zero: not known */
  bool
  isMiss(const SightOfPlace& seen,
         const Eigen::Vector3f& place,
         const Eigen::Vector3f& normal) const;

  bool
  hasSurface() const
  {
    return observer_->surface != nullptr;
  }

  /** \return [m] between its rays at a place in the frame of the observed scan */
  double
  gapAt(const Eigen::Vector3f& place) const
  {
    const Eigen::Vector3f seen = T_observer_observed_ * place;
    const double cell =
        std::max(observer_->rays->cellAt(seen), observer_->rays->resolution());
    return cell * (seen - observer_->rays->origin()).norm();
  }

  /** \return [m] origin of its rays, in the frame of the observed scan */
  Eigen::Vector3f
  originInObserved() const
  {
    return T_observer_observed_.inverse() * observer_->rays->origin();
  }

  /** \brief Estimates the joint error of the relative pose, the surfaces and the points, from
   * the distance of the surfaces of both scans where they meet; used for later tests.
   * \param[in] sample of places of the observed scan */
  void
  calibrate(const Points& sample);

  /** \return whether its rays locate a hit near a place at least as accurately as its reduced
   * surface. From far, a hit only means a surface nearby */
  bool
  tellsWhere(const Eigen::Vector3f& place) const;

  /** \return whether a place lies on one of its surfaces; true without surfaces */
  bool
  supports(const Eigen::Vector3f& place) const;

private:
  std::optional<float>
  distanceToSurface(const Eigen::Vector3f& seen) const;
  float
  sigmaOf(const Eigen::Vector3f& place, const Eigen::Vector3f& seen) const;

  const SeenScan* observer_;
  std::ptrdiff_t later_;
  Eigen::Isometry3f T_observer_observed_;
  double noise_;            ///< [m] of the observed points
  double variance_;         ///< [m^2] of both translations
  double turn_of_observed_; ///< [rad] sigma
  double turn_of_observer_; ///< [rad] sigma
};

/** \return the normal of the surface of a scan at one of its places; zero: not known */
Eigen::Vector3f
normalOf(const SeenScan& scan, const Eigen::Vector3f& place);

/** \brief The observers of one scan, at most 16, and their results. */
class ObserverVotes {
public:
  /** Keeps references.
   * \param[in] candidates possible observers
   * \param[in] places [m] in the frame of the observed scan */
  ObserverVotes(std::vector<Observer> candidates,
                const SeenScan& observed,
                const Points& places,
                unsigned int num_threads);

  /** \brief Adds the candidates with most results at the given places, so that several
   * observers see each place.
   * \return the number of observers */
  std::size_t
  choose(const std::vector<std::uint32_t>& which, std::size_t count);

  /** \brief Tests the given places by a range of observers. A hit counts where the place lies
   * on a surface of the observer; tested where a miss exists, too, or where the rays alone are
   * inconclusive. */
  void
  ask(const std::vector<std::uint32_t>& which, std::size_t first, std::size_t end);

  /** \return the observed scan */
  const SeenScan&
  observed() const
  {
    return observed_;
  }

  /** \return one per place */
  const std::vector<Votes>&
  votes() const
  {
    return votes_;
  }
  /** \brief Hits by observers after, or before, a miss, counted in time from the observed scan
   * on. A thin object is hit, missed and hit again by chance. Hits before the first miss mean
   * only that the object stayed for a while.
   * \return a bit for each observer */
  std::uint16_t
  lastingHits(std::size_t place) const;

  /** \return the observers in the order of the bits of votes */
  const std::vector<Observer>&
  observers() const
  {
    return observers_;
  }

private:
  void
  orderInTime(std::size_t first);
  struct Bench { ///< range of observers [first, end)
    std::size_t first, end;
  };
  void
  look(const std::vector<std::uint32_t>& which,
       std::size_t begin,
       std::size_t end,
       Bench bench);
  void
  checkSurfaces(std::size_t place, Bench bench);

  std::vector<Observer> candidates_;
  const SeenScan& observed_;
  const Points& places_;
  unsigned int num_threads_;
  std::vector<Observer> observers_;
  std::vector<std::size_t> before_, after_; ///< observers, nearest in time first
  std::vector<Votes> votes_;
};

} // namespace pcl6d::moving_objects
