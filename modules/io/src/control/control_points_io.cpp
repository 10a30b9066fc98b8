// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/control_points_io.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

namespace pcl6d {

namespace {
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

std::string
trimmed(std::string_view text)
{
  const std::size_t begin = text.find_first_not_of(" \t\"");
  if (begin == std::string_view::npos)
    return "";
  return std::string(text.substr(begin, text.find_last_not_of(" \t\"") + 1 - begin));
}

/** \return the separator of a line: the first candidate found; a blank by default */
char
separatorOf(std::string_view line)
{
  for (const char one : {';', '\t', ','})
    if (line.find(one) != std::string_view::npos)
      return one;
  return ' ';
}

/** A line of a table. */
struct PointRow {
  std::size_t line = 0;
  bool has_decimal_commas = false;
  std::vector<std::string> cells;
};

PointRow
pointRowOf(const text::Lines& lines)
{
  PointRow row;
  row.line = lines.number();
  const char separator = separatorOf(lines.line());
  row.has_decimal_commas = separator == ';' || separator == '\t';
  if (separator == ' ') {
    text::Tokens tokens(lines.line());
    for (auto token = tokens.next(); !token.empty(); token = tokens.next())
      row.cells.emplace_back(token);
    return row;
  }
  std::string_view rest = lines.line();
  while (true) {
    const std::size_t end = rest.find(separator);
    row.cells.push_back(trimmed(rest.substr(0, end)));
    if (end == std::string_view::npos)
      break;
    rest.remove_prefix(end + 1);
  }
  while (!row.cells.empty() && row.cells.back().empty())
    row.cells.pop_back(); // a separator at the end of the line
  return row;
}

bool
parseCell(const PointRow& row, std::size_t column, double& value)
{
  std::string cell = row.cells[column];
  if (row.has_decimal_commas)
    std::replace(cell.begin(), cell.end(), ',', '.');
  return text::parseNumber(std::string_view(cell), value) && std::isfinite(value);
}

double
numberIn(const std::filesystem::path& path, const PointRow& row, std::size_t column)
{
  double value = 0;
  if (!parseCell(row, column, value))
    text::failAt(path,
                 row.line,
                 "expected a finite number, got " + text::quoted(row.cells[column]));
  return value;
}

Eigen::Vector3d
positionIn(const std::filesystem::path& path, const PointRow& row, std::size_t first)
{
  return {numberIn(path, row, first),
          numberIn(path, row, first + 1),
          numberIn(path, row, first + 2)};
}

/** \param[in] first column with a number
 * \return whether a line holds the names of the columns */
bool
isHeading(const PointRow& row, std::size_t first)
{
  double value = 0;
  for (std::size_t column = first; column < row.cells.size(); ++column)
    if (parseCell(row, column, value))
      return false;
  return true;
}

/** \param[in] first column with a number \param[in] columns least and most
 * \param[in] what names of the columns, for the message */
std::vector<PointRow>
rowsOf(const std::filesystem::path& path,
       std::size_t first,
       std::pair<std::size_t, std::size_t> columns,
       const std::string& what)
{
  std::string content = text::readFile(path);
  if (content.compare(0, kByteOrderMark.size(), kByteOrderMark) == 0)
    content.erase(0, kByteOrderMark.size());
  std::vector<PointRow> rows;
  bool is_first = true;
  for (text::Lines lines(content); lines.next();) {
    if (text::isBlank(lines.line()) || lines.line().front() == '#')
      continue;
    PointRow row = pointRowOf(lines);
    if (std::exchange(is_first, false) && isHeading(row, first))
      continue;
    if (row.cells.size() < columns.first || row.cells.size() > columns.second)
      text::failAt(path,
                   row.line,
                   "expected " + what + ", got " +
                       text::counted(row.cells.size(), "column"));
    if (row.cells[0].empty())
      text::failAt(path, row.line, "the name is empty");
    rows.push_back(std::move(row));
  }
  if (rows.empty())
    text::fail(path, "has no points; expected lines of " + what);
  return rows;
}

/** \return "scan000.pcd, scan001.pcd, ..." */
std::string
someOf(const std::vector<std::string>& names)
{
  constexpr std::size_t kMost = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, names.size()); ++i)
    text += (i > 0 ? ", " : "") + names[i];
  return text + (names.size() > kMost ? ", ..." : "");
}

std::size_t
scanOf(const std::string& word,
       const std::vector<std::string>& scans,
       const std::vector<int>& numbers)
{
  const auto stem = [](const std::string& name) {
    return std::filesystem::path(name).stem().string();
  };
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (scans[i] == word)
      return i;
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (stem(scans[i]) == word)
      return i;
  int number = 0;
  if (text::parseNumber(std::string_view(word), number))
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (numbers[i] == number)
        return i;
  return scans.size();
}
} // namespace

std::vector<ControlPoint>
readControlPoints(const std::filesystem::path& path)
{
  std::vector<ControlPoint> points;
  std::map<std::string, std::size_t> lines;
  for (const PointRow& row : rowsOf(path, 1, {4, 5}, "name x y z [sigma]")) {
    ControlPoint point;
    point.name = row.cells[0];
    point.position = positionIn(path, row, 1);
    if (row.cells.size() > 4) {
      point.sigma = numberIn(path, row, 4);
      if (*point.sigma <= 0)
        text::failAt(path, row.line, "sigma = " + row.cells[4] + ", but must be > 0");
    }
    const auto [known, is_new] = lines.emplace(point.name, row.line);
    if (!is_new)
      text::failAt(path,
                   row.line,
                   "control point " + text::quoted(point.name) +
                       " is already given in line " + std::to_string(known->second));
    points.push_back(std::move(point));
  }
  return points;
}

std::vector<ScanTarget>
readScanTargets(const std::filesystem::path& path,
                const std::vector<std::string>& scans,
                const std::vector<int>& numbers)
{
  std::vector<ScanTarget> targets;
  std::map<std::pair<std::string, std::size_t>, std::size_t> lines;
  for (const PointRow& row : rowsOf(path, 2, {5, 5}, "name scan x y z")) {
    ScanTarget target;
    target.name = row.cells[0];
    target.scan = scanOf(row.cells[1], scans, numbers);
    if (target.scan == scans.size())
      text::failAt(path,
                   row.line,
                   "there is no scan " + text::quoted(row.cells[1]) +
                       " (scans: " + someOf(scans) + ")");
    target.position = positionIn(path, row, 2);
    const auto [known, is_new] =
        lines.emplace(std::make_pair(target.name, target.scan), row.line);
    if (!is_new)
      text::failAt(path,
                   row.line,
                   "target " + text::quoted(target.name) + " of scan " +
                       text::quoted(row.cells[1]) + " is already given in line " +
                       std::to_string(known->second));
    targets.push_back(std::move(target));
  }
  return targets;
}

} // namespace pcl6d
