// SPDX-License-Identifier: BSD-3-Clause
#include "scan/table/table_head.h"

#include <algorithm>
#include <array>

namespace pcl6d::io {

namespace {
/** \return the line behind the signs of a remark */
std::string_view
withoutMarks(std::string_view line)
{
  const std::size_t begin = line.find_first_not_of(" \t");
  line.remove_prefix(std::min(begin, line.size()));
  while (!line.empty() && (line.front() == '#' || line.front() == '/'))
    line.remove_prefix(1);
  return line;
}

/** \return whether the first cell is text, the sign of a heading */
bool
beginsWithText(std::string_view line)
{
  std::string_view cell = cellsOf(line, separatorOf(line)).front();
  double value = 0;
  cell = cell.substr(0, cell.find(',')); // a decimal comma
  return !cell.empty() && !text::parseNumber(cell, value) &&
         !text::parseNumber(cell.substr(0, cell.find_first_of(" \t")), value);
}

/** \return the columns of a row of PTS without a heading, by their number */
std::vector<TableValue>
ptsColumns(std::size_t cells)
{
  using Value = TableValue;
  std::vector<Value> columns = {Value::kX, Value::kY, Value::kZ};
  if (cells == 4 || cells >= 7)
    columns.push_back(Value::kIntensity);
  if (cells >= 6)
    columns.insert(columns.end(), {Value::kRed, Value::kGreen, Value::kBlue});
  return columns;
}
} // namespace

std::optional<std::uint32_t>
countOf(std::string_view line)
{
  text::Tokens tokens(line);
  std::uint32_t count = 0;
  if (!text::parseNumber(tokens.next(), count) || !tokens.next().empty())
    return std::nullopt;
  return count;
}

bool
isRemark(std::string_view line)
{
  const std::size_t begin = line.find_first_not_of(" \t");
  return begin != std::string_view::npos &&
         (line[begin] == '#' || line.substr(begin, 2) == "//");
}

TableHead::TableHead(const std::vector<std::string>& columns, bool is_pts)
: is_pts_(is_pts)
{
  if (!columns.empty())
    given_ = tableColumns(columns);
}

bool
TableHead::takes(const TableLine& line)
{
  const std::string_view words = withoutMarks(line.text);
  if (text::isBlank(words))
    return true;
  if (isRemark(line.text)) { // a heading only if x, y and z are named
    const auto cells = cellsOf(words, separatorOf(words));
    std::vector<TableValue> values;
    std::transform(
        cells.begin(), cells.end(), std::back_inserter(values), tableValueOf);
    if (!has_names_ && !missingCoordinate(values))
      readNames(line, words);
    return true;
  }
  if (const auto count = countOf(words); count && !layout_.count) {
    layout_.count = *count;
    layout_.count_line = line.number;
    return true;
  }
  if (has_names_ || layout_.count || !beginsWithText(words))
    return false;
  readNames(line, words);
  return true;
}

void
TableHead::readNames(const TableLine& line, std::string_view words)
{
  has_names_ = true;
  if (!given_.empty())
    return;
  auto& columns = layout_.columns;
  for (const auto word : cellsOf(words, separatorOf(words))) {
    const TableValue value = tableValueOf(word);
    const bool is_known =
        value != TableValue::kNone &&
        std::find(columns.begin(), columns.end(), value) == columns.end();
    columns.push_back(is_known ? value : TableValue::kNone);
    if (!is_known && !word.empty())
      layout_.left_out.push_back("column " + text::quoted(word));
    const std::string unit = unitOf(word);
    if (value <= TableValue::kZ && !unit.empty() && unit != "m")
      line.fail("column " + text::quoted(word) + " is in " + text::quoted(unit) +
                ", but coordinates are read in metres");
  }
  if (const char* const missing = missingCoordinate(columns))
    line.fail(text::quoted(words) + " names no column " + missing +
              "; name the columns in their order (--columns x,y,z)");
}

/** Chooses the columns of a table without names. */
void
TableHead::takeColumns(const TableLine& row)
{
  if (!given_.empty())
    layout_.columns = given_;
  else if (!has_names_)
    layout_.columns =
        is_pts_
            ? ptsColumns(cellsOf(row.text, separatorOf(row.text)).size())
            : std::vector<TableValue>{TableValue::kX, TableValue::kY, TableValue::kZ};
  while (layout_.columns.back() == TableValue::kNone)
    layout_.columns.pop_back();
}

TableLayout
TableHead::layoutFor(const TableLine& row)
{
  if (const auto token = unclearDecimalComma(row.text); !token.empty())
    row.fail(text::quoted(token) + " has a decimal comma, but decimal commas need a "
                                   "semicolon or a tab between numbers");
  takeColumns(row);
  const std::vector<TableValue> xyz = {TableValue::kX, TableValue::kY, TableValue::kZ};
  if (layout_.columns != xyz && (has_names_ || !given_.empty())) {
    layout_.separator = separatorOf(row.text);
    if (cellsOf(row.text, layout_.separator).size() < layout_.columns.size())
      layout_.separator = layout_.separator == ';' ? ';' : ' ';
  }
  return layout_;
}

} // namespace pcl6d::io
