// SPDX-License-Identifier: BSD-3-Clause
#include "report/base64.h"

#include <pcl6d/io/atomic_file.h>
#include <pcl6d/visualization/survey_report.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace pcl6d {
using namespace visualization;

namespace {
/** A matrix of more stations would have cells too small to read on A4. */
constexpr std::size_t kMostOfMatrix = 40;
constexpr std::size_t kBars = 12;

/** A4 pages, numbered; rows are not cut, headings of tables come again on each page. */
constexpr const char* kStyle = R"(
@page { size: A4; margin: 16mm 14mm 16mm 14mm;
  @bottom-right { content: counter(page) " / " counter(pages); font: 8pt sans-serif; color: #555 } }
* { box-sizing: border-box }
body { font: 9.5pt/1.4 "Helvetica Neue", Arial, "Liberation Sans", sans-serif; color: #1a1a1a;
  max-width: 182mm; margin: 8mm auto; -webkit-print-color-adjust: exact; print-color-adjust: exact }
h1 { font-size: 17pt; margin: 0 0 1mm }
h1 small { display: block; font-size: 9.5pt; font-weight: normal; color: #555 }
h2 { font-size: 11.5pt; margin: 7mm 0 1.5mm; border-bottom: .3mm solid #1f4e79; break-after: avoid }
p.note { margin: 0 0 1.5mm; color: #555; font-size: 8.5pt; break-after: avoid }
table { border-collapse: collapse; width: 100%; font-size: 8.5pt; font-variant-numeric: tabular-nums }
thead { display: table-header-group }
tr { break-inside: avoid }
th, td { padding: .7mm 1.6mm; border-bottom: .2mm solid #d5d9de; text-align: right; overflow-wrap: break-word }
th { background: #eef2f6; font-weight: 600; vertical-align: bottom }
th:first-child, td:first-child, .text { text-align: left }
.pass { color: #176b2c } .fail { color: #a81c1c; font-weight: 600 }
.head td { border: 0; padding: .4mm 1.6mm .4mm 0; text-align: left } .head td:first-child { color: #555; width: 42mm }
.verdict { border: .5mm solid; border-radius: 1.5mm; padding: 2.5mm 4mm; margin: 5mm 0 0; break-inside: avoid }
.verdict b { font-size: 12.5pt } .verdict ul { margin: 1mm 0 0; padding-left: 5mm; color: #1a1a1a }
.accepted { color: #176b2c; background: #f0f8f1 } .conditional { color: #8a5a00; background: #fdf7e9 }
.rejected { color: #a81c1c; background: #fcf1f1 }
.matrix { width: auto; font-size: 7pt } .matrix td, .matrix th { padding: .6mm; text-align: center;
  min-width: 6mm; border: .2mm solid #fff; overflow-wrap: normal }
.matrix th:first-child { text-align: right; white-space: nowrap; padding-right: 1.5mm }
.matrix thead th span { writing-mode: vertical-rl; transform: rotate(180deg); white-space: nowrap }
figure { margin: 2mm 0 0; break-inside: avoid } img { max-width: 100%; max-height: 150mm; display: block; margin: auto }
.sign { margin-top: 14mm; display: flex; gap: 12mm; break-inside: avoid }
.sign div { flex: 1; border-top: .2mm solid #555; padding-top: 1mm; color: #555; font-size: 8.5pt }
)";

std::string
escaped(const std::string& text)
{
  std::string safe;
  for (const char c : text)
    switch (c) {
    case '<':
      safe += "&lt;";
      break;
    case '>':
      safe += "&gt;";
      break;
    case '&':
      safe += "&amp;";
      break;
    case '"':
      safe += "&quot;";
      break;
    default:
      safe += c;
    }
  return safe;
}

const char*
classOf(SurveyVerdict verdict)
{
  constexpr std::array<const char*, 3> kClasses = {
      "accepted", "conditional", "rejected"};
  return kClasses[static_cast<std::size_t>(verdict)];
}

const char*
wordsOf(SurveyVerdict verdict)
{
  constexpr std::array<const char*, 3> kWords = {"Registration accepted",
                                                 "Registration accepted with remarks",
                                                 "Registration not accepted"};
  return kWords[static_cast<std::size_t>(verdict)];
}

void
writeHead(const SurveyReport& report, std::ostream& html)
{
  html << "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>"
       << escaped(report.title) << " - registration report</title><style>" << kStyle
       << "</style></head><body>\n<h1>" << escaped(report.title)
       << "<small>Registration report of terrestrial scans</small></h1>\n"
          "<table class=\"head\">";
  for (const auto& [name, value] : report.header)
    html << "<tr><td>" << escaped(name) << "</td><td>" << escaped(value)
         << "</td></tr>\n";
  html << "</table>\n<div class=\"verdict " << classOf(report.verdict) << "\"><b>"
       << wordsOf(report.verdict) << "</b><ul>";
  for (const std::string& reason : report.reasons)
    html << "<li>" << escaped(reason) << "</li>";
  html << "</ul></div>\n";
}

/** \return whether most cells of a column are words */
bool
isOfWords(const SurveyTable& table, std::size_t column)
{
  std::size_t words = 0;
  for (const auto& row : table.rows)
    words += row[column].text.find_first_not_of("0123456789.+-") != std::string::npos;
  return 2 * words > table.rows.size();
}

void
writeHtmlTable(const SurveyTable& table, std::ostream& html)
{
  html << "<h2>" << escaped(table.title) << "</h2>\n";
  if (!table.note.empty())
    html << "<p class=\"note\">" << escaped(table.note) << "</p>\n";
  std::vector<const char*> kinds;
  html << "<table><thead><tr>";
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    kinds.push_back(isOfWords(table, c) ? "text" : "");
    html << "<th class=\"" << kinds[c] << "\">" << escaped(table.columns[c]) << "</th>";
  }
  html << "</tr></thead><tbody>\n";
  constexpr std::array<const char*, 3> kMarks = {"", " pass", " fail"};
  for (const auto& row : table.rows) {
    html << "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c)
      html << "<td class=\"" << kinds[c]
           << kMarks[static_cast<std::size_t>(row[c].mark)] << "\">"
           << escaped(row[c].text) << "</td>";
    html << "</tr>\n";
  }
  html << "</tbody></table>\n";
}

void
writeMatrix(const SurveyReport& report, std::ostream& html)
{
  const std::size_t count = report.stations.size();
  if (count < 2 || report.link_errors.empty())
    return;
  html << "<h2>Overlap matrix</h2>\n<p class=\"note\">Share of points [%] with a "
          "partner in "
          "the other station; empty: no link.</p>\n";
  if (count > kMostOfMatrix) {
    html << "<p>" << count
         << " stations are too many for a matrix on this page; the table of "
            "links has all overlaps.</p>\n";
    return;
  }
  html << "<table class=\"matrix\"><thead><tr><th></th>";
  for (const std::string& name : report.stations)
    html << "<th><span>" << escaped(name) << "</span></th>";
  html << "</tr></thead><tbody>\n" << std::fixed << std::setprecision(0);
  for (std::size_t i = 0; i < count; ++i) {
    html << "<tr><th>" << escaped(report.stations[i]) << "</th>";
    for (std::size_t j = 0; j < count; ++j) {
      const double overlap = report.overlaps[i][j];
      if (i == j)
        html << "<td style=\"background:#c3c9d0\"></td>";
      else if (!std::isfinite(overlap))
        html << "<td style=\"background:#f4f5f7\"></td>";
      else
        html << "<td style=\"background:rgba(31,110,170," << std::setprecision(2)
             << 0.1 + 0.6 * std::clamp(overlap, 0.0, 1.0) << ")\">"
             << std::setprecision(0) << 100 * overlap << "</td>";
    }
    html << "</tr>\n";
  }
  html << "</tbody></table>\n";
}

/** Bars of the cloud-to-cloud errors of links. */
void
writeHistogram(const std::vector<double>& errors, std::ostream& html)
{
  if (errors.empty())
    return;
  const double most = 1000 * *std::max_element(errors.begin(), errors.end());
  // Bars of 0.1, 0.2, 0.5, 1, ... mm; kBars bars cover the largest error.
  double step = 0.1;
  for (int i = 0; step * static_cast<double>(kBars) <= most; ++i)
    step *= i % 3 == 1 ? 2.5 : 2;
  std::array<std::size_t, kBars> counts{};
  for (const double error : errors)
    ++counts[std::min(kBars - 1, static_cast<std::size_t>(1000 * error / step))];
  const auto highest =
      static_cast<double>(*std::max_element(counts.begin(), counts.end()));
  constexpr double kWidth = 46, kHeight = 110, kLeft = 8, kTop = 16;
  html << "<h2>Histogram of the cloud-to-cloud errors</h2>\n<p class=\"note\">Number "
          "of links "
          "by the rms of their pairs [mm].</p>\n<figure><svg viewBox=\"0 0 "
       << 2 * kLeft + kWidth * kBars << ' ' << kHeight + kTop + 22
       << "\" width=\"100%\" font-size=\"11\" font-family=\"sans-serif\" "
          "text-anchor=\"middle\">\n"
       << std::defaultfloat << std::setprecision(6);
  for (std::size_t i = 0; i < kBars; ++i) {
    const double x = kLeft + kWidth * static_cast<double>(i);
    const double height = kHeight * static_cast<double>(counts[i]) / highest;
    const double y = kTop + kHeight - height;
    if (counts[i] > 0)
      html << "<rect x=\"" << x + 2 << "\" y=\"" << y << "\" width=\"" << kWidth - 4
           << "\" height=\"" << height << "\" fill=\"#1f6eaa\"/><text x=\""
           << x + kWidth / 2 << "\" y=\"" << y - 4 << "\">" << counts[i] << "</text>";
    html << "<text x=\"" << x << "\" y=\"" << kTop + kHeight + 16 << "\" fill=\"#555\">"
         << step * static_cast<double>(i) << "</text>\n";
  }
  html << "<line x1=\"" << kLeft << "\" x2=\"" << kLeft + kWidth * kBars << "\" y1=\""
       << kTop + kHeight << "\" y2=\"" << kTop + kHeight
       << "\" stroke=\"#555\"/></svg></figure>\n";
}

void
writePicture(const std::string& png, std::ostream& html)
{
  if (!png.empty())
    html << "<h2>Plan</h2>\n<figure><img alt=\"map from above\" "
            "src=\"data:image/png;base64,"
         << base64Of(png.data(), png.size()) << "\"></figure>\n";
}
} // namespace

void
writeSurveyReport(const std::filesystem::path& path, const SurveyReport& report)
{
  std::ostringstream html;
  writeHead(report, html);
  for (const SurveyTable& table : report.tables)
    writeHtmlTable(table, html);
  writeMatrix(report, html);
  writeHistogram(report.link_errors, html);
  writePicture(report.top_view, html);
  html << "<div class=\"sign\"><div>Date</div><div>Responsible surveyor</div></div>\n"
          "</body></html>\n";
  writeFileAtomically(path, [&](std::ostream& stream) { stream << html.str(); });
}

} // namespace pcl6d
