// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/temp_folder.h"

#include <pcl6d/common/error.h>

#include <pcl/PCLPointCloud2.h>

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <locale>
#include <string>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>
#include <vector>

namespace pcl6d::test {

/** \return the message of the Error that the call throws, "no error" if it throws none;
 * any other exception passes through and fails the test */
template <typename Error, typename Call>
std::string
messageOf(Call&& call)
{
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/** Expects that the call fails with exactly "FILE: message". */
template <typename Call>
void
expectIoFailed(const std::filesystem::path& file,
               const std::string& message,
               Call&& call)
{
  EXPECT_EQ(messageOf<IoFailed>(call), file.string() + ": " + message);
}

/** \return the names of all files in a folder, hidden ones included */
inline std::vector<std::string>
namesIn(const std::filesystem::path& folder)
{
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  return names;
}

/** \return a device on which every write fails for want of space. For root it is one of
 * its own in the folder: a fault in the code under test must not replace /dev/full,
 * which nobody but root can. */
inline std::filesystem::path
fullDevice(const TempFolder& folder)
{
  const std::filesystem::path path = folder / "full";
  const bool made = ::mknod(path.c_str(), S_IFCHR | 0666, makedev(1, 7)) == 0;
  return made || ::geteuid() == 0 ? path : "/dev/full";
}

/** \return the bytes of numbers, to be written as a binary file */
template <typename T>
std::string
bytesOf(const std::vector<T>& values)
{
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/** Writes a new file in the place of another, for loops over many contents: ext4 waits
 * for the disk when a file is truncated and written again. */
inline void
replaceText(const std::filesystem::path& path, const std::string& content)
{
  std::filesystem::remove(path);
  writeText(path, content);
}

/** \return the value of a field of a point */
template <typename T>
T
valueOf(const pcl::PCLPointCloud2& cloud,
        std::size_t point,
        const std::string& name,
        std::size_t element = 0)
{
  T value{};
  for (const auto& field : cloud.fields)
    if (field.name == name) {
      std::memcpy(
          &value,
          &cloud.data.at(point * cloud.point_step + field.offset + element * sizeof(T)),
          sizeof(T));
      return value;
    }
  ADD_FAILURE() << "no field " << name;
  return value;
}

/** \brief While it lives, streams write 1.234,5 for 1234.5, and read it so. */
class DecimalComma {
public:
  DecimalComma() : before_(std::locale::global(std::locale(std::locale(), new Comma)))
  {}
  ~DecimalComma() { std::locale::global(before_); }
  DecimalComma(const DecimalComma&) = delete;
  DecimalComma&
  operator=(const DecimalComma&) = delete;

private:
  struct Comma : std::numpunct<char> {
    char
    do_decimal_point() const override
    {
      return ',';
    }
    char
    do_thousands_sep() const override
    {
      return '.';
    }
    std::string
    do_grouping() const override
    {
      return "\3";
    }
  };
  std::locale before_;
};

inline const std::string kUnitInformation =
    " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n";

constexpr double kRotationTolerance = 1e-14; // [rad]

} // namespace pcl6d::test
