// SPDX-License-Identifier: BSD-3-Clause
#include "common/output/output_folder.h"
#include "common/output/staged_files.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/json_object.h>

#include <algorithm>
#include <utility>

namespace fs = std::filesystem;

namespace pcl6d::app {

namespace {
/** \return whether a file is the marker of a program */
bool
isMarkerOf(const fs::path& file, const std::string& program)
{
  std::error_code error;
  if (!file.has_filename() || !fs::is_regular_file(file, error))
    return false; // the program has no marker, or the folder none
  try {
    std::string generator;
    readJson(file).read("generator", generator);
    return generator == program;
  } catch (const IoFailed&) {
    return false;
  }
}

/** \return whether a folder is empty but for hidden files of publication.h */
bool
isEmpty(const fs::path& folder)
{
  for (const auto& entry : fs::directory_iterator(folder))
    if (!isHidden(entry.path().filename()))
      return false;
  return true;
}

/** \return whether the folder contains only an interrupted run: its journal and, if the
 * run was killed while publishing, some of its files */
bool
holdsInterruptedRun(const fs::path& folder, const OutputRules& rules)
{
  if (rules.journal.empty() || !fs::exists(folder / rules.journal))
    return false;
  const auto files = filesBelow(folder);
  return std::all_of(files.begin(), files.end(), [&](const fs::path& file) {
    return file == rules.journal || std::regex_match(file.string(), rules.files) ||
           isHidden(*file.begin());
  });
}

void
refuseForeignFolder(const fs::path& folder, const OutputRules& rules)
{
  if (rules.force || isEmpty(folder) || holdsInterruptedRun(folder, rules) ||
      isMarkerOf(folder / rules.marker, rules.program))
    return;
  if (rules.marker.empty())
    throw IoFailed(rules.folder.string() + ": folder is not empty; use a new folder");
  throw IoFailed(rules.folder.string() +
                 ": folder is not empty and holds no earlier run of " + rules.program +
                 " (no " + rules.marker + " of it); use another folder or --force");
}

/** Files of an earlier run are replaced, so no input may be or lie in the folder. */
void
refuseInput(const fs::path& folder, const fs::path& input, const std::string& name)
{
  std::error_code error;
  if (input.empty() || !fs::exists(folder, error) || !fs::exists(input, error))
    return;
  if (fs::equivalent(folder, input, error))
    throw IoFailed(name + ": output folder is the input folder");
  fs::path above = fs::canonical(input, error).parent_path();
  for (; above.has_relative_path(); above = above.parent_path())
    if (fs::equivalent(folder, above, error))
      throw IoFailed(name + ": the input " + input.string() +
                     " lies inside the output folder");
}

/** A link in the folder may lead to an input, whose files would be replaced. */
void
refuseLinkedFolders(const fs::path& folder, const std::string& name)
{
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_symlink() && entry.is_directory())
      throw IoFailed(name + ": holds a link to a folder, " +
                     entry.path().filename().string() + "; use another output folder");
}

/** \return the topmost part of the path that does not exist yet; empty: the whole path
 * exists */
fs::path
topmostMissing(const fs::path& folder)
{
  fs::path missing;
  for (fs::path p = folder; !p.empty() && !fs::exists(p); p = p.parent_path())
    missing = p;
  return missing;
}

/** Removes a folder even if fs::remove_all(), which needs a descriptor per level, has
 * run out of descriptors. Links are not followed. */
void
removeFolder(const fs::path& folder)
{
  std::error_code error, ignored;
  fs::remove_all(folder, error);
  if (!error)
    return;
  std::vector<fs::path> entries;
  if (fs::is_directory(fs::symlink_status(folder, ignored)))
    for (fs::directory_iterator at(folder, ignored), end; at != end;
         at.increment(ignored))
      entries.push_back(at->path());
  for (const auto& entry : entries)
    removeFolder(entry);
  fs::remove(folder, ignored);
}
} // namespace

OutputFolder::OutputFolder(OutputRules rules)
: rules_(std::move(rules)), folder_(fs::absolute(rules_.folder).lexically_normal())
{
  if (!folder_.has_filename()) // "out/" names the folder "out"
    folder_ = folder_.parent_path();
  std::error_code error;
  place_ = {fs::weakly_canonical(folder_, error),
            rules_.folder.string(),
            rules_.files,
            rules_.journal};
  if (error)
    throw IoFailed(place_.shown + ": " + error.message());
  if (fs::is_symlink(place_.folder, error)) // resolves a link to an existing target
    throw IoFailed(place_.shown + ": is a link to " +
                   fs::read_symlink(place_.folder, error).string() +
                   ", which does not exist");
  for (const auto& input : rules_.inputs)
    refuseInput(folder_, input, place_.shown);
  if (fs::exists(folder_, error) && !fs::is_directory(folder_))
    throw IoFailed(place_.shown + ": output is a file, not a folder");
  giveNameBack(place_);
  claim();
  try {
    if (!isHalfMoved(place_))
      refuseForeignFolder(place_.folder, rules_);
    refuseLinkedFolders(place_.folder, place_.shown);
    finishLate(place_);
    holds_earlier_run_ = isMarkerOf(place_.folder / rules_.marker, rules_.program);
    staging_ = makeStaging(place_);
    staging_lock_ = FolderLock(staging_);
  } catch (...) {
    removeMade();
    throw;
  }
}

/** Makes the folder if missing, and locks it against other processes. */
void
OutputFolder::claim()
{
  made_ = topmostMissing(place_.folder);
  while (true) {
    std::error_code error;
    fs::create_directories(place_.folder, error);
    if (error) {
      removeMade();
      throw IoFailed(place_.shown +
                     ": cannot write into the output folder: " + error.message());
    }
    lock_ = FolderLock(place_.folder);
    if (!lock_.isHeld())
      throw IoFailed(place_.shown + ": another run is writing into this folder");
    if (lock_.isAt(place_.folder)) // else another run has replaced the folder meanwhile
      return;
  }
}

/** Removes the folders made by this object, if empty. */
void
OutputFolder::removeMade()
{
  if (made_.empty())
    return;
  std::error_code ignored;
  for (fs::path path = place_.folder;; path = path.parent_path()) {
    if (!fs::remove(path, ignored) || path == made_)
      break;
  }
  made_.clear();
}

OutputFolder::~OutputFolder()
{
  if (staging_lock_.isAt(staging_)) {
    staging_lock_ = FolderLock(); // its descriptor may be the last free one
    removeFolder(staging_);
  }
  removeMade();
}

void
OutputFolder::requireStaging() const
{
  if (!staging_lock_.isAt(staging_))
    throw IoFailed(staging_.string() +
                   ": the hidden folder for new files was removed while they were "
                   "written");
}

fs::path
OutputFolder::operator/(const std::string& name) const
{
  requireStaging();
  fs::create_directories((staging_ / name).parent_path());
  return staging_ / name;
}

void
OutputFolder::discard(const std::string& name) const
{
  fs::remove_all(staging_ / name);
}

std::vector<fs::path>
OutputFolder::publish(Journal journal)
{
  requireStaging();
  std::vector<fs::path> written;
  for (const auto& file : filesBelow(staging_)) {
    const fs::path top = folder_ / *file.begin();
    if (written.empty() || written.back() != top)
      written.push_back(top);
  }
  publishFiles(place_, staging_, holds_earlier_run_, journal == Journal::kKeep);
  made_.clear();
  return written;
}

std::vector<fs::path>
OutputFolder::publishBeside(const std::string& suffix)
{
  requireStaging();
  OutputRules rules = rules_;
  rules.folder = folder_;
  rules.folder += suffix;
  rules.journal.clear();
  OutputFolder beside(std::move(rules));
  for (const auto& file : filesBelow(staging_))
    fs::rename(staging_ / file, beside / file.string());
  return beside.publish(Journal::kDrop);
}

} // namespace pcl6d::app
