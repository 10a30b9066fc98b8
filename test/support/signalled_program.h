// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/folders.h"
#include "support/run_program.h"
#include "support/temp_folder.h"

#include <boost/process.hpp>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

namespace pcl6d::test {

/** \brief Runs a program of the suite, and sends it a signal when it says some words, or never
 * if it ends before. \param[in] err file for its standard error \return its exit code */
inline int
signalledAt(const std::string& words,
            int signal,
            const std::string& name,
            const std::vector<std::string>& arguments,
            const std::string& err)
{
  namespace bp = boost::process;
  bp::child program(PCL6D_BIN_DIR "/" + name,
                    bp::args = arguments,
                    bp::std_out > bp::null,
                    bp::std_err > err);
  while (program.running() && readText(err).find(words) == std::string::npos)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  if (program.running())
    ::kill(program.id(), signal);
  program.wait();
  return program.exit_code();
}

} // namespace pcl6d::test
