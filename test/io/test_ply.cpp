// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_samples.h"

#include <pcl6d/io/scan_reader.h>

#include <pcl/console/print.h>
#include <pcl/io/ply_io.h>

#include <algorithm>

using pcl6d::readScan;
using pcl6d::test::expectIoFailed;
using pcl6d::test::TempFolder;
using pcl6d::test::valueOf;
using pcl6d::test::writeText;

namespace {

/** \brief A mesh of two vertices with double coordinates, colours, a normal and a list,
 * ahead of it an element that nobody asked for, behind it two faces. */
struct Mesh {
  static std::string
  header(const std::string& format)
  {
    return "ply\nformat " + format +
           " 1.0\ncomment made by hand\nobj_info none\n"
           "element camera 1\nproperty float f\nproperty list uchar short pixels\n"
           "element vertex 2\nproperty double x\nproperty double y\nproperty double z\n"
           "property uchar red\nproperty uchar green\nproperty uchar blue\n"
           "property float nx\nproperty list uchar int stars\nproperty ushort ring\n"
           "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  }
  static std::string
  ascii()
  {
    return header("ascii") + "3.5 2 -7 8\n"
                             "1.5 -2.25 1e3\t10 20 30 0.6 2 77 78 65535\n"
                             "4 5 6 1 2 3 0.8 0 7\n"
                             "3 0 1 1\n0\n";
  }
  static std::string
  binary(bool big_endian)
  {
    std::string body;
    const auto put = [&](auto value) {
      std::string bytes(sizeof value, '\0');
      std::memcpy(bytes.data(), &value, sizeof value);
      if (big_endian)
        std::reverse(bytes.begin(), bytes.end());
      body += bytes;
    };
    const auto list = [&](const std::vector<int>& values) {
      put(static_cast<std::uint8_t>(values.size()));
      for (const int value : values)
        put(value);
    };
    const auto vertex = [&](double x, double y, double z, std::uint8_t red, float nx) {
      put(x), put(y), put(z);
      for (const int factor : {1, 2, 3})
        put(static_cast<std::uint8_t>(red * factor));
      put(nx);
    };
    put(3.5f), put(std::uint8_t{2}), put(std::int16_t{-7}), put(std::int16_t{8});
    vertex(1.5, -2.25, 1e3, 10, 0.6f), list({77, 78}), put(std::uint16_t{65535});
    vertex(4, 5, 6, 1, 0.8f), list({}), put(std::uint16_t{7});
    list({0, 1, 1}), list({});
    return header(big_endian ? "binary_big_endian" : "binary_little_endian") + body;
  }
};

void
expectMesh(const pcl6d::Scan& scan)
{
  ASSERT_EQ(scan.points.size(), 2u);
  EXPECT_EQ(scan.points[0], Eigen::Vector3f(1.5f, -2.25f, 1000));
  EXPECT_EQ(scan.points[1], Eigen::Vector3f(4, 5, 6));
  EXPECT_EQ(scan.cloud.fields.size(), 6u);
  EXPECT_EQ(valueOf<double>(scan.cloud, 0, "z"), 1e3);
  EXPECT_EQ(valueOf<std::uint32_t>(scan.cloud, 0, "rgb"), 0x000a141eu);
  EXPECT_EQ(valueOf<float>(scan.cloud, 1, "normal_x"), 0.8f);
  EXPECT_EQ(valueOf<std::uint16_t>(scan.cloud, 0, "ring"), 65535u);
}

class BrokenPly : public testing::Test {
protected:
  void
  expectMessage(const std::string& content, const std::string& message)
  {
    writeText(path_, content);
    expectIoFailed(path_, message, [&] { readScan(path_); });
  }
  /** The same with a mesh in which a text was replaced. */
  void
  expectWith(const std::string& old_text,
             const std::string& new_text,
             const std::string& message)
  {
    std::string content = Mesh::ascii();
    content.replace(content.find(old_text), old_text.size(), new_text);
    expectMessage(content, message);
  }
  const TempFolder folder_;
  const std::filesystem::path path_ = folder_ / "scan.ply";
};

} // namespace

TEST(Ply, EveryEncodingGivesTheVerticesOfAMesh)
{
  const TempFolder folder;
  for (const auto& content : {Mesh::ascii(), Mesh::binary(false), Mesh::binary(true)}) {
    SCOPED_TRACE(content.substr(0, 30));
    writeText(folder / "scan.ply", content);
    const auto scan = readScan(folder / "scan.ply");
    expectMesh(scan);
    EXPECT_EQ(scan.left_out,
              (std::vector<std::string>{
                  "1 element 'camera'", "list 'stars'", "2 elements 'face'"}));
  }
}

TEST(Ply, ADecimalCommaElsewhereAndWindowsLineEndsChangeNothing)
{
  const TempFolder folder;
  std::string content;
  for (const char c : Mesh::ascii())
    content += c == '\n' ? std::string("\r\n") : std::string(1, c);
  writeText(folder / "scan.ply", content);
  const pcl6d::test::DecimalComma locale;
  expectMesh(readScan(folder / "scan.ply"));
}

TEST(Ply, FieldsAreThoseOfPclsReader)
{
  const TempFolder folder;
  for (const std::string alpha : {"", "property uchar alpha\n"}) {
    writeText(folder / "scan.ply",
              "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
              "property float y\nproperty float z\nproperty float nx\n"
              "property float ny\nproperty float nz\nproperty uchar red\n"
              "property uchar green\nproperty uchar blue\n" +
                  alpha +
                  "property float curvature\nproperty uint label\nend_header\n" +
                  (alpha.empty() ? "1 2 3 0 0 1 10 20 30 0.5 7\n4 5 6 1 0 0 1 2 3 4 5\n"
                                 : "1 2 3 0 0 1 10 20 30 255 0.5 7\n"
                                   "4 5 6 1 0 0 1 2 3 4 5 6\n"));
    pcl::PCLPointCloud2 expected;
    const auto level = pcl::console::getVerbosityLevel();
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
    ASSERT_EQ(pcl::io::loadPLYFile((folder / "scan.ply").string(), expected), 0);
    pcl::console::setVerbosityLevel(level);
    const auto cloud = readScan(folder / "scan.ply").cloud;
    pcl6d::test::expectSameFields(expected, cloud);
    EXPECT_EQ(cloud.data, expected.data);
  }
}

TEST_F(BrokenPly, HeadersAreChecked)
{
  expectMessage("", "the header ends without end_header");
  expectMessage("solid\n", "line 1: expected 'ply', got 'solid'");
  expectMessage("ply\nend_header\n", "the header has no format");
  expectWith("end_header\n", "", "line 20: '3.5' is not an entry of a PLY header");
  expectWith("format ascii", "format ebcdic", "line 2: format 'ebcdic' is not known");
  expectWith("1.0", "2.0", "line 2: version '2.0' is not known, must be 1.0");
  expectWith("vertex 2", "vertex two", "line 8: 'two' is not a number of elements");
  expectWith("vertex 2", "vertex -2", "line 8: '-2' is not a number of elements");
  expectWith("vertex 2", "face 2", "line 18: a second element 'face'");
  expectWith("double x", "decimal x", "line 9: type 'decimal' is not known");
  expectWith("double x", "double", "line 9: a property without a name");
  expectWith("list uchar int stars",
             "list float int stars",
             "line 16: the length of a list must have an integer type");
  expectWith("element camera 1\n", "", "line 5: a property ahead of the first element");
}

TEST_F(BrokenPly, FilesWithoutCoordinatesAreRefused)
{
  expectWith(
      "element vertex", "element corner", "PLY file without an element 'vertex'");
  expectMessage("ply\nformat ascii 1.0\nelement vertex 1\nend_header\n1 2 3\n",
                "vertices without properties");
  expectWith("double z", "double depth", "has no field 'z'");
  expectWith("double y",
             "int y",
             "line 22: '-2.25' is not a number that property 'y' "
             "can hold");
}

TEST_F(BrokenPly, TextBodiesAreCheckedLineByLine)
{
  expectWith("4 5 6 1",
             "4 abc 6 1",
             "line 23: 'abc' is not a number that property 'y' "
             "can hold");
  expectWith("20 30",
             "20 300",
             "line 22: '300' is not a number that property 'blue' can "
             "hold");
  expectWith("0.8 0 7\n", "0.8 0\n", "line 23: vertex 2 of 2 has no ring");
  expectWith("0.8 0 7\n", "0.8 1 7\n", "line 23: vertex 2 of 2 has no ring");
  expectWith(
      "0.8 0 7\n", "0.8 0 7 8\n", "line 23: '8' is more than the element's properties");
  expectWith("3 0 1 1\n0\n", "3 0 1 1\n", "the file ends ahead of face 2 of 2");
  expectWith("3 0 1 1\n0\n",
             "3 0 1 1\n0\n\n1 1\n",
             "line 27: more elements than the header declares");
  expectWith(
      "vertex 2", "vertex 4000000000", "line 24: vertex 3 of 4000000000 has no green");
}

TEST_F(BrokenPly, NegativeAndHugeListsAreRefused)
{
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
      "property list int double a\nproperty float x\nend_header\n";
  expectMessage(header + pcl6d::test::bytesOf<int>({-1, 0}),
                "vertex 1 of 1: list 'a' has length -1");
  expectMessage(header + pcl6d::test::bytesOf<int>({0x7fffffff, 0}),
                "the file ends inside vertex 1 of 1");
}

TEST_F(BrokenPly, AFileCutAnywhereIsRefused)
{
  for (const auto& content : {Mesh::ascii(), Mesh::binary(false), Mesh::binary(true)})
    for (std::size_t size = 0; size < content.size(); ++size) {
      // Only the end of the last line may be missing from a text.
      if (content[content.size() - 1] == '\n' && size + 1 == content.size())
        continue;
      pcl6d::test::replaceText(path_, content.substr(0, size));
      const std::string message =
          pcl6d::test::messageOf<pcl6d::IoFailed>([&] { readScan(path_); });
      EXPECT_EQ(message.rfind(path_.string() + ": ", 0), 0u)
          << "cut to " << size << " of " << content.size() << " bytes: " << message;
    }
}
