// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cut_runs.h"

#include <array>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace pcl6d::bench {

/** \brief Verdicts on a group of runs. */
struct CutCounts {
  std::size_t runs = 0, good = 0, doubted = 0;
  std::size_t wrong = 0, false_goods = 0;  ///< wrong maps; called good
  std::size_t right = 0, false_doubts = 0; ///< right maps; doubted
  /** maps with consistent links at a wrong relative pose; with one left between connected scans */
  std::size_t misplaced = 0, missed = 0;
  std::size_t right_cuts = 0; ///< maps cut though all consistent links are right

  CutCounts&
  operator+=(const CutCounts& other);

  /** \return the loss of a fit: a missed wrong place weighs as much as ten right maps cut */
  std::size_t
  loss() const;
};

/** \brief Fits the constants of cuts by the verdicts on runs. */
class CutFit {
public:
  using BySensor = std::map<std::string, CutCounts>;

  /** \param[in] runs kept by reference */
  explicit CutFit(const std::vector<CutRun>& runs) : runs_(runs) {}

  /** \return the counts of each sensor with given constants; stored */
  const BySensor&
  counts(const verification::CutConstants& constants);

  /** \return the constants with the least loss over all sensors except one: one constant after the
   * other along its ladder, in the middle of the values with equal loss, until none changes
   * \param[in] left_out sensor; empty: none */
  verification::CutConstants
  fitWithout(const std::string& left_out);

private:
  std::size_t
  lossWithout(const std::string& left_out, const verification::CutConstants& constants);

  const std::vector<CutRun>& runs_;
  std::map<std::array<double, 6>, BySensor> known_;
};

/** \brief A table by sensor of the verdicts on maps, with the constants in use and with the constants
 * fitted to all other sensors, and a table of the cuts with the fitted constants. */
void
printLeftOutSensors(CutFit& fit, std::ostream& out);

/** \brief For each constant a row: wrong places missed and right maps cut along its ladder, the other
 * constants as in use. */
void
printLadders(CutFit& fit, std::ostream& out);

} // namespace pcl6d::bench
