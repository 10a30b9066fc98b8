// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"

#include <pcl6d/common/error.h>

#include <pcl/console/print.h>

#include <boost/program_options/errors.hpp>

#include <iostream>

namespace pcl6d::app {

namespace {
int
report(const std::string& name, const std::string& message, ExitCode code)
{
  std::cerr << name << ": error: " << message
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
checkOptions(const std::function<void()>& check)
try {
  check();
} catch (const BadArgument& e) {
  throw UsageError(e.what());
}

} // namespace pcl6d::app
