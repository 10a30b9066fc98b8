// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::slam6d {

/** \return words with bars between: "point|plane|gicp" */
inline std::string
withBars(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : "|") + word;
  return text;
}

} // namespace pcl6d::slam6d
