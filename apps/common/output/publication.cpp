// SPDX-License-Identifier: BSD-3-Clause
#include "common/output/publication.h"
#include "common/output/staged_files.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <cerrno>
#include <ostream>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace pcl6d::app {

namespace {
using Files = std::vector<fs::path>;

constexpr const char* kInner = ".pcl6d-new-";           ///< staging within the folder
constexpr const char* kRecord = ".pcl6d-publishing";    ///< list of files to move
constexpr const char* kFormerInner = ".pcl6d-writing-"; ///< that of former builds

/** \return the start of the names of hidden folders beside the folder */
std::string
besidePrefix(const OutputPlace& place, const char* kind)
{
  return "." + place.folder.filename().string() + ".pcl6d-" + kind;
}

fs::path
readyPath(const OutputPlace& place)
{
  return place.folder.parent_path() / besidePrefix(place, "ready");
}

bool
isInner(const OutputPlace& place, const fs::path& staging)
{
  return staging.parent_path() == place.folder;
}

bool
contains(const Files& sorted, const fs::path& file)
{
  return std::binary_search(sorted.begin(), sorted.end(), file);
}

/** A folder of another user is left alone: an attacker may have made it. */
bool
isOwnFolder(const fs::path& path)
{
  struct stat found {};
  return ::lstat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode) &&
         found.st_uid == ::geteuid();
}

/** \return whether the folder can be renamed: no mount point, and not the working
 * directory of this program or of its shell */
bool
canBeExchanged(const fs::path& folder)
{
  struct stat own {
  }, above{};
  if (::stat(folder.c_str(), &own) != 0 ||
      ::stat(folder.parent_path().c_str(), &above) != 0 || own.st_dev != above.st_dev)
    return false;
  std::error_code error;
  for (fs::path here = fs::current_path(error); !error && here.has_relative_path();
       here = here.parent_path())
    if (isSameFile(here, folder))
      return false;
  return true;
}

void
removeFile(const fs::path& path)
{
  if (::unlink(path.c_str()) == 0 || errno != EACCES)
    return;
  ::chmod(path.parent_path().c_str(),
          0700); // a folder of a run may be read-only
  ::unlink(path.c_str());
}

/** Removes a replaced run. Files added to its folder meanwhile move to the new folder. */
void
removeReplaced(const OutputPlace& place, const fs::path& old)
{
  for (const auto& file : filesBelow(old))
    if (isSameFile(old / file, place.folder / file) || place.isOfRun(file) ||
        file == place.journal)
      removeFile(old / file);
    else if (linkFiles({file}, old, place.folder) &&
             isSameFile(old / file, place.folder / file))
      removeFile(old / file);
  removeEmptyFolders(old);
}

/** \brief Moves still to do within the folder; recorded in a file, as the program may
 * be killed. */
struct Move {
  fs::path staging;
  Files files; ///< every new file, also the moved ones
  bool replaces = false;
  bool keeps_journal = false;
};

void
writeRecord(const OutputPlace& place, const Move& move)
{
  writeFileAtomically(place.folder / kRecord, [&](std::ostream& stream) {
    stream << move.staging.filename().string() << '\0' << move.replaces << '\0'
           << move.keeps_journal << '\0';
    for (const auto& file : move.files)
      stream << file.string() << '\0';
  });
  syncToDisk(place.folder);
}

/** \return the moves still to do; an empty staging path: none, or the record is unreadable */
Move
readRecord(const OutputPlace& place)
{
  Move move;
  const std::string content = text::readFile(place.folder / kRecord);
  std::vector<std::string> words;
  for (std::size_t begin = 0, end = 0;
       (end = content.find('\0', begin)) != std::string::npos;
       begin = end + 1)
    words.push_back(content.substr(begin, end - begin));
  if (words.size() < 3 || words[0].rfind(kInner, 0) != 0 ||
      words[0].find('/') != std::string::npos || !isOwnFolder(place.folder / words[0]))
    return move;
  move.staging = place.folder / words[0];
  move.replaces = words[1] == "1";
  move.keeps_journal = words[2] == "1";
  for (std::size_t i = 3; i < words.size(); ++i)
    if (place.isOfRun(words[i])) // so the path stays inside the folder
      move.files.emplace_back(words[i]);
  return move;
}

/** Continues an interrupted move. */
void
moveWithin(const OutputPlace& place, const Move& move)
{
  for (const auto& file : move.files) {
    struct stat found {};
    if (::lstat((move.staging / file).c_str(), &found) != 0)
      continue; // moved before
    fs::create_directories((place.folder / file).parent_path());
    renameSafely(move.staging / file, place.folder / file);
  }
  if (move.replaces)
    for (const auto& file : filesBelow(place.folder))
      if (place.isOfRun(file) && !contains(move.files, file)) {
        removeFile(place.folder / file);
        if (file.has_parent_path())
          ::rmdir((place.folder / file.parent_path()).c_str()); // if nothing is left
      }
  if (!move.keeps_journal && !place.journal.empty())
    removeFile(place.folder / place.journal);
  removeFile(place.folder / kRecord);
  syncToDisk(place.folder);
  std::error_code ignored;
  fs::remove_all(move.staging, ignored);
}

void
publishWithin(const OutputPlace& place, Move move)
{
  for (const auto& file : move.files) { // while nothing has changed
    const fs::path folder = (place.folder / file).parent_path();
    struct stat found {};
    if (::stat(folder.c_str(), &found) == 0 && ::access(folder.c_str(), W_OK) != 0)
      text::fail(folder, text::systemReason("cannot be written"));
  }
  writeRecord(place, move);
  moveWithin(place, move);
}

/** \return false: publishing must happen within the folder; the folder is unchanged */
bool
publishBeside(const OutputPlace& place, const fs::path& staging, const Files& foreign)
{
  if (!linkFiles(foreign, place.folder, staging))
    return false;
  takeRightsOf(place.folder, staging);
  syncTree(staging);
  // From here on the hidden folder has its future name: `old`.
  fs::path old = staging;
  const std::string name = staging.filename().string();
  old.replace_filename(besidePrefix(place, "old-") + name.substr(name.size() - 6));
  Renaming names;
  names.change(staging, old);
  const Exchange done = exchangeNames(old, place.folder);
  if (done == Exchange::kRefused)
    return false;
  if (done == Exchange::kUnknown) { // giveNameBack() restores the name after a crash
    names.change(old, readyPath(place));
    names.change(place.folder, old);
    names.change(readyPath(place), place.folder);
  }
  names.keep();
  try {
    syncToDisk(place.folder.parent_path());
  } catch (const IoFailed&) { // in place, but may not outlive a power cut
    removeReplaced(place, old);
    throw;
  }
  removeReplaced(place, old);
  return true;
}

/** \return foreign files of the folder, which stay beside the new files */
Files
foreignFiles(const OutputPlace& place,
             const Files& files,
             bool replaces,
             bool keeps_journal)
{
  Files foreign;
  for (const auto& file : filesBelow(place.folder))
    if (!contains(files, file) && !(replaces && place.isOfRun(file)) &&
        !(file == place.journal && !keeps_journal) && !isHidden(*file.begin()))
      foreign.push_back(file);
  return foreign;
}
} // namespace

bool
isHidden(const fs::path& name)
{
  const std::string text = name.string();
  return text.rfind(kInner, 0) == 0 || text.rfind(kFormerInner, 0) == 0 ||
         text == kRecord;
}

fs::path
makeStaging(const OutputPlace& place)
{
  fs::path staging;
  if (canBeExchanged(place.folder))
    staging =
        makePrivateFolder(place.folder.parent_path(), besidePrefix(place, "new-"));
  if (staging.empty())
    staging = makePrivateFolder(place.folder, kInner);
  if (staging.empty())
    throw IoFailed(place.shown + ": cannot write into the output folder: " +
                   text::systemReason("not allowed"));
  return staging;
}

void
publishFiles(const OutputPlace& place,
             const fs::path& staging,
             bool replaces,
             bool keeps_journal)
{
  const Files files = filesBelow(staging);
  for (const auto& file : files)
    if (fs::is_directory(place.folder / file))
      text::fail(place.folder / file,
                 "is a folder, but must be a file or free for a new file");
  const Files foreign = foreignFiles(place, files, replaces, keeps_journal);
  if (!isInner(place, staging) && publishBeside(place, staging, foreign))
    return;
  Move move{staging, files, replaces, keeps_journal};
  if (!isInner(place, staging)) {
    for (const auto& file : foreign)
      if (isSameFile(staging / file, place.folder / file))
        removeFile(staging / file);
    move.staging = makePrivateFolder(place.folder, kInner);
    if (move.staging.empty())
      text::fail(place.folder, text::systemReason("cannot be written"));
    renameSafely(staging, move.staging);
  }
  syncTree(move.staging);
  publishWithin(place, move);
}

bool
isHalfMoved(const OutputPlace& place)
{
  std::error_code ignored;
  return fs::is_regular_file(fs::symlink_status(place.folder / kRecord, ignored)) &&
         !readRecord(place).staging.empty();
}

void
giveNameBack(const OutputPlace& place)
{
  struct stat found {};
  const fs::path ready = readyPath(place);
  if (::lstat(place.folder.c_str(), &found) == 0 || !isOwnFolder(ready))
    return;
  if (!FolderLock(ready).isHeld())
    throw IoFailed(place.shown + ": another run is writing into this folder");
  renameSafely(ready, place.folder);
}

namespace {
/** \return whether a hidden folder belongs to this user and is not in use */
bool
isLeft(const fs::path& folder)
{
  if (!isOwnFolder(folder))
    return false;
  const FolderLock lock(folder);
  return lock.isHeld() && !lock.isUnknown();
}

std::vector<fs::path>
entriesOf(const fs::path& folder)
{
  std::vector<fs::path> entries;
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; entry != end;
       entry.increment(ignored))
    entries.push_back(entry->path());
  return entries;
}
} // namespace

void
finishLate(const OutputPlace& place)
{
  std::error_code ignored;
  if (isHalfMoved(place))
    moveWithin(place, readRecord(place));
  else // the hidden folder is gone
    fs::remove(place.folder / kRecord, ignored);
  for (const auto& path : entriesOf(place.folder))
    if (isHidden(path.filename()) && isLeft(path))
      fs::remove_all(path, ignored);
  const std::string fresh = besidePrefix(place, "new-"),
                    old = besidePrefix(place, "old-");
  for (const auto& path : entriesOf(place.folder.parent_path())) {
    const std::string name = path.filename().string();
    const bool is_old = name.rfind(old, 0) == 0;
    if ((is_old || name.rfind(fresh, 0) == 0) && name.size() == fresh.size() + 6 &&
        isLeft(path)) {
      if (is_old)
        removeReplaced(place, path);
      else
        fs::remove_all(path, ignored);
    }
  }
  if (isLeft(readyPath(place))) // the folder has its final name
    fs::remove_all(readyPath(place), ignored);
}

} // namespace pcl6d::app
