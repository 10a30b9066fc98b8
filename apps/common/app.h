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
  kFailed = 1,   ///< bad data, or a file said no
  kUsage = 2,    ///< command line or config wrong
  kDoubtful = 3, ///< finished, but part of the result is not to be trusted
  kInterrupted = 130
};

/** \brief The command line or the config file is wrong. */
class UsageError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief Runs a program: silences PCL's chatter, calls body with the arguments after
 * the program's name, and turns exceptions of whatever kind into `name: error: ...`, one
 * printable() line, and an exit code. Errors of the command line (UsageError, boost's) give
 * kUsage, all others kFailed; so does standard output that did not arrive. A locale that is
 * not installed becomes that of C, for the process and its children. */
int
runMain(const std::string& name,
        int argc,
        char** argv,
        const std::function<int(const std::vector<std::string>&)>& body);

/** \return the words for the exception that is being handled: where the work goes on
 * without what failed */
std::string
wordsOfCurrent();

/** \brief Calls check and turns its BadArgument into a UsageError: for options that the
 * library validates. "max_range = -1, but ..." becomes "--max-range = -1, but ...".
 * \param[in] words options that are not called like the library's field */
void
checkOptions(const std::function<void()>& check,
             const std::map<std::string, std::string>& words = {});

/** \brief As checkOptions(), of one option, whatever the library calls it. */
void
checkOption(const std::string& option, const std::function<void()>& check);

/** \brief Makes sure that what was printed has arrived; runMain() does in the end.
 * \throws IoFailed it has not */
void
flushOutput();

} // namespace pcl6d::app
