// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output/folder_lock.h"

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Output folder of a program, and the names of its temporary files. */
struct OutputPlace {
  std::filesystem::path folder; ///< without links on the way
  std::string shown;            ///< as given by the user
  std::regex files;             ///< relative paths of the files of a run
  std::string journal;          ///< a file that outlives failed runs; may be empty

  /** \return whether a file, given relative to the folder, belongs to a run */
  bool
  isOfRun(const std::filesystem::path& file) const
  {
    return std::regex_match(file.string(), files);
  }
};

/** \brief Makes the hidden folder for new files: beside the folder where both names can
 * be exchanged, else within the folder, for example at a mount point or below a
 * read-only parent. \throws IoFailed neither folder can be written */
std::filesystem::path
makeStaging(const OutputPlace& place);

/** \return whether a file or folder is hidden machinery of publishing */
bool
isHidden(const std::filesystem::path& name);

/** \brief Replaces the files of the earlier run by the new files, as a whole or not at
 * all.
 *
 * Staging beside the folder: foreign files are hard-linked into the new folder, the new
 * folder is synced to disk, and both folders exchange their names in one step. File
 * systems without an exchange rename one folder after another; finishLate() completes
 * the renaming after a power cut. Staging within the folder: a record lists the moves,
 * then the files are moved one by one; finishLate() continues from the record. A killed
 * program leaves the old files, the new files, or a state that finishLate() completes
 * to the new files.
 * \param[in] replaces whether further files of a run, without a new version, are
 * removed
 * \param[in] keeps_journal whether the journal stays
 * \throws IoFailed a path is taken by another kind of file; the folder is unchanged */
void
publishFiles(const OutputPlace& place,
             const std::filesystem::path& staging,
             bool replaces,
             bool keeps_journal);

/** \return whether files were being moved within the folder when a program was killed */
bool
isHalfMoved(const OutputPlace& place);

/** \brief Completes the renaming of a killed program, before the folder is examined: a
 * folder without its name gets the name back. */
void
giveNameBack(const OutputPlace& place);

/** \brief Completes the moves of a killed program within the folder, and removes the
 * hidden folders of killed programs. The folder must be locked, so that no other
 * process writes to it. */
void
finishLate(const OutputPlace& place);

} // namespace pcl6d::app
