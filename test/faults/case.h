// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pcl6d::faults {

/** \brief One call of one program. */
struct Case {
  std::string
      name; ///< such as "convert-scans/scan.ply/cut-3": equal seeds, equal names
  std::string program; ///< such as "pcl_slam6d_convert"
  std::vector<std::string> arguments;
  std::vector<std::string> inputs; ///< samples that are copied into its folder
  /** Breaks what lies in the folder; none: the case is whole. */
  std::function<void(const std::filesystem::path& folder)> prepare;
  bool hopeless = false; ///< the program must say so, by exit code 1, 2 or 3
  bool intact = false;   ///< the program must succeed, by exit code 0 or 3
};

/** \brief What is wrong with how a program met a case. */
struct Finding {
  std::string kind; ///< one of findingKinds()
  std::string what; ///< in words
};

/** \return crash, hang, memory, raw text, leftover, false success, and not whole, of
 * cases that are not broken but fail */
inline const std::vector<std::string>&
findingKinds()
{
  static const std::vector<std::string> kinds = {
      "crash", "hang", "memory", "raw text", "leftover", "false success", "not whole"};
  return kinds;
}

} // namespace pcl6d::faults
