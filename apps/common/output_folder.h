// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/folder_lock.h"
#include "common/publication.h"

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief What a program may do to the folder that it writes. */
struct OutputRules {
  std::filesystem::path folder;
  std::vector<std::filesystem::path>
      inputs;          ///< files and folders; may hold empty paths
  std::string program; ///< its name, which its marker holds as "generator"
  /** the JSON file that every run of the program leaves; empty if it leaves none, and
   * then every folder that is not empty is foreign */
  std::string marker;
  std::regex files;   ///< relative paths of all files that a run may leave
  bool force = false; ///< accept a folder that holds other things
  /** name of a file in the folder that outlives a run which fails; empty: none. A folder that
   * holds it, and at most files of a run besides, is no foreign one */
  std::string journal = {};
};

/** \brief What becomes of the journal of a run when its files are published. */
enum class Journal { kKeep, kDrop };

/** \brief The folder that a program writes: whole or not at all.
 *
 * Files are written to a hidden folder beside it, which only this user can open, and put in
 * its place by publish(), together. What an earlier run of the program left is then gone, and
 * nothing else: a folder that holds other things is refused without `force`, and with it only
 * files of the same name are replaced. Inputs are never touched. If publish() is not reached,
 * all is as it was before, but for the journal; if the process is killed in it, it is all as
 * before or all new (publication.h). The folder is locked for as long as this lives. */
class OutputFolder {
public:
  /** \throws IoFailed the path leads through a file, is or holds an input, holds foreign
   * files or a link in place of a folder of ours, is written by another run, or cannot be
   * made */
  explicit OutputFolder(OutputRules rules);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder&
  operator=(const OutputFolder&) = delete;

  /** \return where to write a file, such as "scans/scan000.pcd"; its folder is made
   * \throws IoFailed somebody has removed the hidden folder */
  std::filesystem::path
  operator/(const std::string& name) const;

  /** \return where the journal is, or is to be */
  std::filesystem::path
  journal() const
  {
    return folder_ / rules_.journal;
  }

  /** \brief Takes back what was written below a name. */
  void
  discard(const std::string& name) const;

  /** \return the hidden folder, for those that write many files */
  const std::filesystem::path&
  staging() const
  {
    return staging_;
  }

  /** \return the folder itself: what is written there after publish() is no part of it */
  const std::filesystem::path&
  folder() const
  {
    return folder_;
  }

  /** \brief Puts everything in its place. \return the names at the top of the folder that
   * were written, as full paths, sorted
   * \throws IoFailed something else stands in the place of a file, or the hidden folder was
   * removed: nothing has changed */
  std::vector<std::filesystem::path>
  publish(Journal journal = Journal::kDrop);

  /** \brief The same into a folder beside this one, which stays as it is.
   * \param[in] suffix of its name \throws IoFailed as OutputFolder of that folder */
  std::vector<std::filesystem::path>
  publishBeside(const std::string& suffix);

  /** \return whether an earlier run of the program is in the folder */
  bool
  holdsEarlierRun() const
  {
    return holds_earlier_run_;
  }

private:
  void
  claim();
  void
  removeMade();
  void
  requireStaging() const;

  OutputRules rules_;
  std::filesystem::path folder_; ///< as the user called it
  OutputPlace place_;            ///< the same without links
  std::filesystem::path made_;   ///< topmost folder that was made here; empty if none
  FolderLock lock_;
  std::filesystem::path staging_;
  FolderLock
      staging_lock_; ///< that of the folder when the two have changed their names
  bool holds_earlier_run_ = false;
};

} // namespace pcl6d::app
