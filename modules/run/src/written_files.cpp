// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/text.h>
#include <pcl6d/run/written_files.h>

#include <array>
#include <fstream>
#include <zlib.h>

namespace pcl6d {

namespace fs = std::filesystem;

namespace {
constexpr const char* kSummaryFile = "summary.json";

[[noreturn]] void
failChanged(const fs::path& file, const std::string& difference)
{
  text::fail(file,
             difference + ": changed after the run, copied in part, or the run was "
                          "stopped during replacement (start the run again)");
}
} // namespace

WrittenFile
writtenFile(const fs::path& file)
{
  std::ifstream stream = text::open(file);
  WrittenFile written;
  std::array<char, 1 << 16> block;
  while (stream) {
    stream.read(block.data(), block.size());
    const auto count = static_cast<std::size_t>(stream.gcount());
    written.crc32 = static_cast<std::uint32_t>(::crc32_z(
        written.crc32, reinterpret_cast<const unsigned char*>(block.data()), count));
    written.bytes += count;
  }
  if (stream.bad())
    text::fail(file, text::systemReason("cannot be read"));
  return written;
}

std::map<std::string, WrittenFile>
writtenFiles(const fs::path& folder)
{
  std::map<std::string, WrittenFile> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (entry.is_regular_file() && name != kSummaryFile)
      files[name] = writtenFile(entry.path());
  }
  return files;
}

void
requireAsWritten(const fs::path& file, const WrittenFile& written, bool whole)
{
  std::error_code error;
  const auto size = fs::file_size(file, error);
  if (error) // missing or no file: reported by the reader
    return;
  if (size != written.bytes)
    failChanged(file,
                "has " + text::counted(size, "byte") + ", but its run wrote " +
                    std::to_string(written.bytes));
  if (whole && !(writtenFile(file) == written))
    failChanged(file, "differs from the file of the run");
}

} // namespace pcl6d
