// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/result_json.h"
#include "evaluate/suite/run_record.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/version.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/json_object.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <ostream>
#include <set>
#include <vector>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

/** FNV-1a with 64 bits, eight bytes at a time: to notice changes, not attackers. */
class Hash {
public:
  void
  add(const std::string& bytes)
  {
    std::size_t i = 0;
    for (; i + sizeof(std::uint64_t) <= bytes.size(); i += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      bytes.copy(reinterpret_cast<char*>(&word), sizeof word, i);
      mix(word);
    }
    for (; i < bytes.size(); ++i)
      mix(static_cast<unsigned char>(bytes[i]));
    mix(bytes.size());
  }

  std::string
  text() const
  {
    char digits[17];
    std::snprintf(
        digits, sizeof digits, "%016llx", static_cast<unsigned long long>(state_));
    return digits;
  }

private:
  void
  mix(std::uint64_t word)
  {
    state_ = (state_ ^ word) * 1099511628211ULL;
    state_ ^= state_ >> 32; // else the high bytes of a word reach only the high bytes
  }

  std::uint64_t state_ = 14695981039346656037ULL;
};

std::string
bytesOf(const fs::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/** \return our libraries loaded by this program, without libraries used only for evaluation */
std::set<std::string>
loadedLibraries()
{
  std::set<std::string> files;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const auto slash = line.find('/');
    if (slash == std::string::npos)
      continue;
    const std::string file = line.substr(slash);
    const std::string name = fs::path(file).filename().string();
    const auto isOf = [&](const char* prefix) { return name.rfind(prefix, 0) == 0; };
    if (isOf("libpcl6d_") && !isOf("libpcl6d_benchmarking") &&
        !isOf("libpcl6d_plane_segmentation"))
      files.insert(file);
  }
  return files;
}
} // namespace

bool
RunRecord::hasResult() const
{
  return end.signal == 0 && !end.timed_out &&
         (end.exit_code == 0 || end.exit_code == 3);
}

std::string
RunRecord::verdict() const
{
  if (end.timed_out)
    return "timed out";
  if (end.signal != 0)
    return "killed (signal " + std::to_string(end.signal) + ")";
  if (!hasResult())
    return "failed (exit " + std::to_string(end.exit_code) + ")";
  return end.exit_code == 0 ? "reliable" : "not reliable";
}

bool
RunRecord::countsFor(const Json& inputs_now, double time_limit_now) const
{
  return inputs == inputs_now && !(end.timed_out && time_limit < time_limit_now);
}

void
writeRunRecord(const fs::path& file, const RunRecord& record)
{
  const Json json = {{"schema_version", 1},
                     {"inputs", record.inputs},
                     {"verdict", record.verdict()},
                     {"exit_code", record.end.exit_code},
                     {"signal", record.end.signal},
                     {"timed_out", record.end.timed_out},
                     {"time_limit", record.time_limit},
                     {"seconds", record.end.seconds},
                     {"cpu_seconds", record.end.cpu_seconds},
                     {"peak_memory_mb", record.end.peak_memory_mb},
                     {"message", record.message}};
  writeJson(file, json, 2);
}

std::optional<RunRecord>
readRunRecord(const fs::path& file)
try {
  const JsonValue json = readJson(file);
  RunRecord record;
  record.inputs = (json / "inputs").json();
  record.end.exit_code = (json / "exit_code").integer();
  record.end.signal = (json / "signal").integer();
  record.end.timed_out = (json / "timed_out").boolean();
  record.time_limit = (json / "time_limit").number();
  record.end.seconds = (json / "seconds").number();
  record.end.cpu_seconds = (json / "cpu_seconds").number();
  record.end.peak_memory_mb = (json / "peak_memory_mb").number();
  record.message = (json / "message").text();
  return record;
} catch (const IoFailed&) {
  return std::nullopt; // then it runs again
}

std::string
errorIn(const fs::path& log)
{
  static const std::string kError = ": error: ";
  std::ifstream stream(log);
  std::string last, error;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty())
      continue;
    last = line;
    const auto place = line.find(kError);
    if (place != std::string::npos)
      error = line.substr(place + kError.size());
  }
  return error.empty() ? last : error;
}

fs::path
programBeside(const std::string& name)
{
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / name;
  if (!fs::exists(program))
    throw IoFailed(program.string() +
                   ": program not found; install both programs in one folder");
  return program;
}

Json
describePrograms()
{
  Hash hash;
  for (const char* name : {"pcl_slam6d", "pcl_slam6d_simulate"})
    hash.add(bytesOf(programBeside(name)));
  for (const auto& file : loadedLibraries())
    hash.add(bytesOf(file));
  return {{"version", PCL6D_VERSION}, {"hash", hash.text()}};
}

std::string
hashOfFiles(const fs::path& path)
{
  std::vector<std::string> lines;
  const auto add = [&](const fs::directory_entry& entry) {
    if (entry.is_regular_file())
      lines.push_back(
          entry.path().filename().string() + ' ' + std::to_string(entry.file_size()) +
          ' ' + std::to_string(entry.last_write_time().time_since_epoch().count()));
  };
  if (fs::is_directory(path))
    for (const auto& entry : fs::directory_iterator(path))
      add(entry);
  else
    add(fs::directory_entry(path));
  std::sort(lines.begin(), lines.end());
  Hash hash;
  for (const auto& line : lines)
    hash.add(line);
  return hash.text();
}

} // namespace pcl6d::app
