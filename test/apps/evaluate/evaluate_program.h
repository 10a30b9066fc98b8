// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/support/program_names.h"
#include "support/run_program.h"

#include <string>
#include <vector>

namespace pcl6d::test {

/** \brief Expects the exit code, and an error of pcl_slam6d_evaluate that holds the words. */
inline void
expectError(const Outcome& outcome, int code, const std::vector<std::string>& words)
{
  expectError(outcome, kEvaluate, code, words);
}

} // namespace pcl6d::test
