// SPDX-License-Identifier: BSD-3-Clause
// A file of records that may end anywhere.
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/record_file.h>

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <sys/resource.h>

namespace {
using pcl6d::RecordFile;
using Records = std::vector<std::string>;

/** Records of many sizes, one of them empty, with bytes of all kinds. */
const Records&
samples()
{
  static const Records records = {
      "first", "", std::string("\0\n\xff", 3), std::string(5000, 'x')};
  return records;
}

class RecordFileTest : public testing::Test {
protected:
  void
  writeSamples()
  {
    RecordFile file(path);
    for (const std::string& record : samples())
      file.append(record);
  }

  Records
  found() const
  {
    return RecordFile(path).records();
  }

  std::string
  content() const
  {
    return pcl6d::text::readFile(path);
  }

  void
  setContent(const std::string& bytes) const
  {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  }

  pcl6d::test::TempFolder folder;
  const std::filesystem::path path = folder / "records";
};
} // namespace

TEST_F(RecordFileTest, GivesBackWhatWasAppended)
{
  writeSamples();
  RecordFile file(path);
  EXPECT_EQ(file.records(), samples());
  EXPECT_EQ(file.dropped(), 0U);
}

TEST_F(RecordFileTest, GrowsWhenItIsOpenedAgain)
{
  writeSamples();
  RecordFile(path).append("more");
  Records expected = samples();
  expected.push_back("more");
  EXPECT_EQ(found(), expected);
}

TEST_F(RecordFileTest, CutAnywhereItKeepsTheRecordsBeforeAndGrows)
{
  writeSamples();
  const std::string whole = content();
  std::vector<std::size_t> ends; // of each number of records
  for (std::size_t n = 0; n <= samples().size(); ++n) {
    std::filesystem::remove(path);
    RecordFile file(path);
    for (std::size_t i = 0; i < n; ++i)
      file.append(samples()[i]);
    ends.push_back(content().size());
  }
  for (std::size_t size = 0; size < whole.size(); size += size < 100 ? 1 : 97) {
    setContent(whole.substr(0, size));
    const auto next = std::upper_bound(ends.begin(), ends.end(), size);
    const auto kept =
        next == ends.begin() ? 0 : static_cast<std::size_t>(next - ends.begin() - 1);
    Records expected(samples().begin(),
                     samples().begin() + static_cast<std::ptrdiff_t>(kept));
    {
      RecordFile file(path);
      ASSERT_EQ(file.records(), expected) << "cut to " << size << " bytes";
      file.append("after");
    }
    expected.emplace_back("after");
    ASSERT_EQ(found(), expected) << "cut to " << size << " bytes";
  }
}

TEST_F(RecordFileTest, AFlippedBitEndsItBeforeThatRecord)
{
  writeSamples();
  const std::string whole = content();
  for (std::size_t i = std::string("pcl6d records 1\n").size(); i < whole.size();
       i += i < 120 ? 1 : 511) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 4);
    setContent(damaged);
    const RecordFile file(path);
    ASSERT_LT(file.records().size(), samples().size()) << "byte " << i;
    for (std::size_t k = 0; k < file.records().size(); ++k)
      ASSERT_EQ(file.records()[k], samples()[k]) << "byte " << i;
    ASSERT_GT(file.dropped(), 0U);
  }
}

TEST_F(RecordFileTest, OfAnotherKindOrVersionIsRefusedAndKept)
{
  for (const std::string other : {"my notes\n", "pcl6d records 2\n..."}) {
    setContent(other);
    EXPECT_THROW(RecordFile{path}, pcl6d::IoFailed);
    EXPECT_EQ(content(), other);
  }
}

TEST_F(RecordFileTest, ALinkIsRefusedAndWhatItLeadsToStaysAsItIs)
{
  const auto other = folder / "other";
  for (const bool is_there : {false, true}) {
    if (is_there)
      std::ofstream(other) << "";
    std::filesystem::remove(path);
    std::filesystem::create_symlink(other, path);
    EXPECT_THROW(RecordFile{path}, pcl6d::IoFailed);
    EXPECT_EQ(std::filesystem::exists(other), is_there);
    if (is_there) {
      EXPECT_EQ(std::filesystem::file_size(other), 0U);
    }
  }
}

TEST_F(RecordFileTest, IsForOneAtATime)
{
  const RecordFile one(path);
  try {
    const RecordFile other(path);
    FAIL() << "opened twice";
  } catch (const pcl6d::IoFailed& e) {
    EXPECT_NE(std::string(e.what()).find("another process is writing this file"),
              std::string::npos)
        << e.what();
  }
}

TEST_F(RecordFileTest, AFullDiskLosesNoRecordThatWasAppended)
{
  writeSamples();
  const auto former = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  rlimit small = limit;
  small.rlim_cur = content().size() + 30; // a part of the next record fits
  {
    RecordFile file(path);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    EXPECT_THROW(file.append(std::string(1000, 'y')), pcl6d::IoFailed);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
    EXPECT_NO_THROW(file.append("room again"));
  }
  std::signal(SIGXFSZ, former);
  Records expected = samples();
  expected.emplace_back("room again");
  EXPECT_EQ(found(), expected);
}

TEST_F(RecordFileTest, IsGoneWhenRemoved)
{
  RecordFile file(path);
  file.append("one");
  file.remove();
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_THROW(file.append("two"), pcl6d::BadArgument);
}
