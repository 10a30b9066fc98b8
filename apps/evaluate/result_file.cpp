// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "evaluate/result_file.h"

#include <boost/algorithm/string.hpp>

#include <algorithm>

namespace pcl6d::app {

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

} // namespace pcl6d::app
