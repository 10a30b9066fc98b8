// SPDX-License-Identifier: BSD-3-Clause
// The folder that a program writes: all or nothing, whenever it is killed.
#include "common/output/output_folder.h"
#include "support/killed_process.h"
#include "support/run_program.h"

#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {
namespace fs = std::filesystem;
using pcl6d::IoFailed;
using pcl6d::app::Journal;
using pcl6d::app::OutputFolder;
using pcl6d::app::OutputRules;
using pcl6d::test::contentOf;
using pcl6d::test::killedAtDiskCall;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;
using Content = std::map<std::string, std::string>;

/** A place for a folder, with the run of a program that leaves a.txt, b/0.txt... and its
 * marker. */
class Output : public testing::Test {
protected:
  static OutputRules
  rulesOf(const fs::path& folder)
  {
    OutputRules rules;
    rules.folder = folder;
    rules.program = "tester";
    rules.marker = "marker.json";
    rules.files = std::regex("marker\\.json|[a-z]\\.txt|b/[0-9]\\.txt");
    rules.journal = ".journal";
    return rules;
  }

  static void
  write(const OutputFolder& out, const std::string& text, int count)
  {
    writeText(out / "a.txt", text);
    for (int i = 0; i < count; ++i)
      writeText(out / ("b/" + std::to_string(i) + ".txt"), text + std::to_string(i));
    writeText(out / "marker.json",
              R"({"generator": "tester", "text": ")" + text + "\"}");
  }

  void
  publish(const std::string& text, int count, Journal journal = Journal::kDrop)
  {
    OutputFolder folder(rulesOf(out));
    write(folder, text, count);
    folder.publish(journal);
  }

  /** \return what is in the place of the folder, without what this machinery hides */
  Content
  visible() const
  {
    Content content;
    if (fs::exists(out))
      for (const auto& [name, text] : contentOf(out))
        if (name.rfind(".pcl6d", 0) != 0)
          content.emplace(name, text);
    return content;
  }

  /** \return the names beside the folder */
  std::vector<std::string>
  beside() const
  {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(place.path()))
      if (entry.path() != out)
        names.push_back(entry.path().filename());
    return names;
  }

  void
  killAtEachCall(const std::function<void()>& enter);

  const TempFolder place;
  const fs::path out = place / "out";
};

/** Old and new run have other numbers of files; a file of the user lies between them.
 * \param[in] enter called in the process that publishes */
void
Output::killAtEachCall(const std::function<void()>& enter)
{
  int points = 0, old_kept = 0, new_there = 0;
  for (bool killed = true; killed; ++points) {
    SCOPED_TRACE(points + 1);
    fs::remove_all(out);
    publish("old", 4);
    writeText(out / "b" / "mine.doc", "mine");
    fs::create_directory(out / "empty");
    writeText(out / ".journal", "j");
    const Content before = visible();
    killed = killedAtDiskCall(points + 1, [&] {
      enter();
      publish("new", 2);
    });
    { // as the next run would find it
      OutputFolder next(rulesOf(out));
      EXPECT_TRUE(next.holdsEarlierRun());
    }
    Content after = visible();
    EXPECT_EQ(after["b/mine.doc"], "mine");
    EXPECT_TRUE(fs::is_directory(out / "empty"));
    after.erase(".journal"); // may outlive what it is of
    Content old = before;
    old.erase(".journal");
    const bool is_old = after == old;
    const Content fresh{
        {"a.txt", "new"},
        {"b/0.txt", "new0"},
        {"b/1.txt", "new1"},
        {"marker.json", "{\"generator\": \"tester\", \"text\": \"new\"}"},
        {"b", ""},
        {"b/mine.doc", "mine"},
        {"empty", ""}};
    const bool is_new = after == fresh;
    EXPECT_TRUE(is_old || is_new) << testing::PrintToString(after);
    EXPECT_EQ(beside(), std::vector<std::string>());
    for (const auto& entry : fs::directory_iterator(out))
      EXPECT_NE(entry.path().filename().string().rfind(".pcl6d", 0), 0u) << entry;
    (is_new ? new_there : old_kept) += 1;
  }
  EXPECT_GT(old_kept, 10);
  EXPECT_GT(new_there, 1);
  std::printf("%d calls: the old run %d times, the new one %d times\n",
              points,
              old_kept,
              new_there);
}
} // namespace

TEST_F(Output, KilledAtAnyCallTheOldRunOrTheNewOneIsWhole)
{
  killAtEachCall([] {});
}

TEST_F(Output, TheSameWhereTheFolderCannotChangeItsName)
{
  killAtEachCall([this] { fs::current_path(out); });
}

TEST_F(Output, TheSameWhereTheFileSystemKnowsNoExchange)
{
  killAtEachCall([] {
    if (!pcl6d::test::makeUnknown(SYS_renameat2))
      throw std::runtime_error("no filter of calls");
  });
}

TEST_F(Output,
       BetweenTheCallsAReaderSeesTheOldRunOrTheNewOne) // where names are exchanged
{
  for (int n = 1;; ++n) {
    fs::remove_all(out);
    publish("old", 1);
    const Content before = visible();
    const bool killed = killedAtDiskCall(n, [&] { publish("new", 1); });
    const std::string first = visible()["a.txt"], marker = visible()["marker.json"];
    EXPECT_NE(marker.find(first), std::string::npos) << n;
    if (!killed)
      break;
  }
}

TEST_F(Output, IsNotThereIfItWasNotAndTheProgramFails)
{
  {
    const OutputFolder folder(rulesOf(out / "deep" / "er"));
    EXPECT_TRUE(fs::is_directory(out / "deep" / "er")); // held by its lock
  }
  EXPECT_FALSE(fs::exists(out));
  EXPECT_EQ(beside(), std::vector<std::string>());
}

TEST_F(Output, LeavesNothingWhereNoFileCanBeOpenedAnyMore)
{
  rlimit usual{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &usual), 0);
  {
    const OutputFolder folder(rulesOf(out));
    write(folder, "lost", 2);
    const int next = ::dup(STDERR_FILENO); // the lowest that is free
    ::close(next);
    const rlimit none{static_cast<rlim_t>(next), usual.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  }
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &usual), 0);
  EXPECT_FALSE(fs::exists(out));
  EXPECT_EQ(beside(), std::vector<std::string>());
}
TEST_F(Output, ASecondProgramIsRefusedInOneLineAndTakesNothing)
{
  OutputFolder first(rulesOf(out));
  write(first, "first", 2);
  try {
    OutputFolder second(rulesOf(out));
    FAIL() << "it was let in";
  } catch (const IoFailed& e) {
    EXPECT_EQ(std::string(e.what()),
              out.string() + ": another run is writing into this folder");
  }
  first.publish();
  EXPECT_EQ(visible().size(), 5u);
}

TEST_F(Output, ARefusedProgramDeletesNothingOfARunningOne)
{
  fs::create_directory(out);
  writeText(out / "thesis.tex", "years");
  OutputRules forced = rulesOf(out);
  forced.force = true;
  OutputFolder first(forced);
  write(first, "first", 1);
  EXPECT_THROW(OutputFolder(rulesOf(out)), IoFailed);
  EXPECT_TRUE(fs::exists(first.staging() / "marker.json"));
}

TEST_F(Output, AHiddenFolderThatIsGoneIsAnErrorAndTheOldRunStays)
{
  publish("old", 1);
  const Content before = visible();
  OutputFolder folder(rulesOf(out));
  write(folder, "new", 1);
  fs::remove_all(folder.staging());
  EXPECT_THROW(folder / "late.txt", IoFailed);
  EXPECT_THROW(folder.publish(), IoFailed);
  fs::create_directories(folder.staging()); // another one of the same name
  EXPECT_THROW(folder.publish(), IoFailed);
  EXPECT_EQ(visible(), before);
}

TEST_F(Output, AnOldFolderThatMayNotBeWrittenIsReplacedWhole)
{
  publish("old", 3);
  ::chmod((out / "b").c_str(), 0555);
  publish("new", 1);
  EXPECT_EQ(visible()["b/0.txt"], "new0");
  EXPECT_EQ(visible().count("b/2.txt"), 0u);
  EXPECT_EQ(beside(), std::vector<std::string>());
}

TEST_F(Output, ALinkToNowhereIsNamed)
{
  fs::create_directory_symlink("nowhere", out);
  try {
    publish("new", 1);
    ADD_FAILURE() << "published";
  } catch (const pcl6d::IoFailed& e) {
    EXPECT_NE(
        std::string(e.what()).find(": is a link to nowhere, which does not exist"),
        std::string::npos)
        << e.what();
  }
  EXPECT_EQ(fs::read_symlink(out), "nowhere");
  EXPECT_EQ(beside(), std::vector<std::string>());
}

TEST_F(Output, KeepsRightsJournalAndLinksOfTheFolder)
{
  fs::create_directory(place / "real");
  ::chmod((place / "real").c_str(), 0751);
  fs::create_directory_symlink(place / "real", out);
  publish("old", 1);
  writeText(out / ".journal", "kept");
  publish("new", 1, Journal::kKeep);
  EXPECT_TRUE(fs::is_symlink(out));
  EXPECT_EQ(readText(out / ".journal"), "kept");
  EXPECT_EQ(readText(out / "a.txt"), "new");
  EXPECT_EQ(fs::status(place / "real").permissions(), fs::perms(0751));
}

TEST_F(Output, NewFilesAreHiddenFromOthersUntilTheyArePublished)
{
  const OutputFolder folder(rulesOf(out));
  EXPECT_EQ(fs::status(folder.staging()).permissions(), fs::perms::owner_all);
  EXPECT_EQ(folder.staging().parent_path(), place.path());
}

TEST_F(Output, BesideItIsAFolderOfItsOwn)
{
  publish("old", 2);
  const Content before = visible();
  OutputFolder folder(rulesOf(out));
  write(folder, "part", 1);
  const auto written = folder.publishBeside(".partial");
  EXPECT_EQ(written.front(), place / "out.partial/a.txt");
  EXPECT_EQ(readText(place / "out.partial/b/0.txt"), "part0");
  EXPECT_EQ(visible(), before);
}

TEST_F(Output, HiddenFoldersThatSomebodyElsePutThereAreLeftAlone)
{
  if (::geteuid() != 0)
    GTEST_SKIP() << "only root can make files of another user";
  const fs::path planted = place / ".out.pcl6d-old-abcdef";
  fs::create_directory(planted);
  writeText(planted / "evil.sh", "rm -rf /");
  ASSERT_EQ(::chown(planted.c_str(), 65534, 65534), 0);
  const fs::path ready = place / ".out.pcl6d-ready";
  fs::create_directory(ready);
  ASSERT_EQ(::chown(ready.c_str(), 65534, 65534), 0);
  publish("new", 1);
  EXPECT_FALSE(fs::exists(out / "evil.sh"));
  EXPECT_TRUE(fs::exists(planted / "evil.sh"));
}
