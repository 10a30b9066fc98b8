// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output/folder_lock.h"
#include "common/output/publication.h"

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Rights of a program over its output folder. */
struct OutputRules {
  std::filesystem::path folder;
  std::vector<std::filesystem::path>
      inputs;          ///< files and folders; may hold empty paths
  std::string program; ///< name of the program, stored in the marker as "generator"
  /** JSON file written by every run of the program; empty: no marker, and every folder
   * with files counts as foreign */
  std::string marker;
  std::regex files;   ///< relative paths of the files of a run
  bool force = false; ///< accept a folder with foreign files
  /** name of a file in the folder that outlives a failed run; may be empty. A folder
   * with this file, and at most files of a run besides, is not foreign */
  std::string journal = {};
};

/** \brief Fate of the journal of a run when its files are published. */
enum class Journal { kKeep, kDrop };

/** \brief Output folder of a program, written as a whole or not at all.
 *
 * Files are written to a hidden folder beside the output folder, readable only by this
 * user; publish() moves them to their final paths together. It removes only files of an
 * earlier run of the program. A folder with foreign files is rejected without `force`;
 * with `force`, only files of equal name are replaced. Inputs are never touched.
 * Without publish(), the folder stays unchanged but for the journal. If the process is
 * killed in publish(), either every file is old or every file is new (publication.h).
 * The folder is locked until destruction. */
class OutputFolder {
public:
  /** \throws IoFailed the path leads through a file, is or contains an input, contains
   * foreign files or a link instead of a folder of ours, is in use by another run, or
   * cannot be made */
  explicit OutputFolder(OutputRules rules);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder&
  operator=(const OutputFolder&) = delete;

  /** \return path for writing a file, such as "scans/scan000.pcd"; its parent folder is
   * made
   * \throws IoFailed another process has removed the hidden folder */
  std::filesystem::path
  operator/(const std::string& name) const;

  /** \return where the journal is, or is to be */
  std::filesystem::path
  journal() const
  {
    return folder_ / rules_.journal;
  }

  /** \brief Removes the files written below a name. */
  void
  discard(const std::string& name) const;

  /** \return the hidden folder, for writers of many files */
  const std::filesystem::path&
  staging() const
  {
    return staging_;
  }

  /** \return the output folder; files written there after publish() are not part of the run */
  const std::filesystem::path&
  folder() const
  {
    return folder_;
  }

  /** \brief Moves the files to their final paths. \return full paths of the written
   * names at the top of the folder, sorted
   * \throws IoFailed a path is taken by another kind of file, or the hidden folder was
   * removed; the folder is unchanged */
  std::vector<std::filesystem::path>
  publish(Journal journal = Journal::kDrop);

  /** \brief As publish(), but into a second folder beside this folder, which stays
   * unchanged.
   * \param[in] suffix of the name of the second folder \throws IoFailed as the
   * constructor, for the second folder */
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
  std::filesystem::path folder_; ///< as given by the user
  OutputPlace place_;            ///< the same without links
  std::filesystem::path made_;   ///< topmost folder made by this object; empty if none
  FolderLock lock_;
  std::filesystem::path staging_;
  FolderLock
      /** lock of the hidden folder, or of the output folder once their names are exchanged */
      staging_lock_;
  bool holds_earlier_run_ = false;
};

} // namespace pcl6d::app
