// SPDX-License-Identifier: BSD-3-Clause
// What the end of a program says, whatever ended it.
#include "common/app.h"
#include "support/sanitizer.h"

#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <locale>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace {
using pcl6d::app::runMain;

struct End {
  int code;
  std::string err;
};

End
endOf(const std::function<int()>& body)
{
  std::string name = "prog";
  char* argv[] = {name.data(), nullptr};
  testing::internal::CaptureStderr();
  const int code =
      runMain("prog", 1, argv, [&](const std::vector<std::string>&) { return body(); });
  return {code, testing::internal::GetCapturedStderr()};
}

template <typename Thrown>
void
expectWords(const Thrown& thrown, const std::string& words, int code = 1)
{
  const End end = endOf([&]() -> int { throw thrown; });
  EXPECT_EQ(end.code, code) << words;
  EXPECT_EQ(end.err, "prog: error: " + words + "\n");
}
} // namespace

TEST(RunMain, TellsEveryExceptionInWords)
{
  expectWords(pcl6d::IoFailed("a.pcd: line 1: broken"), "a.pcd: line 1: broken");
  expectWords(pcl6d::app::UsageError("--x = 1"), "--x = 1 (see --help)", 2);
  expectWords(std::bad_alloc(), "not enough memory");
  expectWords(std::bad_array_new_length(), "not enough memory");
  expectWords(std::length_error("vector::reserve"),
              "not enough memory: the request exceeds every limit (vector::reserve)");
  expectWords(std::system_error(EAGAIN, std::generic_category()),
              "no more threads, or no memory for a thread");
  expectWords(42, "an exception of an unknown kind was thrown: i");
  expectWords(std::runtime_error("a\nb\x1b[31m"), "a\\nb\\x1b[31m");
  expectWords(std::system_error(0, std::generic_category(), "x.pcd: cannot be read"),
              "x.pcd: cannot be read");
  expectWords(std::filesystem::filesystem_error(
                  "cannot rename",
                  "a.pcd",
                  "b.pcd",
                  std::make_error_code(std::errc::permission_denied)),
              "a.pcd or b.pcd: Permission denied");
}

TEST(RunMain, ShortensALongMessageInTheMiddle)
{
  const End end = endOf([]() -> int {
    throw pcl6d::app::UsageError("begin" + std::string(100000, '9') + "end");
  });
  EXPECT_EQ(end.err.substr(0, 20), "prog: error: begin99");
  EXPECT_LT(end.err.size(), 1100u);
  EXPECT_NE(end.err.find(" [...] 9"), std::string::npos);
  EXPECT_NE(end.err.find("9end (see --help)\n"), std::string::npos);
}

TEST(RunMain, HasAValidLocaleForItsLibrariesAndChildren)
{
  for (const char* const name : {"LANG", "LC_CTYPE", "LC_ALL"}) {
    ::setenv(name, "xx_YY.UTF-8", 1);
    EXPECT_THROW(std::locale(""), std::runtime_error) << name;
    const End end = endOf([] {
      std::locale("");
      return 0;
    });
    EXPECT_EQ(end.code, 0) << end.err;
    ::unsetenv("LC_ALL");
    ::unsetenv(name);
  }
}

namespace {
void* taken = nullptr;

/** As a destructor that asks for memory on its way: what it throws cannot get out, and when it
 * is stopped nothing tells any more what it was. */
void
askForMemory() noexcept
{
  const std::string name(100, 'x');
  taken = ::operator new (std::size_t{1} << 60);
  std::cerr << name;
}
} // namespace

TEST(RunMain, TellsOfMemoryThatEndsWhereNothingCanBeThrown)
{
  if (pcl6d::test::isUnderAddressSanitizer())
    GTEST_SKIP() << "its operator new ends the process itself";
  const auto body = [](const std::vector<std::string>&) {
    askForMemory();
    return 0;
  };
  std::string name = "prog";
  char* argv[] = {name.data(), nullptr};
  EXPECT_EXIT(std::exit(runMain("prog", 1, argv, body)),
              testing::ExitedWithCode(1),
              "error: not enough memory");
}
