// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "evaluate/result_file.h"

#include <pcl6d/io/atomic_file.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>

namespace pcl6d::app {

bool
hasExtension(const std::string& file, const std::string& extension)
{
  return boost::algorithm::iends_with(file, extension);
}

void
requireResultFile(const std::string& option,
                  const std::string& file,
                  const std::vector<std::string>& extensions)
{
  const bool known =
      std::any_of(extensions.begin(), extensions.end(), [&](const std::string& one) {
        return hasExtension(file, one);
      });
  if (file.empty())
    return;
  if (!known)
    throw UsageError(option + " = " + file + ", but must end with " +
                     boost::algorithm::join(extensions, " or "));
  requireWritable(file);
}

} // namespace pcl6d::app
