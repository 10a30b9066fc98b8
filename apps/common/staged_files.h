// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

/** \file What putting a folder of new files in the place of old ones is made of. */
namespace pcl6d::app {

/** \return the files below a folder, relative to it, sorted; what is no folder is a file,
 * links too */
std::vector<std::filesystem::path>
filesBelow(const std::filesystem::path& folder);

/** \brief Waits until a file, or the list of files of a folder, is on the disk. File systems
 * that know no such thing are taken as they are. \throws IoFailed it cannot be written */
void
syncToDisk(const std::filesystem::path& path);

/** \brief The same of all files below a folder, and of the folders. */
void
syncTree(const std::filesystem::path& folder);

/** \brief Gives files of one folder a second name in another, where nothing has that name.
 * Their folders, and those that are empty, are made with the same rights.
 * \param[in] files relative to both
 * \return false: the file system cannot do that, or the folders are not on one */
bool
linkFiles(const std::vector<std::filesystem::path>& files,
          const std::filesystem::path& from,
          const std::filesystem::path& to);

/** \return whether both names are of one file */
bool
isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

/** \brief Makes a new, empty folder that only this user can open.
 * \return its path, or an empty one; errno says why */
std::filesystem::path
makePrivateFolder(const std::filesystem::path& parent, const std::string& prefix);

/** \brief Lets a folder be opened, and changed, as another one. */
void
takeRightsOf(const std::filesystem::path& model, const std::filesystem::path& folder);

/** \brief Removes folders without files, from the lowest up to the top, itself too. */
void
removeEmptyFolders(const std::filesystem::path& folder);

/** \brief Changes a name, and waits until that is on the disk.
 * \throws IoFailed it cannot be changed, or may not outlive a power cut */
void
renameSafely(const std::filesystem::path& from, const std::filesystem::path& to);

/** \brief Names that change together: without keep() all are as they were at the end of its
 * scope. */
class Renaming {
public:
  Renaming() = default;
  ~Renaming();
  Renaming(const Renaming&) = delete;
  Renaming&
  operator=(const Renaming&) = delete;

  /** \brief As renameSafely(). */
  void
  change(const std::filesystem::path& from, const std::filesystem::path& to);

  void
  keep()
  {
    done_.clear();
  }

private:
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> done_;
};

/** \brief How two folders of one file system changed their names. */
enum class Exchange {
  kDone,
  kUnknown, ///< the file system cannot do it in one step
  kRefused  ///< it said no: errno
};

/** \brief Exchanges the names of two folders in one step: at no moment is there neither. */
Exchange
exchangeNames(const std::filesystem::path& a, const std::filesystem::path& b);

} // namespace pcl6d::app
