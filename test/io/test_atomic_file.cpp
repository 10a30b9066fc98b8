// SPDX-License-Identifier: BSD-3-Clause
#include "io_test.h"

#include <pcl6d/io/atomic_file.h>

#include <ostream>
#include <stdexcept>

namespace fs = std::filesystem;
using pcl6d::writeFileAtomically;
using pcl6d::writeFileAtomicallyBy;
using pcl6d::test::expectIoFailed;
using pcl6d::test::namesIn;
using pcl6d::test::readText;
using pcl6d::test::writeText;

TEST(AtomicFile, HoldsWhatWasWrittenAndLeavesNoOtherFile)
{
  const pcl6d::test::TempFolder folder;
  const std::string content("a\0b\r\n", 5); // binary: nothing is translated
  writeFileAtomically(folder / "file.txt", [&](std::ostream& s) { s << content; });
  EXPECT_EQ(readText(folder / "file.txt"), content);
  EXPECT_EQ(namesIn(folder.path()), std::vector<std::string>{"file.txt"});
}

TEST(AtomicFile, KeepsTheOldContentUntilTheNewOneIsComplete)
{
  const pcl6d::test::TempFolder folder;
  writeText(folder / "file.txt", "old");
  writeFileAtomically(folder / "file.txt", [&](std::ostream& s) {
    s << "new" << std::flush;
    EXPECT_EQ(readText(folder / "file.txt"), "old");
    const auto names = namesIn(folder.path());
    ASSERT_EQ(names.size(), 2u);
    const std::string temporary = names[names[0] == "file.txt" ? 1 : 0];
    EXPECT_EQ(temporary.front(), '.'); // hidden, so no reader takes it for a scan
  });
  EXPECT_EQ(readText(folder / "file.txt"), "new");
}

TEST(AtomicFile, AnExceptionLeavesTheOldFileAndNoOther)
{
  const pcl6d::test::TempFolder folder;
  writeText(folder / "file.txt", "old");
  const auto fail = [&] {
    writeFileAtomically(folder / "file.txt", [](std::ostream& s) {
      s << "half" << std::flush;
      throw std::runtime_error("no more");
    });
  };
  EXPECT_THROW(fail(), std::runtime_error);
  EXPECT_EQ(readText(folder / "file.txt"), "old");
  EXPECT_EQ(namesIn(folder.path()).size(), 1u);
}

TEST(AtomicFile, AStreamThatFailedIsAnError)
{
  const pcl6d::test::TempFolder folder;
  EXPECT_THROW(
      writeFileAtomically(folder / "file.txt",
                          [](std::ostream& s) { s.setstate(std::ios::failbit); }),
      pcl6d::IoFailed);
  EXPECT_TRUE(namesIn(folder.path()).empty());
}

TEST(AtomicFile, NamesTheFileAndTheReasonWhenItCannotBeWritten)
{
  const pcl6d::test::TempFolder folder;
  writeText(folder / "file", "");
  const auto to = [](const fs::path& path) {
    return [path] { writeFileAtomically(path, [](std::ostream& s) { s << 1; }); };
  };
  fs::path path = folder / "missing" / "file.txt";
  expectIoFailed(path, "No such file or directory", to(path));
  path = folder / "file" / "file.txt";
  expectIoFailed(path, "Not a directory", to(path));
  path = folder.path();
  expectIoFailed(path, "cannot be written: it is a folder", to(path));
  path = "/dev/full";
  expectIoFailed(path, "No space left on device", to(path));
  EXPECT_EQ(namesIn(folder.path()).size(), 1u);
}

TEST(AtomicFile, ADeviceIsWrittenAndNotReplaced)
{
  writeFileAtomically("/dev/null", [](std::ostream& s) { s << "gone"; });
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(AtomicFile, ALinkStaysALink)
{
  const pcl6d::test::TempFolder folder;
  writeText(folder / "real.txt", "old");
  fs::create_symlink("real.txt", folder / "link.txt");
  writeFileAtomically(folder / "link.txt", [](std::ostream& s) { s << "new"; });
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(readText(folder / "real.txt"), "new");
}

TEST(AtomicFile, ByNameGivesAnotherNameWithTheSameExtensionInTheSameFolder)
{
  const pcl6d::test::TempFolder folder;
  writeFileAtomicallyBy(folder / "map.ply", [&](const fs::path& temporary) {
    EXPECT_EQ(temporary.extension(), ".ply");
    EXPECT_EQ(temporary.parent_path(), folder.path());
    EXPECT_NE(temporary, folder / "map.ply");
    writeText(temporary, "content");
  });
  EXPECT_EQ(readText(folder / "map.ply"), "content");
  EXPECT_THROW(writeFileAtomicallyBy(folder / "map.ply",
                                     [](const fs::path& temporary) {
                                       writeText(temporary, "half");
                                       throw std::runtime_error("no more");
                                     }),
               std::runtime_error);
  EXPECT_EQ(readText(folder / "map.ply"), "content");
  EXPECT_EQ(namesIn(folder.path()).size(), 1u);
}

TEST(AtomicFile, AWriterThatWritesNothingIsAnError)
{
  const pcl6d::test::TempFolder folder;
  expectIoFailed(folder / "map.ply", "No such file or directory", [&] {
    writeFileAtomicallyBy(folder / "map.ply", [](const fs::path&) {});
  });
}

TEST(AtomicFile, HasNoTroubleWithTheLongestName)
{
  const pcl6d::test::TempFolder folder;
  const std::string name = std::string(251, 'x') + ".txt"; // 255 is the limit
  writeFileAtomically(folder / name, [](std::ostream& s) { s << "content"; });
  EXPECT_EQ(readText(folder / name), "content");
}
