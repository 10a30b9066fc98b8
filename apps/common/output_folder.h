// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The rules for a folder that a program writes.
 *
 * A folder that exists and holds something is refused, unless `marker` (a file that
 * every run of ours leaves) is in it, or `force` is given. Folders that were made here
 * are removed again, with what is in them, if commit() is not reached. */
class OutputFolder {
public:
  /** \param[in] input a folder that must not be the output; may be empty
   * \throws IoFailed the path leads through a file, is or holds the input folder, holds
   * foreign files, or cannot be made */
  OutputFolder(const std::filesystem::path& folder,
               const std::filesystem::path& input,
               const std::string& marker,
               bool force);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder&
  operator=(const OutputFolder&) = delete;

  /** \brief Removes what an earlier run left under these names (files or folders). Does
   * nothing in a folder that holds no earlier run, where they are somebody else's. */
  void
  removeOld(const std::vector<std::string>& names) const;

  /** \brief Everything is written: keep the folder. */
  void
  commit();

  /** \return whether an earlier run of ours is in the folder */
  bool
  holdsEarlierRun() const
  {
    return holds_earlier_run_;
  }

  std::filesystem::path
  operator/(const std::string& name) const;

private:
  std::filesystem::path folder_;
  bool holds_earlier_run_ = false;
  std::filesystem::path made_; ///< topmost folder that was made here; empty if none
};

} // namespace pcl6d::app
