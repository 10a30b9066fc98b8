// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/folder_lock.h"

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief A folder that a program writes, and where its files are before they are in it. */
struct OutputPlace {
  std::filesystem::path folder; ///< without links on the way
  std::string shown;            ///< as the user calls it
  std::regex files;             ///< relative paths of all files that a run may leave
  std::string journal;          ///< a file that outlives runs which fail; may be empty

  /** \return whether a file, relative to the folder, is one of a run */
  bool
  isOfRun(const std::filesystem::path& file) const
  {
    return std::regex_match(file.string(), files);
  }
};

/** \brief Makes the hidden folder for new files: beside the folder, where both can exchange
 * their names; else within it, as where another file system begins with it, or its parent may
 * not be written. \throws IoFailed neither can be written */
std::filesystem::path
makeStaging(const OutputPlace& place);

/** \return whether a file or folder in the folder is one of this machinery */
bool
isHidden(const std::filesystem::path& name);

/** \brief Puts the new files in the place of those of the run before, all or none.
 *
 * Beside the folder: what is not of a run gets a second name among the new files, all of them
 * wait until they are on the disk, and the folders exchange their names in one step. Where the
 * file system has no such step they are renamed one after the other, and finishLate() ends
 * that after a power cut. Within the folder: a record tells what is to be moved, then file
 * after file is; finishLate() goes on with it. In all cases a program that is killed leaves
 * the old files, the new ones, or what finishLate() makes the new ones.
 * \param[in] replaces whether files of a run that are not among the new ones are removed
 * \param[in] keeps_journal whether the journal stays
 * \throws IoFailed something else stands in the place of a file: nothing has changed */
void
publishFiles(const OutputPlace& place,
             const std::filesystem::path& staging,
             bool replaces,
             bool keeps_journal);

/** \return whether files were being moved within the folder when a program was killed */
bool
isHalfMoved(const OutputPlace& place);

/** \brief Ends what a program that was killed began, before the folder is looked at: where it
 * has no name at this moment it gets it back. */
void
giveNameBack(const OutputPlace& place);

/** \brief The same of files that were moved within the folder, and removes the hidden
 * folders of programs that were killed. The folder must be locked: then nobody writes them. */
void
finishLate(const OutputPlace& place);

} // namespace pcl6d::app
