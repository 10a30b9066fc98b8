// SPDX-License-Identifier: BSD-3-Clause
#include "accepted.h"
#include "text_table.h"

#include <algorithm>
#include <stdexcept>

namespace pcl6d::faults {

std::vector<Acceptance>
readAcceptances(const std::filesystem::path& file)
{
  std::vector<Acceptance> acceptances;
  const auto& kinds = findingKinds();
  for (const std::vector<std::string>& row : rowsOf(file, 4)) {
    if (row[3].empty() || std::find(kinds.begin(), kinds.end(), row[0]) == kinds.end())
      throw std::runtime_error(file.string() + ": no kind or no reason: " + row[0] +
                               " | " + row[1]);
    acceptances.push_back({row[0], std::regex(row[1]), std::regex(row[2]), row[3]});
  }
  return acceptances;
}

bool
isAccepted(const Case& one,
           const Finding& finding,
           std::vector<Acceptance>& acceptances)
{
  for (Acceptance& acceptance : acceptances)
    if (acceptance.kind == finding.kind &&
        std::regex_search(one.name, acceptance.name) &&
        std::regex_search(finding.what, acceptance.words)) {
      ++acceptance.uses;
      return true;
    }
  return false;
}

} // namespace pcl6d::faults
