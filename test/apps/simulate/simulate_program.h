// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/support/program_names.h"
#include "support/run_program.h"

#include <string>
#include <vector>

namespace pcl6d::test {

inline Outcome
simulate(const std::vector<std::string>& arguments)
{
  return runProgram(kSimulate, arguments);
}

} // namespace pcl6d::test
