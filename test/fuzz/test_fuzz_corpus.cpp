// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/fuzz_target.h"
#include "support/folders.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/run/record_file.h>

#include <pcl/console/print.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

namespace pcl6d::fuzz {
void
PrintTo(const Target& target, std::ostream* stream)
{
  *stream << target.name;
}
} // namespace pcl6d::fuzz

using namespace pcl6d::fuzz;

namespace {
namespace fs = std::filesystem;
const fs::path kCorpus = PCL6D_SOURCE_DIR "/test/fuzz/corpus";

std::vector<fs::path>
filesOf(const fs::path& folder)
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/** \return whether the content was read, not refused */
bool
feed(const Target& target, const std::string& content)
{
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(content.data());
  return target.read(bytes, content.size()) == 0;
}

/** Inserts, removes and changes bytes, as libFuzzer does where it is at hand. */
struct SomeBytes {
  std::mt19937 random;

  std::size_t
  operator()(std::uint8_t* data, std::size_t size, std::size_t max_size)
  {
    const unsigned int kind = random() % 3;
    const std::size_t place = size == 0 ? 0 : random() % size;
    if (size == 0 || (kind == 0 && size < max_size)) { // insert
      std::copy_backward(data + place, data + size, data + size + 1);
      data[place] = static_cast<std::uint8_t>(random());
      return size + 1;
    }
    if (kind == 1) { // remove
      std::copy(data + place + 1, data + size, data + place);
      return size - 1;
    }
    data[place] = static_cast<std::uint8_t>(random());
    return size;
  }
};

class Corpus : public testing::TestWithParam<Target> {
protected:
  Corpus()
  {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); // as the programs do
  }
};
} // namespace

TEST_P(Corpus, IsReadOrRefusedInWords)
{
  const auto files = filesOf(kCorpus / GetParam().name);
  int read = 0;
  for (const auto& file : files) {
    SCOPED_TRACE(file.string());
    EXPECT_NO_THROW(read += feed(GetParam(), pcl6d::test::readText(file)));
  }
  EXPECT_GT(read, 0) << "no seed is a file that can be read";
}

TEST_P(Corpus, IsReadOrRefusedInWordsAfterChanges)
{
  constexpr unsigned int kChanges = 100; // of each file; clang's fuzzer does the rest
  for (const auto& file : filesOf(kCorpus / GetParam().name)) {
    SCOPED_TRACE(file.string());
    const std::string content = pcl6d::test::readText(file);
    std::string changed = content;
    for (unsigned int seed = 0; seed < kChanges; ++seed) {
      if (seed % 8 == 0) // up to 8 changes on top of each other
        changed = content;
      const std::size_t max_size = std::max(GetParam().max_size, content.size());
      changed = mutate(
          changed, GetParam().structure, max_size, seed, SomeBytes{std::mt19937(seed)});
      ASSERT_NO_THROW(feed(GetParam(), changed)) << "after change " << seed << ":\n"
                                                 << changed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Readers,
                         Corpus,
                         testing::ValuesIn(targets()),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(CorpusFolder, HasATargetForEachFolder)
{
  for (const auto& folder : filesOf(kCorpus))
    EXPECT_NE(findTarget(folder.filename().string()), nullptr) << folder;
}

TEST(CorpusFolder, StaysSmall)
{
  std::uintmax_t size = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kCorpus))
    size += entry.is_regular_file() ? entry.file_size() : 0;
  EXPECT_LT(size, 300'000u) << "bytes";
}

TEST(Words, OfLibrariesAreFindings)
{
  EXPECT_NO_THROW(checkWords("scan.pcd: line 3: 'x' is not a number"));
  for (const char* const bad : {"",
                                "a.json: [json.exception.parse_error.101] at 1",
                                "out: cannot be written: Success",
                                "vector::reserve",
                                "a.txt: \x1b[31mred",
                                "basic_filebuf::underflow error reading the file"})
    EXPECT_THROW(checkWords(bad), Finding) << bad;
  EXPECT_THROW(checkWords(std::string(100'000, 'x')), Finding);
  EXPECT_NO_THROW(checkWords("line 3: 'vector::' is not a number", "1 2\nvector:: 4"));
}

TEST(Mutations, KeepEqualCountsEqual)
{
  const std::string header = "WIDTH 5\nHEIGHT 1\nPOINTS 5\nDATA binary\n";
  bool changed_both = false;
  for (unsigned int seed = 0; seed < 2000 && !changed_both; ++seed) {
    const std::string changed = mutate(
        header + "abc", Structure::kPcd, 1000, seed, SomeBytes{std::mt19937(seed)});
    changed_both = changed.rfind("WIDTH 7\n", 0) == 0 &&
                   changed.find("POINTS 7\n") != changed.npos;
  }
  EXPECT_TRUE(changed_both);
}

TEST(Mutations, MendChecksumsOfRecords)
{
  const pcl6d::test::TempFolder folder;
  const std::string content =
      pcl6d::test::readText(kCorpus / "record_file/two_records");
  int changed_records = 0; // that pass the checksum
  for (unsigned int seed = 0; seed < 200; ++seed) {
    const auto file = folder / std::to_string(seed);
    pcl6d::test::writeText(file,
                           mutate(content,
                                  Structure::kRecordFile,
                                  1000,
                                  seed,
                                  SomeBytes{std::mt19937(seed)}));
    try {
      const pcl6d::RecordFile records(file);
      for (const auto& record : records.records())
        changed_records += record != "first" && record != "second one";
    } catch (const pcl6d::IoFailed&) { // the first line is broken
    }
  }
  EXPECT_GT(changed_records, 50);
}

TEST(Mutations, StayWithinTheLargestSize)
{
  for (const auto& target : targets())
    for (const auto& file : filesOf(kCorpus / target.name))
      for (unsigned int seed = 0; seed < 20; ++seed)
        EXPECT_LE(mutate(pcl6d::test::readText(file),
                         target.structure,
                         64,
                         seed,
                         SomeBytes{std::mt19937(seed)})
                      .size(),
                  64u)
            << file;
}
