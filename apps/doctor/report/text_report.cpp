// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/report/report.h"

#include <algorithm>
#include <sstream>

namespace pcl6d::app {

namespace {
void
addTable(const ReportTable& table, std::string& text)
{
  std::vector<std::size_t> widths;
  for (const auto& head : table.heads)
    widths.push_back(head.size());
  for (const Cells& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], row[i].size());
  const auto addRow = [&](const Cells& row) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += row[i];
      line.append(widths[i] + 2 - row[i].size(), ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  };
  addRow(table.heads);
  for (const Cells& row : table.rows)
    addRow(row);
}

/** Lines, each behind an indent; the first behind a label. */
void
addLabelled(const std::string& label, const std::string& lines, std::string& text)
{
  std::istringstream stream(lines);
  std::string before = label;
  before.resize(std::max<std::size_t>(before.size(), 12), ' ');
  for (std::string line; std::getline(stream, line);) {
    text += before + line + '\n';
    before.assign(12, ' ');
  }
}

void
addFindings(const Diagnosis& d, std::string& text)
{
  text += d.findings.empty() ? "\nFindings: none\n" : "\nFindings\n";
  for (const Finding& finding : d.findings) {
    addLabelled(toString(finding.severity), finding.what, text);
    addLabelled("  measured", finding.measured, text);
    addLabelled("  do", finding.advice, text);
  }
}
} // namespace

std::string
textReport(const Diagnosis& d)
{
  std::string text;
  addTable(cloudTable(d), text);
  text += '\n';
  for (const std::string& line : settingLines(d))
    text += line + '\n';
  text += '\n';
  addTable(classTable(d), text);
  addFindings(d, text);
  if (!d.advice.empty())
    text += "\nWhat to set\n";
  for (const Advice& advice : d.advice) {
    text += "  " + advice.what + '\n';
    text += "      " + advice.why + '\n';
  }
  for (const auto& [caption, rows] : poseBlocks(d)) {
    text += '\n' + caption + '\n';
    for (const auto& row : rows)
      text += "  " + row + '\n';
  }
  return text + '\n' + conclusionOf(d) + '\n';
}

} // namespace pcl6d::app
