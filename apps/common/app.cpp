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
} catch (const std::bad_alloc& e) {
  const std::string said = e.what();
  return report(name, said == "std::bad_alloc" ? "not enough memory" : said, kFailed);
} catch (const std::exception& e) {
  return report(name, e.what(), kFailed);
}

namespace {
/** \brief Calls check and turns its BadArgument into a UsageError about the option that
 * stands for the name that the library gives. */
void
checkRenamed(const std::function<void()>& check,
             const std::function<std::string(const std::string&)>& optionOf)
try {
  check();
} catch (const BadArgument& e) {
  const std::string message = e.what();
  static const std::regex kRule("([a-z_ ]+)( = .*)");
  std::smatch match;
  if (!std::regex_match(message, match, kRule))
    throw UsageError(message);
  throw UsageError("--" + optionOf(match[1]) + match[2].str());
}
} // namespace

void
checkOptions(const std::function<void()>& check,
             const std::map<std::string, std::string>& words)
{
  checkRenamed(check, [&](const std::string& field) {
    const auto word = words.find(field);
    std::string option = word == words.end() ? field : word->second;
    std::replace(option.begin(), option.end(), '_', '-');
    return option;
  });
}

void
checkOption(const std::string& option, const std::function<void()>& check)
{
  checkRenamed(check, [&](const std::string&) { return option; });
}

void
flushOutput()
{
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    throw IoFailed("cannot write to the standard output");
}

} // namespace pcl6d::app
