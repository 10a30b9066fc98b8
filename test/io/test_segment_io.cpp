// SPDX-License-Identifier: BSD-3-Clause
#include "io/io_test.h"

#include <pcl6d/io/segment_io.h>

#include <string>

using pcl6d::readSegments;
using pcl6d::Segments;
using pcl6d::test::expectIoFailed;
using pcl6d::test::messageOf;
using pcl6d::test::replaceText;
using pcl6d::test::TempFolder;

namespace {
class SegmentFiles : public testing::Test {
protected:
  std::string
  write(const std::string& name, const std::string& content)
  {
    const auto path = folder / name;
    replaceText(path, content);
    return path;
  }

  /** Expects that a file is refused, and that the message holds the words. */
  void
  expectRefused(const std::string& name,
                const std::string& content,
                const std::vector<std::string>& words)
  {
    const std::string path = write(name, content);
    const std::string message = messageOf<pcl6d::IoFailed>([&] { readSegments(path); });
    EXPECT_EQ(message.rfind(path + ": ", 0), 0u) << message;
    for (const auto& word : words)
      EXPECT_NE(message.find(word), std::string::npos) << word << " in: " << message;
  }

  TempFolder folder;
};

std::string
describe(const Segments& segments)
{
  std::ostringstream text;
  for (const auto& s : segments)
    text << s.a.x() << ',' << s.a.y() << '-' << s.b.x() << ',' << s.b.y() << ' ';
  return text.str();
}

std::string
svg(const std::string& body)
{
  return "<?xml version=\"1.0\"?>\n<!-- a plan -->\n<svg "
         "xmlns=\"http://www.w3.org/2000/svg\">\n" +
         body + "\n</svg>\n";
}

std::string
geometry(const std::string& type, const std::string& coordinates)
{
  return R"({"type": ")" + type + R"(", "coordinates": )" + coordinates + "}";
}
} // namespace

TEST_F(SegmentFiles, CsvMayHaveAHeaderAndComments)
{
  const std::string expected = "0,0-5,0 5,0-5,2.5 ";
  EXPECT_EQ(describe(readSegments(write("a.csv", "0,0,5,0\n5,0,5,2.5\n"))), expected);
  EXPECT_EQ(describe(readSegments(
                write("a.CSV", "x1,y1,x2,y2\r\n# walls\n0, 0, 5, 0\n\n5;0;5;2.5"))),
            expected);
}

TEST_F(SegmentFiles, CsvNamesLineAndValue)
{
  expectIoFailed(folder / "a.csv", "line 2: 'nan', but must be a finite number", [&] {
    readSegments(write("a.csv", "1,2,3,4\n1,2,nan,4\n"));
  });
  expectRefused("a.csv", "1,2,3,4\n1,2,3\n", {"line 2", "got 3"});
  expectRefused("a.csv", "x1,y1,x2,y2\nx1,y1,x2,y2\n", {"line 2", "'x1'"});
  expectRefused("a.csv", "1,2,3,four\n", {"line 1", "'four'"});
}

TEST_F(SegmentFiles, SegmentsWithoutLengthAreLeftOut)
{
  EXPECT_EQ(readSegments(write("a.csv", "1,1,1,1\n1,1,2,1\n")).size(), 1u);
}

TEST_F(SegmentFiles, APlanWithoutSegmentsIsRefused)
{
  for (const auto& [name, content] :
       {std::pair<std::string, std::string>("a.csv", ""),
        {"a.csv", "x1,y1,x2,y2\n"},
        {"a.csv", "1,1,1,1\n"},
        {"a.geojson", R"({"type": "FeatureCollection", "features": []})"},
        {"a.geojson", geometry("Point", "[1, 2]")},
        {"a.svg", svg("<text>walls</text>")}})
    expectRefused(name, content, {"holds no line segment"});
  expectRefused("a.dxf", "0", {".csv", ".geojson", ".svg", ".dxf"});
  EXPECT_NE(messageOf<pcl6d::IoFailed>([&] { readSegments(folder / "no.csv"); }),
            "no error");
}

TEST_F(SegmentFiles, ScaleTurnsUnitsIntoMetres)
{
  const auto path = write("a.csv", "0,0,500,20\n");
  EXPECT_EQ(describe(readSegments(path, {0.01})), "0,0-5,0.2 ");
  for (const double scale : {0.0, -1.0, std::nan("")})
    EXPECT_THROW(readSegments(path, {scale}), pcl6d::BadArgument);
}

TEST_F(SegmentFiles, GeoJsonReadsAllLinesAndRings)
{
  const std::string ring = "[[0,0],[4,0],[4,3],[0,0]]";
  const std::string sides = "0,0-4,0 4,0-4,3 4,3-0,0 ";
  for (const auto& [json, expected] : std::vector<std::pair<std::string, std::string>>{
           {geometry("LineString", "[[0,0,7],[4,0,7],[4,3,7]]"), "0,0-4,0 4,0-4,3 "},
           {geometry("MultiLineString", "[[[0,0],[1,0]],[[2,0],[3,0]]]"),
            "0,0-1,0 2,0-3,0 "},
           {geometry("Polygon", "[" + ring + "," + ring + "]"), sides + sides},
           {geometry("MultiPolygon", "[[" + ring + "],[" + ring + "]]"),
            sides + sides}}) {
    EXPECT_EQ(describe(readSegments(write("a.geojson", json))), expected);
    const std::string feature = R"({"type": "Feature", "geometry": )" + json + "}";
    EXPECT_EQ(describe(readSegments(write("a.geojson", feature))), expected);
    const std::string collection =
        R"({"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": null},)" +
        feature + "]}";
    EXPECT_EQ(describe(readSegments(write("a.geojson", collection))), expected);
    EXPECT_EQ(describe(readSegments(write(
                  "a.geojson",
                  R"({"type": "GeometryCollection", "geometries": [)" + json + "]}"))),
              expected);
  }
}

TEST_F(SegmentFiles, GeoJsonRefusesDegrees)
{
  const std::string campus = "[[8.04421,52.28213],[8.04455,52.28207]]";
  expectRefused("a.geojson", geometry("LineString", campus), {"degrees", "planar"});
  const auto with = [](const std::string& crs, const std::string& coordinates) {
    return R"({"type": "LineString", "crs": {"type": "name", "properties": {"name": ")" +
           crs + R"("}}, "coordinates": )" + coordinates + "}";
  };
  expectRefused("a.geojson",
                with("urn:ogc:def:crs:OGC:1.3:CRS84", "[[8,52],[9,53]]"),
                {"degrees"});
  // The same numbers are metres if the file says so, or coarse, or too large.
  for (const std::string& json :
       {with("urn:ogc:def:crs:EPSG::25832", campus),
        geometry("LineString", "[[8.044,52.282],[8.045,52.282]]"),
        geometry("LineString", "[[434812.34219,5792541.17],[434813,5792541]]")})
    EXPECT_EQ(readSegments(write("a.geojson", json)).size(), 1u) << json;
}

TEST_F(SegmentFiles, GeoJsonNamesWhatIsBroken)
{
  expectRefused("a.geojson", "{\"type\": ", {"line 1: not the syntax of JSON"});
  expectRefused("a.geojson", "{}", {"type"});
  expectRefused("a.geojson", geometry("Circle", "[]"), {"'Circle'"});
  expectRefused("a.geojson",
                R"({"type": "FeatureCollection", "features": [{"type": "Feature",)"
                R"("geometry": null}, {"type": "Feature", "geometry": )" +
                    geometry("LineString", R"([[0, "north"]])") + "}]}",
                {"/features/1/geometry/coordinates/0: ", "number"});
  expectRefused("a.geojson",
                geometry("LineString", "[[0]]"),
                {"/coordinates/0: [0]", "two numbers"});
  expectRefused("a.geojson",
                geometry("LineString", "[[0,NaN],[1,1]]"),
                {"line 1: not the syntax of JSON"});
}

TEST_F(SegmentFiles, SvgReadsPathsAndTurnsYUp)
{
  const auto path = [&](const std::string& data) {
    return describe(
        readSegments(write("a.svg", svg("<g><path d=\"" + data + "\"/></g>"))));
  };
  const std::string square = "0,0-4,0 4,0-4,-3 4,-3-0,-3 0,-3-0,0 ";
  EXPECT_EQ(path("M0 0 L4 0 L4 3 L0 3 Z"), square);
  EXPECT_EQ(path("m0,0 4,0 0,3-4,0z"), square) << "further pairs of m are lines";
  EXPECT_EQ(path("M 0 0 H 4 V 3 H 0 Z"), square);
  EXPECT_EQ(path("M0 0h+4v3h-4z"), square);
  EXPECT_EQ(path("M1,1L2,1zm5 0l1 0"), "1,-1-2,-1 2,-1-1,-1 6,-1-7,-1 ")
      << "after z the path goes on from its start";
  EXPECT_EQ(path("M.5.5L1.5.5"), "0.5,-0.5-1.5,-0.5 ");
}

TEST_F(SegmentFiles, SvgReadsTheOtherShapes)
{
  EXPECT_EQ(describe(readSegments(
                write("a.svg",
                      svg("<defs><line x2='9'/></defs>"
                          "<svg:line xmlns:svg='x' x1='1' y1='2' x2='3' y2='4'/>"
                          "<polyline points='0,0 1,0 1,1'/>"
                          "<g><g><polygon points='0 0 1 0 1 1'/></g></g>"
                          "<rect x='1' y='1' width='2' height='1'/>")))),
            "1,-2-3,-4 0,0-1,0 1,0-1,-1 0,0-1,0 1,0-1,-1 1,-1-0,0 "
            "1,-1-3,-1 3,-1-3,-2 3,-2-1,-2 1,-2-1,-1 ");
}

TEST_F(SegmentFiles, SvgNamesWhatIsBroken)
{
  expectRefused("a.svg", "<svg><path></svg>", {"line"});
  expectRefused("a.svg", "<html/>", {"svg"});
  expectRefused("a.svg",
                svg("<path id='roof' d='M0 0 C 1 1 2 2 3 3'/>"),
                {"path", "'roof'", "command C"});
  expectRefused("a.svg", svg("<path d='L1 1'/>"), {"begin with M"});
  expectRefused("a.svg", svg("<path d='1 1'/>"), {"begin with M"});
  expectRefused("a.svg", svg("<path d='M0 0 L1'/>"), {"finite number"});
  expectRefused("a.svg", svg("<path d='M0 0 L1 1e999'/>"), {"finite number"});
  expectRefused("a.svg", svg("<path d='M0 0 L1 1 Z 5 5'/>"), {"after Z"});
  expectRefused("a.svg", svg("<circle r='2'/>"), {"circle"});
  expectRefused("a.svg", svg("<rect width='2cm' height='1'/>"), {"width", "'2cm'"});
  expectRefused("a.svg",
                svg("<g transform='scale(2)'><path d='M0 0L1 1'/></g>"),
                {"element g", "transform"});
}

TEST_F(SegmentFiles, SumsThatNoNumberHoldsAreRefused)
{
  expectRefused(
      "a.svg", svg("<rect x='0' y='1e308' width='1' height='1e308'/>"), {"too large"});
  const auto path = write("a.csv", "0,0,1e300,1\n");
  EXPECT_THROW(readSegments(path, {1e10}), pcl6d::IoFailed);
}

TEST_F(SegmentFiles, WhatIsWrittenReadsBackToTheSameBits)
{
  const Segments segments{{{1.0 / 3, 5792541.123456789}, {-1e-17, 2}},
                          {{0, 0}, {1, 0}}};
  pcl6d::writeSegments(folder / "a.csv", segments);
  const Segments read = readSegments(folder / "a.csv");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].a, segments[0].a);
  EXPECT_EQ(read[0].b, segments[0].b);
}
