// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "accepted.h"
#include "judge.h"

#include <map>

namespace pcl6d::faults {

/** \brief Counts what was found, program by program. */
class RoundReport {
public:
  explicit RoundReport(std::uint64_t seed) : seed_(seed) {}

  /** \return the findings with the lines to repeat them; nothing: there are none */
  std::string
  add(const Case& one, const Trace& trace, const std::vector<Finding>& findings);

  std::size_t
  cases() const
  {
    return cases_;
  }
  std::size_t
  findings() const
  {
    return findings_;
  }

  /** \return the table program by kind, and how often each acceptance was needed */
  std::string
  table(const std::vector<Acceptance>& acceptances) const;

private:
  struct Row {
    std::size_t cases = 0;
    std::map<std::string, std::size_t> of_kind;
    double seconds = 0;
    std::size_t peak_memory = 0; ///< [B]
  };

  std::uint64_t seed_;
  std::size_t cases_ = 0, findings_ = 0;
  std::map<std::string, Row> rows_; ///< by program
};

} // namespace pcl6d::faults
