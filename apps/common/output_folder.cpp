// SPDX-License-Identifier: BSD-3-Clause
#include "common/output_folder.h"

#include <pcl6d/common/error.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <sys/file.h>
#include <unistd.h>
#include <utility>

namespace fs = std::filesystem;

namespace pcl6d::app {

namespace {
constexpr const char* kStagingPrefix = ".pcl6d-writing-";

/** \return whether a file is the marker that a program left */
bool
isMarkerOf(const fs::path& file, const std::string& program)
{
  if (!file.has_filename()) // the program leaves none
    return false;
  std::ifstream stream(file);
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  return json.is_object() && json.value("generator", nlohmann::json()) == program;
}

/** \return whether a process may run: one that has ended and waits for its parent does not */
bool
mayRun(int pid)
{
  if (pid <= 0 || (::kill(pid, 0) != 0 && errno != EPERM))
    return false;
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(stat, line)) // no /proc
    return true;
  const auto name_end = line.rfind(')'); // "pid (name) state ..."
  const char state = name_end + 2 < line.size() ? line[name_end + 2] : 'R';
  return state != 'Z' && state != 'X';
}

/** Locks a hidden folder for as long as the file that is returned is open.
 * \return the file; -1: another one has the lock. Without locks the process that made the
 * folder is asked for */
int
lockFolder(const fs::path& folder, int pid)
{
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0 || ::flock(file, LOCK_EX | LOCK_NB) == 0)
    return file;
  if (errno != EWOULDBLOCK && (pid == ::getpid() || !mayRun(pid)))
    return file;
  ::close(file);
  return -1;
}

/** Removes the hidden folders of programs that were killed.
 * \throws IoFailed another process writes into the folder */
void
removeLeftovers(const fs::path& folder, const std::string& name)
{
  const std::string prefix = kStagingPrefix;
  std::vector<fs::path> dead;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    if (file.rfind(prefix, 0) != 0)
      continue;
    const std::string pid = file.substr(prefix.size());
    const int lock = lockFolder(entry.path(), std::atoi(pid.c_str()));
    if (lock < 0)
      throw IoFailed(name + ": another run (process " + pid +
                     ") is writing into this folder");
    ::close(lock);
    dead.push_back(entry.path());
  }
  std::error_code ignored;
  for (const auto& path : dead)
    fs::remove_all(path, ignored);
}

/** \return the files below a folder, relative to it */
std::vector<fs::path>
filesBelow(const fs::path& folder)
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory() || entry.is_symlink())
      files.push_back(
          fs::relative(entry.path().parent_path(), folder).lexically_normal() /
          entry.path().filename());
  for (auto& file : files)
    file = file.lexically_normal();
  std::sort(files.begin(), files.end());
  return files;
}

/** \return whether there is nothing but an interrupted run: its journal and, if it was killed
 * while its files were moved to their places, some of these */
bool
holdsInterruptedRun(const fs::path& folder, const OutputRules& rules)
{
  if (rules.journal.empty() || !fs::exists(folder / rules.journal))
    return false;
  const auto files = filesBelow(folder);
  return std::all_of(files.begin(), files.end(), [&](const fs::path& file) {
    return file == rules.journal || std::regex_match(file.string(), rules.files);
  });
}

void
refuseForeignFolder(const fs::path& folder, const OutputRules& rules)
{
  if (rules.force || fs::is_empty(folder) || holdsInterruptedRun(folder, rules) ||
      isMarkerOf(folder / rules.marker, rules.program))
    return;
  if (rules.marker.empty())
    throw IoFailed(rules.folder.string() + ": folder is not empty; use a new one");
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

/** \return the topmost part of the path that does not exist yet; empty if all exists */
fs::path
topmostMissing(const fs::path& folder)
{
  fs::path missing;
  for (fs::path p = folder; !p.empty() && !fs::exists(p); p = p.parent_path())
    missing = p;
  return missing;
}
} // namespace

OutputFolder::OutputFolder(OutputRules rules)
: rules_(std::move(rules)), folder_(fs::absolute(rules_.folder).lexically_normal())
{
  if (!folder_.has_filename()) // "out/" names the folder "out"
    folder_ = folder_.parent_path();
  const std::string name = rules_.folder.string();
  for (const auto& input : rules_.inputs)
    refuseInput(folder_, input, name);
  std::error_code error;
  if (fs::exists(folder_, error) && !fs::is_directory(folder_))
    throw IoFailed(name + ": output is a file, not a folder");
  if (fs::is_directory(folder_, error)) {
    removeLeftovers(folder_, name);
    refuseForeignFolder(folder_, rules_);
    refuseLinkedFolders(folder_, name);
    holds_earlier_run_ = isMarkerOf(folder_ / rules_.marker, rules_.program);
  }
  else {
    made_ = topmostMissing(folder_);
  }
  staging_ = folder_ / (kStagingPrefix + std::to_string(::getpid()));
  fs::create_directories(staging_, error);
  if (error) {
    if (!made_.empty())
      fs::remove_all(std::exchange(made_, fs::path()), error);
    throw IoFailed(name + ": cannot write into the output folder: " + error.message());
  }
  lock_ = lockFolder(staging_, ::getpid());
}

OutputFolder::~OutputFolder()
{
  std::error_code ignored;
  fs::remove_all(made_.empty() || holdsJournal() ? staging_ : made_, ignored);
  if (lock_ >= 0)
    ::close(lock_);
}

bool
OutputFolder::holdsJournal() const
{
  std::error_code ignored;
  return !rules_.journal.empty() && fs::exists(journal(), ignored);
}

fs::path
OutputFolder::operator/(const std::string& name) const
{
  fs::create_directories((staging_ / name).parent_path());
  return staging_ / name;
}

void
OutputFolder::discard(const std::string& name) const
{
  fs::remove_all(staging_ / name);
}

/** \param[in] files those of the new run */
void
OutputFolder::removeOldRun(const std::vector<fs::path>& files) const
{
  for (const auto& file : filesBelow(folder_))
    if (std::regex_match(file.string(), rules_.files) &&
        !std::binary_search(files.begin(), files.end(), file)) {
      fs::remove(folder_ / file);
      const fs::path parent = (folder_ / file).parent_path();
      if (parent != folder_ && fs::is_empty(parent))
        fs::remove(parent);
    }
}

std::vector<fs::path>
OutputFolder::publish()
{
  const auto files = filesBelow(staging_);
  for (const auto& file : files)
    if (fs::is_directory(folder_ / file))
      throw IoFailed((folder_ / file).string() + ": is a folder, but a file is to be "
                                                 "written there");
  const auto move = [&](const fs::path& file) {
    fs::create_directories((folder_ / file).parent_path());
    fs::rename(staging_ / file, folder_ / file);
  };
  // The marker last: with it the folder tells of a run that is whole.
  std::vector<fs::path> written;
  bool has_marker = false;
  for (const auto& file : files) {
    if (file == rules_.marker)
      has_marker = true;
    else
      move(file);
    const fs::path top = folder_ / *file.begin();
    if (written.empty() || written.back() != top)
      written.push_back(top);
  }
  if (has_marker)
    move(rules_.marker);
  if (holds_earlier_run_)
    removeOldRun(files);
  made_.clear();
  return written;
}

} // namespace pcl6d::app
