// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>

namespace pcl6d::test {

/** \brief A new empty folder that is removed at the end of its scope. */
class TempFolder {
public:
  TempFolder()
  {
    std::string name =
        (std::filesystem::temp_directory_path() / "pcl6d_test_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TempFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder&
  operator=(const TempFolder&) = delete;

  std::filesystem::path
  operator/(const std::string& name) const
  {
    return path_ / name;
  }
  const std::filesystem::path&
  path() const
  {
    return path_;
  }

private:
  std::filesystem::path path_;
};

inline void
writeText(const std::filesystem::path& path, const std::string& content)
{
  std::ofstream(path, std::ios::binary) << content;
}

inline std::string
readText(const std::filesystem::path& path)
{
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace pcl6d::test
