// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "evaluate/result_file.h"

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <filesystem>

namespace pcl6d::app {

namespace fs = std::filesystem;

bool
hasExtension(const std::string& file, const std::string& extension)
{
  return boost::algorithm::iends_with(file, extension);
}

void
requireExtension(const std::string& option,
                 const std::string& file,
                 const std::vector<std::string>& extensions)
{
  const bool known =
      std::any_of(extensions.begin(), extensions.end(), [&](const std::string& one) {
        return hasExtension(file, one);
      });
  if (!file.empty() && !known)
    throw UsageError(option + " = " + file + ", but must end with " +
                     boost::algorithm::join(extensions, " or "));
}

void
refuseInput(const std::string& option,
            const std::string& file,
            const std::vector<std::string>& inputs)
{
  std::error_code missing; // a missing file is no input
  for (const auto& input : inputs)
    if (fs::equivalent(file, input, missing))
      throw UsageError(option + " = " + file + ", but that is an input");
}

} // namespace pcl6d::app
