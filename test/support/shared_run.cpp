// SPDX-License-Identifier: BSD-3-Clause
#include "support/folders.h"
#include "support/shared_run.h"

#include <fcntl.h>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>
#include <sys/file.h>
#include <unistd.h>

namespace pcl6d::test {

namespace {
/** \return what tells one build of a program from another: size and time of it and of all
 * libraries of the build */
std::string
buildOf(const std::string& program)
{
  namespace fs = std::filesystem;
  std::ostringstream all;
  const auto add = [&](const fs::path& file) {
    all << file.string() << ' ' << fs::file_size(file) << ' '
        << fs::last_write_time(file).time_since_epoch().count() << '\n';
  };
  add(fs::path(PCL6D_BIN_DIR) / program);
  std::map<std::string, fs::path> libraries; // in one order
  const fs::path folder = PCL6D_BUILD_DIR "/lib";
  if (fs::exists(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.is_regular_file())
        libraries[entry.path().string()] = entry.path();
  for (const auto& [name, file] : libraries)
    add(file);
  return all.str();
}
} // namespace

std::filesystem::path
sharedOutput(const std::string& program, std::vector<std::string> arguments)
{
  namespace fs = std::filesystem;
  std::string words = program;
  for (const auto& argument : arguments)
    words += '\n' + argument;
  const std::hash<std::string> hash;
  const std::string prefix = program + '-' + std::to_string(hash(words)) + '-';
  const fs::path runs = PCL6D_BUILD_DIR "/test/runs";
  const fs::path folder = runs / (prefix + std::to_string(hash(buildOf(program))));
  fs::create_directories(runs);
  const int lock =
      ::open((runs / (prefix + "lock")).c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
  if (lock < 0 || ::flock(lock, LOCK_EX) != 0)
    throw std::runtime_error("cannot lock " + folder.string());
  if (!fs::exists(folder)) {
    std::vector<fs::path> former; // of other builds, and what a killed process left
    for (const auto& entry : fs::directory_iterator(runs))
      if (entry.is_directory() &&
          entry.path().filename().string().rfind(prefix, 0) == 0)
        former.push_back(entry.path());
    for (const auto& path : former)
      fs::remove_all(path);
    // Of this process: the program of one that was killed may still be writing.
    const fs::path unnamed = runs / (prefix + "by-" + std::to_string(::getpid()));
    arguments.insert(arguments.end(), {"-o", unnamed.string()});
    const Outcome outcome = runProgram(program, arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    if (outcome.exit_code == 0)
      fs::rename(unnamed, folder);
  }
  ::close(lock); // and with it the lock
  return folder;
}

} // namespace pcl6d::test
