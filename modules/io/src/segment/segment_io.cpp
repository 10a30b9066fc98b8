// SPDX-License-Identifier: BSD-3-Clause
#include "segment/segment_formats.h"

#include <pcl6d/common/require.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/segment_io.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace pcl6d {

using namespace io;

namespace {
std::string
lowered(std::string text)
{
  for (char& c : text)
    if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
  return text;
}

Segments
readUnscaled(const std::filesystem::path& path)
{
  const std::string extension = lowered(path.extension().string());
  const auto reader = extension == ".csv"       ? segmentsOfCsv
                      : extension == ".geojson" ? segmentsOfGeoJson
                      : extension == ".svg"     ? segmentsOfSvg
                                                : nullptr;
  if (!reader)
    text::fail(path,
               "a plan must be a file .csv, .geojson or .svg, not " +
                   text::quoted(extension));
  return reader(text::readFile(path), path);
}

bool
isNumber(std::string_view token)
{
  double value = 0;
  return text::parseNumber(token, value);
}
} // namespace

void
io::appendLine(const std::vector<Eigen::Vector2d>& line,
               bool closed,
               Segments& segments)
{
  for (std::size_t i = 1; i < line.size(); ++i)
    segments.push_back({line[i - 1], line[i]});
  if (closed && line.size() > 2)
    segments.push_back({line.back(), line.front()});
}

Segments
io::segmentsOfCsv(const std::string& content, const std::filesystem::path& path)
{
  Segments segments;
  bool may_be_header = true;
  for (text::Lines lines(content); lines.next();) {
    text::Tokens tokens(lines.line(), ",;");
    std::vector<std::string_view> row;
    for (auto token = tokens.next(); !token.empty(); token = tokens.next())
      row.push_back(token);
    if (row.empty() || row.front().front() == '#')
      continue;
    const bool is_header =
        may_be_header && std::none_of(row.begin(), row.end(), isNumber);
    may_be_header = false;
    if (is_header)
      continue;
    if (row.size() != 4)
      text::failAt(path,
                   lines.number(),
                   "expected 4 numbers x1,y1,x2,y2, got " + std::to_string(row.size()));
    double v[4];
    for (std::size_t i = 0; i < 4; ++i)
      if (!text::parseNumber(row[i], v[i]) || !std::isfinite(v[i]))
        text::failAt(path,
                     lines.number(),
                     text::quoted(row[i]) + ", but must be a finite number");
    segments.push_back({{v[0], v[1]}, {v[2], v[3]}});
  }
  return segments;
}

Segments
readSegments(const std::filesystem::path& path, const SegmentOptions& options)
{
  require(std::isfinite(options.scale) && options.scale > 0,
          "scale",
          options.scale,
          "finite and > 0");
  Segments segments = readUnscaled(path);
  for (auto& segment : segments) {
    segment.a *= options.scale;
    segment.b *= options.scale;
    if (!segment.a.allFinite() || !segment.b.allFinite()) // overflow by sum or scale
      text::fail(path, "holds coordinates too large for a number");
  }
  segments.erase(std::remove_if(segments.begin(),
                                segments.end(),
                                [](const Segment& s) { return s.a == s.b; }),
                 segments.end());
  if (segments.empty())
    text::fail(path, "holds no line segment");
  return segments;
}

void
writeSegments(const std::filesystem::path& path, const Segments& segments)
{
  std::string rows = "x1,y1,x2,y2\n";
  for (const auto& s : segments) {
    const double values[] = {s.a.x(), s.a.y(), s.b.x(), s.b.y()};
    for (std::size_t i = 0; i < 4; ++i) {
      text::appendNumber(rows, values[i]);
      rows += i < 3 ? ',' : '\n';
    }
  }
  writeFileAtomically(path, [&](std::ostream& stream) { stream << rows; });
}

} // namespace pcl6d
