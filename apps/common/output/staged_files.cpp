// SPDX-License-Identifier: BSD-3-Clause
#include "common/output/staged_files.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace pcl6d::app {

namespace {
/** Opens existing files only, without blocking. */
constexpr int kQuietly = O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
} // namespace

std::vector<fs::path>
filesBelow(const fs::path& folder)
{
  std::vector<fs::path> files;
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error))
    if (!entry->is_directory(error) || entry->is_symlink(error))
      files.push_back(entry->path().lexically_relative(folder));
  if (error)
    text::fail(folder, error.message());
  std::sort(files.begin(), files.end());
  return files;
}

void
syncToDisk(const fs::path& path)
{
  errno = 0;
  const int file = ::open(path.c_str(), kQuietly);
  if (file < 0) {
    if (errno == ELOOP || errno == EACCES || errno == ENXIO)
      return; // a link, or a file of another user: not written by us
    text::fail(path, text::systemReason("cannot be opened"));
  }
  const bool failed = ::fsync(file) != 0 && errno != EINVAL && errno != ENOTSUP;
  const int reason = errno;
  ::close(file);
  errno = reason;
  if (failed)
    text::fail(path, text::systemReason("cannot be written"));
}

void
syncTree(const fs::path& folder)
{
  const auto files = filesBelow(folder);
  // starts writing for every file, before waiting for the first
  for (const auto& file : files) {
    const int handle = ::open((folder / file).c_str(), kQuietly);
    if (handle >= 0) {
      ::sync_file_range(handle, 0, 0, SYNC_FILE_RANGE_WRITE);
      ::close(handle);
    }
  }
  for (const auto& file : files)
    syncToDisk(folder / file);
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_directory() && !entry.is_symlink())
      syncToDisk(entry.path());
  syncToDisk(folder);
}

namespace {
/** Makes the folders that contain a file. \return the new folders; an empty list on failure */
bool
makeFolders(const fs::path& parts, const fs::path& to, std::vector<fs::path>& made)
{
  fs::path folder;
  for (const auto& part : parts) {
    folder /= part;
    if (::mkdir((to / folder).c_str(), 0700) == 0)
      made.push_back(folder);
    else if (errno != EEXIST)
      return false;
  }
  return true;
}

/** \return the empty folders below a folder */
std::vector<fs::path>
emptyFoldersBelow(const fs::path& folder)
{
  std::vector<fs::path> empty;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_directory() && !entry.is_symlink() && fs::is_empty(entry, ignored))
      empty.push_back(entry.path().lexically_relative(folder));
  return empty;
}
} // namespace

bool
linkFiles(const std::vector<fs::path>& files, const fs::path& from, const fs::path& to)
{
  std::vector<fs::path> made;
  for (const auto& file : files)
    if (!makeFolders(file.parent_path(), to, made) ||
        (::linkat(AT_FDCWD, (from / file).c_str(), AT_FDCWD, (to / file).c_str(), 0) !=
             0 &&
         errno != EEXIST))
      return false;
  for (const auto& folder : emptyFoldersBelow(from))
    if (!makeFolders(folder, to, made))
      return false;
  for (auto folder = made.rbegin(); folder != made.rend(); ++folder)
    takeRightsOf(from / *folder, to / *folder); // last: the rights may forbid writing
  return true;
}

bool
isSameFile(const fs::path& a, const fs::path& b)
{
  struct stat first {
  }, second{};
  return ::lstat(a.c_str(), &first) == 0 && ::lstat(b.c_str(), &second) == 0 &&
         first.st_dev == second.st_dev && first.st_ino == second.st_ino;
}

fs::path
makePrivateFolder(const fs::path& parent, const std::string& prefix)
{
  std::string name = parent / (prefix + "XXXXXX");
  return ::mkdtemp(name.data()) ? fs::path(name) : fs::path();
}

void
takeRightsOf(const fs::path& model, const fs::path& folder)
{
  struct stat rights {};
  if (::lstat(model.c_str(), &rights) != 0)
    return;
  // Changing the group may be forbidden; the folder then keeps our group.
  [[maybe_unused]] const int ignored =
      ::lchown(folder.c_str(), static_cast<uid_t>(-1), rights.st_gid);
  if (::chmod(folder.c_str(), rights.st_mode & 07777) != 0)
    text::fail(folder, text::systemReason("cannot be opened for others"));
}

void
removeEmptyFolders(const fs::path& folder)
{
  std::vector<fs::path> folders{folder};
  std::error_code ignored;
  for (fs::recursive_directory_iterator entry(folder, ignored), end; entry != end;
       entry.increment(ignored))
    if (entry->is_directory(ignored) && !entry->is_symlink(ignored))
      folders.push_back(entry->path());
  std::sort(folders.rbegin(), folders.rend()); // inner folders before outer folders
  for (const auto& one : folders)
    ::rmdir(one.c_str());
}

void
renameSafely(const fs::path& from, const fs::path& to)
{
  errno = 0;
  if (::rename(from.c_str(), to.c_str()) != 0)
    text::fail(to, text::systemReason("cannot be written"));
  syncToDisk(to.parent_path());
}

Renaming::~Renaming()
{
  for (auto change = done_.rbegin(); change != done_.rend(); ++change)
    ::rename(change->second.c_str(), change->first.c_str());
}

void
Renaming::change(const fs::path& from, const fs::path& to)
{
  done_.emplace_back(from, to); // first: may allocate
  try {
    renameSafely(from, to);
  } catch (...) {
    struct stat found {};
    if (::lstat(from.c_str(), &found) == 0) // nothing has changed
      done_.pop_back();
    throw;
  }
}

Exchange
exchangeNames(const fs::path& a, const fs::path& b)
{
  if (::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0)
    return Exchange::kDone;
  return errno == ENOSYS || errno == EINVAL || errno == ENOTSUP ? Exchange::kUnknown
                                                                : Exchange::kRefused;
}

} // namespace pcl6d::app
