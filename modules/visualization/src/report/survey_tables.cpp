// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/visualization/survey_report.h>

#include <array>
#include <ostream>

namespace pcl6d {

namespace {
namespace fs = std::filesystem;

std::string
inCsv(const std::string& text)
{
  if (text.find_first_of(",\"\n") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

/** Control characters are not allowed in XML 1.0, not even escaped. */
std::string
inXml(const std::string& text)
{
  std::string safe;
  for (const char c : text)
    if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '&')
      safe += "&amp;";
    else if (c == '"')
      safe += "&quot;";
    else if (static_cast<unsigned char>(c) < ' ')
      safe += ' ';
    else
      safe += c;
  return safe;
}

fs::path
withEnd(const fs::path& base, const std::string& end)
{
  fs::path file = base;
  file += end;
  return file;
}

void
writeCsv(const fs::path& path, const SurveyTable& table)
{
  writeFileAtomically(path, [&](std::ostream& csv) {
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      csv << (c > 0 ? "," : "") << inCsv(table.columns[c]);
    for (const auto& row : table.rows) {
      csv << '\n';
      for (std::size_t c = 0; c < row.size(); ++c)
        csv << (c > 0 ? "," : "") << inCsv(row[c].text);
    }
    csv << '\n';
  });
}

void
writeXml(const fs::path& path, const SurveyReport& report)
{
  constexpr std::array<const char*, 3> kVerdicts = {
      "accepted", "conditional", "rejected"};
  constexpr std::array<const char*, 3> kResults = {
      "", " result=\"pass\"", " result=\"fail\""};
  writeFileAtomically(path, [&](std::ostream& xml) {
    xml << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<surveyReport title=\""
        << inXml(report.title) << "\" verdict=\""
        << kVerdicts[static_cast<std::size_t>(report.verdict)] << "\">\n";
    for (const auto& [name, value] : report.header)
      xml << "  <header name=\"" << inXml(name) << "\">" << inXml(value)
          << "</header>\n";
    for (const std::string& reason : report.reasons)
      xml << "  <reason>" << inXml(reason) << "</reason>\n";
    for (const SurveyTable& table : report.tables) {
      xml << "  <table name=\"" << inXml(table.name) << "\">\n";
      for (const auto& row : table.rows) {
        xml << "    <row>\n";
        for (std::size_t c = 0; c < row.size(); ++c)
          xml << "      <value name=\"" << inXml(table.columns[c]) << '"'
              << kResults[static_cast<std::size_t>(row[c].mark)] << '>'
              << inXml(row[c].text) << "</value>\n";
        xml << "    </row>\n";
      }
      xml << "  </table>\n";
    }
    xml << "</surveyReport>\n";
  });
}
} // namespace

std::vector<fs::path>
writeSurveyTables(const fs::path& base, const SurveyReport& report)
{
  std::vector<fs::path> files;
  for (const SurveyTable& table : report.tables) {
    files.push_back(withEnd(base, "_" + table.name + ".csv"));
    writeCsv(files.back(), table);
  }
  files.push_back(withEnd(base, ".xml"));
  writeXml(files.back(), report);
  return files;
}

} // namespace pcl6d
