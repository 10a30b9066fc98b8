// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

/** \file Building blocks for replacing a folder of old files by a folder of new files. */
namespace pcl6d::app {

/** \return the files below a folder, as sorted relative paths; links and every entry
 * but folders count as files */
std::vector<std::filesystem::path>
filesBelow(const std::filesystem::path& folder);

/** \brief Waits until a file, or the list of files of a folder, is on the disk. File
 * systems without sync support are ignored. \throws IoFailed writing failed */
void
syncToDisk(const std::filesystem::path& path);

/** \brief Calls syncToDisk() for the files below a folder, and for the folders. */
void
syncTree(const std::filesystem::path& folder);

/** \brief Gives files of one folder a second name in another, where the name is free. Their
 * folders, and the empty folders, are made with equal rights.
 * \param[in] files relative to both
 * \return false: the file system has no hard links, or the folders are on two file systems */
bool
linkFiles(const std::vector<std::filesystem::path>& files,
          const std::filesystem::path& from,
          const std::filesystem::path& to);

/** \return whether both names lead to one file */
bool
isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

/** \brief Makes a new, empty folder, accessible only to this user.
 * \return its path, or an empty path; errno has the reason */
std::filesystem::path
makePrivateFolder(const std::filesystem::path& parent, const std::string& prefix);

/** \brief Copies the permissions of a folder from another folder. */
void
takeRightsOf(const std::filesystem::path& model, const std::filesystem::path& folder);

/** \brief Removes folders without files, from the lowest up to the top, itself too. */
void
removeEmptyFolders(const std::filesystem::path& folder);

/** \brief Renames a file, and waits until the change is on the disk.
 * \throws IoFailed renaming failed, or the change may not outlive a power cut */
void
renameSafely(const std::filesystem::path& from, const std::filesystem::path& to);

/** \brief Group of renamings: without keep(), the destructor restores the old names. */
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

/** \brief Result of exchanging the names of two folders of one file system. */
enum class Exchange {
  kDone,
  kUnknown, ///< the file system has no exchange in one step
  kRefused  ///< not possible; see errno
};

/** \brief Exchanges the names of two folders in one step; both names exist at every moment. */
Exchange
exchangeNames(const std::filesystem::path& a, const std::filesystem::path& b);

} // namespace pcl6d::app
