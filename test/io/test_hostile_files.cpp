// SPDX-License-Identifier: BSD-3-Clause
// Files that were made to hurt: what is no file, what is nested without end, what claims to
// be huge. Each must end at once, in words.
#include "io_test.h"
#include "support/sanitizer.h"

#include <pcl6d/io/json_object.h>
#include <pcl6d/io/mesh_io.h>
#include <pcl6d/io/nesting.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/segment_io.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>

#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>

namespace {
namespace fs = std::filesystem;
using pcl6d::IoFailed;
using pcl6d::test::expectIoFailed;
using pcl6d::test::messageOf;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

constexpr int kDepths[] = {20000, 1000000};

std::string
repeated(const std::string& text, int count)
{
  std::string all;
  for (int i = 0; i < count; ++i)
    all += text;
  return all;
}

/** \return [bytes] the most that the process has held so far */
std::size_t
peakMemory()
{
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) << 10;
}

class HostileFiles : public testing::Test {
protected:
  /** Expects one short line of words that name the file. */
  template <typename Read>
  void
  expectRefused(const std::string& name,
                const std::string& content,
                const std::string& words,
                const Read& read)
  {
    const fs::path file = folder / name;
    writeText(file, content);
    const std::size_t before = peakMemory();
    const std::string message = messageOf<IoFailed>([&] { read(file); });
    EXPECT_NE(message.find(file.string()), std::string::npos) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_LT(message.size(), 300u);
    if (!pcl6d::test::isUnderAddressSanitizer()) { // which keeps freed memory
      EXPECT_LT(peakMemory() - before, 100u << 20);
    }
  }

  const TempFolder folder;
};
} // namespace

TEST_F(HostileFiles, WhatIsNoFileIsRefusedBeforeAnybodyWaits)
{
  ASSERT_EQ(::mkfifo((folder / "pipe.xyz").c_str(), 0600), 0);
  const int file = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string socket = folder / "socket.xyz";
  socket.copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(file, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ::close(file);
  fs::create_symlink("/dev/zero", folder / "device.xyz");
  fs::create_symlink("nowhere", folder / "link.xyz");
  fs::create_symlink("self.xyz", folder / "self.xyz");
  for (const auto& [name, words] :
       {std::pair("pipe", "is a pipe, but must be a file"),
        std::pair("socket", "is a socket, but must be a file"),
        std::pair("device", "is a device, but must be a file"),
        std::pair("link", "is a link to 'nowhere', which is not there"),
        std::pair("self",
                  "is a link to 'self.xyz', Too many levels of symbolic links")}) {
    const fs::path path = folder / (name + std::string(".xyz"));
    expectIoFailed(path, words, [&] { pcl6d::readScan(path); });
    expectIoFailed(path, words, [&] { pcl6d::readTrajectory(path); });
    expectIoFailed(path, words, [&] { pcl6d::text::readFile(path); });
  }
}

TEST_F(HostileFiles, PosesThatALinkPromisesAreMissed)
{
  writeText(folder / "scan000.xyz", "0 0 0\n");
  for (const char* const name : {"odometry.txt", "poses.txt", "scan000.pose"}) {
    fs::create_symlink("nowhere", folder / name);
    expectIoFailed(folder / name, "is a link to 'nowhere', which is not there", [&] {
      pcl6d::ScanFolder scans(folder.path());
    });
    fs::remove(folder / name);
  }
  EXPECT_FALSE(pcl6d::ScanFolder(folder.path()).hasPoses());
}

TEST_F(HostileFiles, JsonIsNotReadDeeperThanAnybodyWritesIt)
{
  for (const int depth : kDepths) {
    const auto read = [](const fs::path& file) { pcl6d::readJson(file); };
    expectRefused("a.json", repeated("[", depth), "nested more than 200 deep", read);
    expectRefused(
        "b.json", repeated("{\"a\":", depth), "nested more than 200 deep", read);
    expectRefused("c.json",
                  repeated("[", depth) + repeated("]", depth),
                  "line 1: nested more than 200 deep",
                  read);
  }
  const auto nested = [](int depth) {
    return repeated("[", depth) + "\"[[[[\\\"[\" /* [[[ */" + repeated("]", depth);
  };
  EXPECT_TRUE(pcl6d::parseJson(nested(200), "x").isArray());
  EXPECT_THROW(pcl6d::parseJson(nested(201), "x"), IoFailed);
}

TEST_F(HostileFiles, PlansAreNotReadDeeperThanAnybodyDrawsThem)
{
  const auto read = [](const fs::path& file) { pcl6d::readSegments(file); };
  for (const int depth : kDepths) {
    expectRefused("a.svg", "<svg>" + repeated("<g>", depth), "nested more than", read);
    expectRefused("a.geojson",
                  repeated("{\"type\":\"GeometryCollection\",\"geometries\":[", depth),
                  "nested more than",
                  read);
  }
}

TEST_F(HostileFiles, YamlIsLookedAtBeforeItsParserIsCalled)
{
  for (const int depth : kDepths)
    for (const std::string level : {"[", "{a: ", "- "})
      EXPECT_NE(messageOf<IoFailed>([&] {
                  pcl6d::checkYamlNesting("%YAML:1.0\na: " + repeated(level, depth),
                                          "y");
                }).find("y: line 2: nested more than 200 deep"),
                std::string::npos)
          << level;
  std::string steps = "%YAML:1.0\n";
  for (int i = 0; i < 300; ++i)
    steps += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  EXPECT_THROW(pcl6d::checkYamlNesting(steps, "y"), IoFailed);
  EXPECT_NO_THROW(pcl6d::checkYamlNesting("%YAML:1.0\n---\nm: !!opencv-matrix\n   "
                                          "rows: 3\n   data: [ 1., 2.,\n       3. ]\n",
                                          "y"));
}

TEST_F(HostileFiles, YamlThatItsParserWouldNeverLeaveIsRefused)
{
  for (const std::string text : {"---\n - a: b\n1---\n", // OpenCV 4.6 loops for ever
                                 "a: 1\n...-\n",
                                 "a: 1\n...\nb: 1\n"})
    EXPECT_NE(messageOf<IoFailed>([&] {
                pcl6d::checkYamlNesting("%YAML:1.0\n" + text, "y");
              }).find("no YAML that OpenCV reads"),
              std::string::npos)
        << text;
  EXPECT_NO_THROW(
      pcl6d::checkYamlNesting("%YAML:1.0\n---\na: 1\n...\n---\nb: [ 1 ]\n", "y"));
}

TEST_F(HostileFiles, AMeshThatClaimsToBeHugeTakesNoMemory)
{
  const auto read = [](const fs::path& file) { pcl6d::readMesh(file); };
  for (const char* const format :
       {"ascii", "binary_little_endian", "binary_big_endian"})
    for (const char* const count :
         {"1000000000", "2147483648", "4294967296", "9223372036854775807"}) {
      SCOPED_TRACE(std::string(format) + ' ' + count);
      const std::string head = std::string("ply\nformat ") + format + " 1.0\n";
      const std::string vertex =
          "property float x\nproperty float y\nproperty float z\n";
      const std::string face = "property list uchar int vertex_indices\nend_header\n";
      expectRefused("a.ply",
                    head + "element vertex " + count + '\n' + vertex +
                        "element face 1\n" + face + "0 0 0\n",
                    "",
                    read);
      expectRefused("b.ply",
                    head + "element vertex 0\n" + vertex + "element face " + count +
                        '\n' + face,
                    "",
                    read);
    }
}

TEST_F(HostileFiles, AFaceThatClaimsToHaveManyCornersTakesNoMemory)
{
  std::string mesh =
      "ply\nformat binary_little_endian 1.0\nelement vertex 0\n"
      "property float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uint int vertex_indices\nend_header\n";
  mesh += std::string(4, '\xff') + "abcd";
  expectRefused("a.ply", mesh, "", [](const fs::path& file) { pcl6d::readMesh(file); });
}

TEST_F(HostileFiles, TokensAreQuotedShort)
{
  const std::string word(100000, 'x');
  expectRefused("a.xyz", "0 0 " + word + "\n", "...'", [](const fs::path& file) {
    pcl6d::readScan(file);
  });
  expectRefused("a.obj",
                "v 0 0 \x1b[31m" + word + "\n",
                "?[31m",
                [](const fs::path& file) { pcl6d::readMesh(file); });
}
