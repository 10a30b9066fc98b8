// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/run_program.h"

namespace pcl6d::test {

/** \brief What a program of the build writes to `-o FOLDER`, made once for all tests: CTest
 * runs each test in a process of its own, so that a static folder is made by each of them.
 *
 * It lies in test/runs of the build until the program or a library is built anew. One process
 * makes it, the others wait; it gets its name when it is whole.
 * \return the folder, only to be read */
std::filesystem::path
sharedOutput(const std::string& program, std::vector<std::string> arguments);

} // namespace pcl6d::test
