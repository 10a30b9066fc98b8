// SPDX-License-Identifier: BSD-3-Clause
#include "schema_keys.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/run_fields.h>
#include <pcl6d/run/run_links_io.h>

#include <algorithm>
#include <array>
#include <iomanip>
#include <ostream>
#include <utility>

namespace pcl6d {

namespace {
/** Required columns of a link. */
constexpr std::array<std::string_view, 6> kNeeded =
    {"from", "to", "kind", "verdict", "pairs", "rms"};

/** Required columns of a link's test. */
constexpr std::array<std::string_view, 6> kNeededOfCheck =
    {"from", "to", "result", "shift", "deviation", "open_directions"};

/** Quotes a text, required for commas in a reason. */
std::string
inQuotes(const std::string& text)
{
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

/** \return the cells of a row; cells in double quotes may contain commas */
std::vector<std::string>
cellsOf(std::string_view row)
{
  std::vector<std::string> cells(1);
  bool in_quotes = false;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool doubled = in_quotes && row.substr(i, 2) == "\"\"";
    if (doubled)
      cells.back() += row[++i];
    else if (row[i] == '"')
      in_quotes = !in_quotes;
    else if (row[i] == ',' && !in_quotes)
      cells.emplace_back();
    else
      cells.back() += row[i];
  }
  return cells;
}

/** The rows of a table, accessed by column name. */
class Table {
public:
  Table(const std::filesystem::path& path,
        std::string_view content,
        const std::array<std::string_view, 6>& needed)
  : path_(path), lines_(content)
  {
    if (!lines_.next())
      text::fail(path, "is empty, but must have a line with the names of its columns");
    columns_ = cellsOf(lines_.line());
    is_first_schema_ = has("trust");
    for (const std::string_view name : needed)
      if (!has(nameInFile(std::string(name))))
        text::failAt(path, 1, "has no column " + text::quoted(name));
  }

  bool
  next()
  {
    do {
      if (!lines_.next())
        return false;
    } while (text::isBlank(lines_.line()));
    cells_ = cellsOf(lines_.line());
    if (cells_.size() != columns_.size())
      text::failAt(path_,
                   lines_.number(),
                   "expected " + std::to_string(columns_.size()) + " columns, got " +
                       std::to_string(cells_.size()));
    return true;
  }

  /** Reads a field from the column of its name. */
  template <typename Value>
  void
  operator()(const char* name, Value& value) const
  {
    const auto column = std::find(columns_.begin(), columns_.end(), nameInFile(name));
    if (column == columns_.end())
      return; // not needed
    const std::string& cell =
        cells_[static_cast<std::size_t>(column - columns_.begin())];
    if constexpr (std::is_same_v<Value, std::string>)
      value = cell;
    else if constexpr (std::is_same_v<Value, Rejection>)
      value = Rejection::stated(cell);
    else if constexpr (std::is_enum_v<Value>)
      takeWord(cell, value);
    else if (!text::parseNumber(cell, value))
      fail(std::string(name) + " = " + text::quoted(cell) + " is not a number");
  }

  /** \throws IoFailed the message with file and line */
  [[noreturn]] void
  fail(const std::string& message) const
  {
    text::failAt(path_, lines_.number(), message);
  }

private:
  bool
  has(const std::string& column) const
  {
    return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
  }

  /** \return the name of a column in this file: verification.csv has had other names */
  std::string
  nameInFile(const std::string& name) const
  {
    return is_first_schema_ ? run_files::nameInFirstSchema(name) : name;
  }

  const std::filesystem::path& path_;
  text::Lines lines_;
  std::vector<std::string> columns_;
  std::vector<std::string> cells_;
  bool is_first_schema_ = false;
};

/** Writes the visited fields, separated by commas. */
struct CellWriter {
  std::ostream& csv;
  const char* comma = "";

  template <typename Value>
  void
  operator()(const char* /*name*/, const Value& value)
  {
    csv << std::exchange(comma, ",");
    if constexpr (std::is_same_v<Value, std::string>)
      csv << inQuotes(value);
    else if constexpr (std::is_same_v<Value, Rejection>)
      csv << inQuotes(toWords(value));
    else if constexpr (std::is_enum_v<Value>)
      csv << toString(value);
    else if constexpr (!std::is_pointer_v<Value>)
      csv << value;
    else if (value) // empty cell for null
      csv << *value;
  }
};

/** \param[in] visit the fields of a record with a visitor */
template <typename Record, typename VisitFields>
void
writeTable(const std::filesystem::path& path,
           const std::vector<Record>& records,
           const VisitFields& visit)
{
  writeFileAtomically(path, [&](std::ostream& csv) {
    const char* comma = "";
    visit(Record(), [&](const char* name, const auto&) {
      csv << std::exchange(comma, ",") << name;
    });
    csv << '\n' << std::setprecision(6);
    for (const Record& record : records) {
      visit(record, CellWriter{csv});
      csv << '\n';
    }
  });
}
} // namespace

void
writeRunLinks(const std::filesystem::path& path, const std::vector<RunLink>& links)
{
  writeTable(path, links, [](const RunLink& link, auto&& visit) {
    visitLinkFields(link, visit);
  });
}

void
writeLinkChecks(const std::filesystem::path& path, const std::vector<LinkCheck>& links)
{
  writeTable(path, links, [](const LinkCheck& link, auto&& visit) {
    visitLinkCheckFields(link, visit);
  });
}

std::vector<RunLink>
readRunLinks(const std::filesystem::path& path,
             const std::function<std::string(const RunLink&)>& fault)
{
  const std::string content = text::readFile(path);
  std::vector<RunLink> links;
  for (Table table(path, content, kNeeded); table.next();) {
    try {
      visitLinkFields(links.emplace_back(), table);
    } catch (const BadArgument& error) {
      table.fail(error.what());
    }
    const std::string wrong = fault ? fault(links.back()) : std::string();
    if (!wrong.empty())
      table.fail(wrong);
  }
  return links;
}

std::vector<LinkCheck>
readLinkChecks(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  std::vector<LinkCheck> links;
  for (Table table(path, content, kNeededOfCheck); table.next();) {
    LinkCheck& link = links.emplace_back();
    std::string least, most, turn;
    table("from", link.from);
    table("to", link.to);
    try {
      table("result", link.trust);
    } catch (const BadArgument& error) {
      table.fail(error.what());
    }
    table("probability_wrong", link.probability_wrong);
    table("patches", link.patches);
    table("violated", link.contradicted);
    table("shift", link.shift);
    table("deviation", link.deviation);
    table("open_directions", link.open_directions);
    table("reason", link.rejection);
    table("detectable_least", least);
    table("detectable_largest", most);
    table("detectable_turn", turn);
    if (least.empty() && most.empty() && turn.empty())
      continue;
    NoticedError& noticed = link.noticed.emplace();
    table("detectable_least", noticed.least);
    table("detectable_largest", noticed.most);
    table("detectable_turn", noticed.turn);
  }
  return links;
}

} // namespace pcl6d
