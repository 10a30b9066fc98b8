// SPDX-License-Identifier: BSD-3-Clause
#include "support/folders.h"
#include "support/run_program.h"

#include <boost/process.hpp>
#include <gtest/gtest.h>

namespace pcl6d::test {

Outcome
runProgram(const std::string& name, const std::vector<std::string>& arguments)
{
  namespace bp = boost::process;
  const TempFolder folder;
  const std::string out = folder / "out", err = folder / "err";
  Outcome outcome;
  outcome.exit_code = bp::system(std::string(PCL6D_BIN_DIR "/") + name,
                                 bp::args = arguments,
                                 bp::std_in<bp::null, bp::std_out> out,
                                 bp::std_err > err);
  outcome.out = readText(out);
  outcome.err = readText(err);
  return outcome;
}

void
expectError(const Outcome& outcome,
            const std::string& name,
            int exit_code,
            const std::vector<std::string>& words)
{
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  ASSERT_FALSE(outcome.err.empty());
  const std::size_t end = outcome.err.find_last_not_of('\n');
  const std::size_t before = outcome.err.find_last_of('\n', end);
  const std::size_t start = before == std::string::npos ? 0 : before + 1;
  const std::string line = outcome.err.substr(start, end + 1 - start);
  const std::string prefix = name + ": error: ";
  EXPECT_EQ(line.rfind(prefix, 0), 0u) << outcome.err;
  EXPECT_EQ(outcome.err.find(prefix), start) << outcome.err;
  for (const auto& word : words)
    EXPECT_NE(line.find(word), std::string::npos) << '"' << word << "\" in: " << line;
}

std::map<std::string, std::string>
contentOf(const std::filesystem::path& folder)
{
  std::map<std::string, std::string> content;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    content[std::filesystem::relative(entry.path(), folder).string()] =
        entry.is_regular_file() ? readText(entry.path()) : "";
  return content;
}

} // namespace pcl6d::test
