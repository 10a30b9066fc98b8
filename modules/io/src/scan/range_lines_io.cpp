// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/angle.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/range_lines_io.h>
#include <pcl6d/io/text.h>

#include <cmath>
#include <limits>

namespace pcl6d {
namespace {
namespace fs = std::filesystem;
using Cells = std::vector<std::string_view>;
std::string_view
trimmed(std::string_view cell)
{
  const std::size_t begin = cell.find_first_not_of(" \t");
  if (begin == std::string_view::npos)
    return {};
  return cell.substr(begin, cell.find_last_not_of(" \t") - begin + 1);
}

// A cell may be empty between commas or semicolons, but not between blanks.
Cells
cellsOf(std::string_view line)
{
  Cells cells;
  const std::size_t mark = line.find_first_of(",;");
  if (mark == std::string_view::npos) {
    text::Tokens tokens(line);
    for (auto token = tokens.next(); !token.empty(); token = tokens.next())
      cells.push_back(token);
    return cells;
  }
  const char separator = line[mark];
  for (std::size_t end = 0; end != std::string_view::npos;) {
    end = line.find(separator);
    cells.push_back(trimmed(line.substr(0, end)));
    if (end != std::string_view::npos)
      line.remove_prefix(end + 1);
  }
  return cells;
}

/** \brief The rows of a table, without comments, as cells. */
class Table {
public:
  explicit Table(const fs::path& path)
  : path_(path), text_(text::readFile(path)), lines_(withoutMark(text_))
  {}

  /** \return false at the end; all rows must have the length of the first */
  bool
  next()
  {
    do {
      if (!lines_.next())
        return false;
    } while (text::isBlank(lines_.line()) || trimmed(lines_.line()).front() == '#');
    cells_ = cellsOf(lines_.line());
    if (length_ == 0)
      length_ = cells_.size();
    if (cells_.size() != length_)
      fail(text::counted(cells_.size(), "cell") + ", but the first row has " +
           std::to_string(length_));
    return true;
  }

  const Cells&
  cells() const
  {
    return cells_;
  }

  double
  number(std::size_t column) const
  {
    double value = 0;
    if (!text::parseNumber(cells_[column], value))
      fail("column " + std::to_string(column + 1) + ": " +
           text::quoted(cells_[column]) + " is not a number");
    return value;
  }

  double
  finite(std::size_t column, const char* what) const
  {
    const double value = number(column);
    if (!std::isfinite(value))
      fail(std::string("the ") + what + " is " +
           std::string(cells_[column].substr(0, 40)) + ", but must be finite");
    return value;
  }

  [[noreturn]] void
  fail(const std::string& message) const
  {
    text::failAt(path_, lines_.number(), message);
  }

private:
  static std::string_view
  withoutMark(std::string_view text)
  {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark)
      text.remove_prefix(kByteOrderMark.size());
    return text;
  }

  fs::path path_;
  std::string text_;
  text::Lines lines_;
  Cells cells_;
  std::size_t length_ = 0;
};

bool
startsWith(std::string_view cell, const std::string& word)
{
  for (std::size_t i = 0; i < word.size(); ++i)
    if (i >= cell.size() || (cell[i] | ' ') != word[i])
      return false;
  return true;
}

struct Columns {
  bool has_angle = true;
  bool has_time = false;
  std::size_t
  firstRange() const
  {
    return (has_angle ? 1u : 0u) + (has_time ? 1u : 0u);
  }
};

/** \return whether the row, the first of the file, names the columns */
bool
readNames(const Table& table, const Columns& expected, Columns& columns)
{
  double value = 0;
  const std::string_view first = table.cells().front();
  if (first.empty() || text::parseNumber(first, value))
    return false;
  const std::string word = expected.has_angle ? "angle" : "range";
  if (!startsWith(first, word))
    table.fail("the first column is " + text::quoted(first) +
               ", but must be a number "
               "or the name " +
               word);
  columns.has_time = expected.has_angle && table.cells().size() > 1 &&
                     startsWith(table.cells()[1], "time");
  return true;
}

void
addStart(const Table& table, const Columns& columns, RangeLines& lines)
{
  lines.angles.push_back(table.finite(0, "angle") * kDegree);
  if (!columns.has_time)
    return;
  const double time = table.finite(1, "time");
  if (!lines.times.empty() && !(time > lines.times.back()))
    table.fail("the time " + std::string(table.cells()[1]) +
               " does not follow the time of the row before; times must increase");
  lines.times.push_back(time);
}

double
rangeOf(const Table& table, std::size_t column, double unit)
{
  if (table.cells()[column].empty())
    return std::numeric_limits<double>::quiet_NaN();
  const double range = table.number(column) * unit;
  if (range < 0)
    table.fail("column " + std::to_string(column + 1) + ": the range is " +
               std::string(table.cells()[column]) + ", but must be >= 0");
  return range > 0 && range < kFarthestCoordinate
             ? range
             : std::numeric_limits<double>::quiet_NaN();
}

void
addRanges(const Table& table, const Columns& columns, double unit, RangeLines& lines)
{
  const std::size_t first = columns.firstRange();
  if (table.cells().size() <= first)
    table.fail("there is no range");
  lines.samples_per_line = table.cells().size() - first;
  for (std::size_t column = first; column < table.cells().size(); ++column)
    lines.ranges.push_back(rangeOf(table, column, unit));
}

/** Calls body for each row of numbers. \return their number */
template <typename Body>
std::size_t
readRows(const fs::path& path, const Columns& expected, const Body& body)
{
  Table table(path);
  Columns columns = expected;
  std::size_t rows = 0;
  for (bool is_first = true; table.next(); is_first = false) {
    if (is_first && readNames(table, expected, columns))
      continue;
    body(table, columns);
    ++rows;
  }
  if (rows == 0)
    text::fail(path, "holds no line");
  return rows;
}
} // namespace

RangeLines
readRangeLines(const fs::path& lines_file,
               const fs::path& angles_file,
               double range_unit)
{
  require(range_unit > 0 && std::isfinite(range_unit),
          "range_unit",
          range_unit,
          "> 0 and finite");
  RangeLines lines;
  const bool is_one_file = angles_file.empty();
  const std::size_t count = readRows(lines_file,
                                     {is_one_file, false},
                                     [&](const Table& table, const Columns& columns) {
                                       if (is_one_file)
                                         addStart(table, columns, lines);
                                       addRanges(table, columns, range_unit, lines);
                                     });
  if (is_one_file)
    return lines;
  readRows(angles_file, {}, [&](const Table& table, Columns columns) {
    if (table.cells().size() > 2)
      table.fail(text::counted(table.cells().size(), "cell") +
                 ", but must be an angle and at most a time");
    columns.has_time = table.cells().size() == 2;
    addStart(table, columns, lines);
  });
  if (lines.angles.size() != count)
    text::fail(angles_file,
               text::counted(lines.angles.size(), "angle") + ", but " +
                   lines_file.string() + " has " + text::counted(count, "line"));
  return lines;
}

} // namespace pcl6d
