// SPDX-License-Identifier: BSD-3-Clause
#include "common/output_folder.h"

#include <pcl6d/common/error.h>

#include <unistd.h>

namespace fs = std::filesystem;

namespace pcl6d::app {

namespace {
void
refuseForeignFolder(const fs::path& folder, const std::string& marker, bool force)
{
  if (force || fs::is_empty(folder) || fs::exists(folder / marker))
    return;
  throw IoFailed(folder.string() +
                 ": folder is not empty and holds no earlier run (no " + marker +
                 "); use another folder or --force");
}

/** Old results are removed from the output folder, so no input may lie in it. */
void
refuseInput(const fs::path& folder, const fs::path& input, const std::string& name)
{
  std::error_code error;
  if (input.empty() || !fs::exists(folder, error))
    return;
  if (fs::equivalent(folder, input, error))
    throw IoFailed(name + ": output folder is the input folder");
  fs::path above = fs::weakly_canonical(input, error);
  for (; above.has_relative_path(); above = above.parent_path())
    if (fs::equivalent(folder, above, error))
      throw IoFailed(name + ": the input folder " + input.string() +
                     " lies inside the output folder");
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

OutputFolder::OutputFolder(const fs::path& folder,
                           const fs::path& input,
                           const std::string& marker,
                           bool force)
: folder_(fs::absolute(folder).lexically_normal())
{
  if (!folder_.has_filename()) // "out/" names the folder "out"
    folder_ = folder_.parent_path();
  std::error_code error;
  refuseInput(folder_, input, folder.string());
  if (fs::exists(folder_, error) && !fs::is_directory(folder_))
    throw IoFailed(folder.string() + ": output is a file, not a folder");
  if (fs::is_directory(folder_)) {
    refuseForeignFolder(folder_, marker, force);
    holds_earlier_run_ = fs::exists(folder_ / marker);
    if (::access(folder_.c_str(), W_OK) != 0)
      throw IoFailed(folder.string() + ": output folder is not writable");
    return;
  }
  made_ = topmostMissing(folder_);
  fs::create_directories(folder_, error);
  if (error) {
    made_.clear();
    throw IoFailed(folder.string() + ": cannot make output folder: " + error.message());
  }
}

OutputFolder::~OutputFolder()
{
  std::error_code ignored;
  if (!made_.empty())
    fs::remove_all(made_, ignored);
}

void
OutputFolder::removeOld(const std::vector<std::string>& names) const
{
  if (!holds_earlier_run_)
    return;
  for (const auto& name : names)
    fs::remove_all(folder_ / name);
}

void
OutputFolder::commit()
{
  made_.clear();
}

fs::path
OutputFolder::operator/(const std::string& name) const
{
  return folder_ / name;
}

} // namespace pcl6d::app
