// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Exit codes of every program. */
enum ExitCode {
  kDone = 0,
  kFailed = 1,   ///< bad data, or a file could not be read or written
  kUsage = 2,    ///< command line or config wrong
  kDoubtful = 3, ///< finished, but part of the result is unreliable
  kInterrupted = 130
};

/** \brief The command line or the config file is wrong. */
class UsageError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief Runs a program: silences PCL's chatter, calls body with the arguments after
 * the program's name, and turns every exception into `name: error: ...`, one
 * printable() line, and an exit code. Errors of the command line (UsageError, boost's)
 * give kUsage; any other error, and failed standard output, give kFailed. Without arguments
 * firstSteps() is printed, and the exit code is kUsage. An uninstalled locale is replaced
 * by "C", for the process and its children. */
int
runMain(const std::string& name,
        int argc,
        char** argv,
        const std::function<int(const std::vector<std::string>&)>& body);

/** \return the message of the exception being handled, for callers that continue
 * without the failed part */
std::string
wordsOfCurrent();

/** \brief Calls check and turns its BadArgument into a UsageError: for options
 * validated by the library. "max_range = -1, but ..." becomes "--max-range = -1, but
 * ...".
 * \param[in] words options whose names differ from the library's fields */
void
checkOptions(const std::function<void()>& check,
             const std::map<std::string, std::string>& words = {});

/** \brief As checkOptions() for a single option, whatever the name of the library's field. */
void
checkOption(const std::string& option, const std::function<void()>& check);

/** \brief Flushes standard output and checks that the text was written; runMain() calls
 * this at its end.
 * \throws IoFailed the text was not written */
void
flushOutput();

} // namespace pcl6d::app
