// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"

#include <pcl6d/common/error.h>

#include <pcl/console/print.h>

#include <boost/program_options/errors.hpp>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <regex>

namespace pcl6d::app {

namespace {
int
report(const std::string& name, const std::string& message, ExitCode code)
{
  std::string line; // a file's name may hold a line break
  for (const char c : message)
    line += c == '\n' ? std::string("\\n") : std::string(1, c);
  std::cerr << name << ": error: " << line
            << (code == kUsage ? " (see --help)\n" : "\n");
  return code;
}
} // namespace

int
runMain(const std::string& name,
        int argc,
        char** argv,
        const std::function<int(const std::vector<std::string>&)>& body)
try {
  std::signal(SIGPIPE, SIG_IGN); // `... | head` must not leave half a run
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  return body(std::vector<std::string>(argv + 1, argv + argc));
} catch (const UsageError& e) {
  return report(name, e.what(), kUsage);
} catch (const boost::program_options::error& e) {
  return report(name, e.what(), kUsage);
} catch (const std::bad_alloc&) {
  return report(name, "not enough memory", kFailed);
} catch (const std::exception& e) {
  return report(name, e.what(), kFailed);
}

void
checkOptions(const std::function<void()>& check,
             const std::map<std::string, std::string>& words)
try {
  check();
} catch (const BadArgument& e) {
  const std::string message = e.what();
  static const std::regex kRule("([a-z_ ]+)( = .*)");
  std::smatch match;
  if (!std::regex_match(message, match, kRule))
    throw UsageError(message);
  std::string option = match[1];
  const auto word = words.find(option);
  if (word != words.end())
    option = word->second;
  std::replace(option.begin(), option.end(), '_', '-');
  throw UsageError("--" + option + match[2].str());
}

void
flushOutput()
{
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    throw IoFailed("cannot write to the standard output");
}

} // namespace pcl6d::app
