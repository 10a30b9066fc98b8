// SPDX-License-Identifier: BSD-3-Clause
#include "io_test.h"

#include <pcl6d/io/atomic_file.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <ostream>
#include <set>
#include <stdexcept>
#include <sys/resource.h>
#include <unistd.h>

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
    for (const auto& name : namesIn(folder.path())) // none, or one that no reader takes
      EXPECT_TRUE(name == "file.txt" || name.front() == '.') << name;
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
  expectIoFailed(path, "cannot be written: is a folder", to(path));
  EXPECT_EQ(namesIn(folder.path()).size(), 1u);
}

TEST(AtomicFile, WhetherItCanBeWrittenIsKnownBefore)
{
  const pcl6d::test::TempFolder folder;
  writeText(folder / "old", "old");
  pcl6d::requireWritable(folder / "old");
  pcl6d::requireWritable(folder / "new");
  pcl6d::requireWritable("/dev/null");
  EXPECT_EQ(readText(folder / "old"), "old");
  EXPECT_EQ(namesIn(folder.path()), std::vector<std::string>{"old"});
  for (const auto& [path, reason] : std::vector<std::pair<fs::path, const char*>>{
           {folder / "no/file", "No such file or directory"},
           {folder / "old/file", "Not a directory"},
           {folder.path(), "cannot be written: is a folder"},
           {"", "is not the name of a file"}})
    expectIoFailed(path, reason, [path = path] { pcl6d::requireWritable(path); });
}

TEST(AtomicFile, ADeviceIsWrittenAndNotReplaced)
{
  const pcl6d::test::TempFolder folder;
  const fs::path full = pcl6d::test::fullDevice(folder);
  expectIoFailed(full, "No space left on device", [&] {
    writeFileAtomically(full, [](std::ostream& s) { s << 1; });
  });
  EXPECT_TRUE(fs::is_character_file(full));
  EXPECT_LE(namesIn(folder.path()).size(), 1u);
}

TEST(AtomicFile, APipeIsWrittenAndNotReplaced)
{
  const pcl6d::test::TempFolder folder;
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::fstream keep_open(pipe); // both ends, so that nobody waits for the other
  writeFileAtomically(pipe, [](std::ostream& s) { s << "content\n"; });
  EXPECT_TRUE(fs::is_fifo(pipe));
  std::string line;
  if (fs::is_fifo(pipe))
    std::getline(keep_open, line);
  EXPECT_EQ(line, "content");
}

TEST(AtomicFile, AFileThatThisProcessHasOpenKeepsWhatItHolds)
{
  // As `program -o /dev/stdout >> FILE`: replacing FILE would take what it holds.
  const pcl6d::test::TempFolder folder;
  const int file =
      ::open((folder / "log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  ASSERT_EQ(::write(file, "before ", 7), 7);
  for (const std::string place : {"/dev/fd/", "/proc/self/fd/"}) {
    EXPECT_TRUE(pcl6d::isStream(place + std::to_string(file)));
    writeFileAtomically(place + std::to_string(file),
                        [](std::ostream& s) { s << "here "; });
  }
  ASSERT_EQ(::write(file, "after", 5), 5);
  ::close(file);
  EXPECT_EQ(readText(folder / "log"), "before here here after");
  EXPECT_FALSE(pcl6d::isStream(folder / "log"));
  expectIoFailed("/dev/fd/12345", "Bad file descriptor", [] {
    writeFileAtomically("/dev/fd/12345", [](std::ostream& s) { s << "x"; });
  });
}

TEST(AtomicFile, ALinkOfAnotherUserIsRefused)
{
  const pcl6d::test::TempFolder folder;
  writeText(folder / "mine", "mine");
  fs::create_symlink("mine", folder / "link");
  constexpr uid_t kNobody = 65534;
  if (::lchown((folder / "link").c_str(), kNobody, kNobody) != 0)
    GTEST_SKIP() << "only root can make a link of another user";
  const auto write = [&] {
    writeFileAtomically(folder / "link", [](std::ostream& s) { s << "x"; });
  };
  expectIoFailed(
      folder / "link", "is a symbolic link of another user: not followed", write);
  EXPECT_EQ(readText(folder / "mine"), "mine");
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

TEST(AtomicFile, ByNameGivesANameWithTheSameExtensionThatNobodyElseCanTake)
{
  const pcl6d::test::TempFolder folder;
  std::set<fs::path> names;
  for (int i = 0; i < 3; ++i)
    writeFileAtomicallyBy(folder / "map.ply", [&](const fs::path& temporary) {
      EXPECT_EQ(temporary.extension(), ".ply");
      EXPECT_EQ(temporary.parent_path().parent_path(), folder.path());
      EXPECT_EQ(fs::status(temporary.parent_path()).permissions(),
                fs::perms::owner_all);
      EXPECT_TRUE(names.insert(temporary).second) << "it could be foreseen";
      writeText(temporary, "content");
    });
  writeFileAtomicallyBy(folder / "map.ply", [&](const fs::path& temporary) {
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

TEST(AtomicFile, KeepsThePermissionsOfTheFileThatIsReplaced)
{
  const pcl6d::test::TempFolder folder;
  writeText(folder / "file.txt", "old");
  fs::permissions(folder / "file.txt", fs::perms(0604));
  writeFileAtomically(folder / "file.txt", [](std::ostream& s) { s << "new"; });
  EXPECT_EQ(fs::status(folder / "file.txt").permissions(), fs::perms(0604));
  const mode_t mask = ::umask(027);
  writeFileAtomically(folder / "fresh.txt", [](std::ostream& s) { s << "new"; });
  ::umask(mask);
  EXPECT_EQ(fs::status(folder / "fresh.txt").permissions(), fs::perms(0640));
}

TEST(AtomicFile, AFileThatMayNotGrowIsAnErrorAndLeavesNothing)
{
  const pcl6d::test::TempFolder folder;
  const auto writeMuch = [&] {
    const rlimit limit{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN); // as in all programs
    try {
      writeFileAtomically(folder / "file.txt",
                          [](std::ostream& s) { s << std::string(100000, 'x'); });
    } catch (const pcl6d::IoFailed& e) {
      std::fprintf(stderr, "%s\n", e.what());
      std::_Exit(1);
    }
    std::_Exit(0);
  };
  EXPECT_EXIT(writeMuch(), testing::ExitedWithCode(1), "file.txt: File too large");
  EXPECT_TRUE(namesIn(folder.path()).empty());
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
