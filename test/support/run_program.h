// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/** \file
 * Starts programs; compiled once (run_program.cpp), as Boost.Process costs 6 s of compiling
 * in each file that includes it. */
namespace pcl6d::test {

/** \brief What a program did. */
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/** \brief Runs a program of the build, e.g. "pcl_slam6d", and waits for its end. */
Outcome
runProgram(const std::string& name, const std::vector<std::string>& arguments);

/** \brief Expects the exit code, and that the last line on stderr, the only one that starts
 * with the program's name, is `name: error: ...` and holds the words. */
void
expectError(const Outcome& outcome,
            const std::string& name,
            int exit_code,
            const std::vector<std::string>& words);

/** \return all files below a folder with their bytes */
std::map<std::string, std::string>
contentOf(const std::filesystem::path& folder);

} // namespace pcl6d::test
