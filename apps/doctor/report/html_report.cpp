// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/report/report.h"

#include <pcl6d/io/json_object.h>

#include <utility>

namespace pcl6d::app {

namespace {
constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>pcl_slam6d_doctor</title>
<style>
body { font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 80em;
  padding: 0 1em; color: #222; background: #fff; }
h1 { font-size: 1.5em; } h2 { font-size: 1.2em; margin-top: 2em; }
table { border-collapse: collapse; font-size: 0.9em; }
th, td { text-align: left; padding: 0.3em 0.7em; border-bottom: 1px solid #ddd;
  vertical-align: top; }
.wide { overflow-x: auto; }
.conclusion { padding: 0.8em 1em; border-left: 6px solid #c0392b; background: #fbeeec; }
.conclusion.good { border-color: #2e8b57; background: #ecf7f0; }
.problem td:first-child { color: #c0392b; font-weight: bold; }
.warning td:first-child { color: #b9770e; font-weight: bold; }
.note td:first-child { color: #666; }
td.good { color: #2e8b57; font-weight: bold; } td.wrong { color: #c0392b; }
pre { background: #f5f5f5; padding: 0.6em 1em; overflow-x: auto; }
.lines { white-space: pre-line; }
figure { display: inline-block; margin: 0 2em 1em 0; }
svg { border: 1px solid #ddd; max-width: 100%; }
</style>
</head>
<body>
)";

/** Escapes markup; invalid UTF-8 becomes question marks. */
std::string
escaped(const std::string& text)
{
  const bool is_clean = isUtf8(text);
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else
      safe += is_clean || static_cast<unsigned char>(c) < 0x80 ? c : '?';
  }
  return safe;
}

std::string
tableOf(const ReportTable& table)
{
  std::string html = "<div class=\"wide\"><table>\n<tr>";
  for (const auto& head : table.heads)
    html += "<th>" + escaped(head) + "</th>";
  html += "</tr>\n";
  for (const Cells& row : table.rows) {
    html += "<tr>";
    for (const auto& cell : row) {
      const bool is_verdict = cell == "good" || cell == "wrong";
      html += (is_verdict ? "<td class=\"" + cell + "\">" : std::string("<td>")) +
              escaped(cell) + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string
findingsOf(const Diagnosis& d)
{
  if (d.findings.empty())
    return "<p>None.</p>\n";
  std::string html = "<table>\n<tr><th></th><th>what</th><th>measured</th>"
                     "<th>what to do</th></tr>\n";
  for (const Finding& finding : d.findings) {
    const std::string severity = toString(finding.severity);
    html += "<tr class=\"" + severity + "\"><td>" + severity + "</td><td>" +
            escaped(finding.what) + "</td><td class=\"lines\">" +
            escaped(finding.measured) + "</td><td>" + escaped(finding.advice) +
            "</td></tr>\n";
  }
  return html + "</table>\n";
}

std::string
adviceOf(const Diagnosis& d)
{
  std::string html;
  for (const Advice& advice : d.advice)
    html += "<tr><td><code>" + escaped(advice.what) + "</code></td><td>" +
            escaped(advice.why) + "</td></tr>\n";
  if (!html.empty())
    html = "<h2>What to set</h2>\n<table>\n" + html + "</table>\n";
  for (const auto& [caption, rows] : poseBlocks(d)) {
    html += "<p>" + escaped(caption) + "</p>\n<pre>";
    for (const auto& row : rows)
      html += row + "\n";
    html += "</pre>\n";
  }
  return html;
}

std::string
figureOf(const DoctorPair& pair,
         const Eigen::Isometry3d& pose,
         const std::string& caption)
{
  const std::string svg = svgOfPose(pair, pose);
  return svg.empty() ? ""
                     : "<figure>" + svg + "<figcaption>" + escaped(caption) +
                           "</figcaption></figure>\n";
}

std::string
picturesOf(const Diagnosis& d)
{
  std::string html = figureOf(d.pair, d.pair.start, "at the start");
  if (d.best_of_ours) {
    const Experiment& row = d.rows[*d.best_of_ours];
    html += figureOf(d.pair, row.outcome.pose, "by " + row.name());
  }
  return html.empty() ? "" : "<h2>Both clouds: TARGET blue, SOURCE red</h2>\n" + html;
}
} // namespace

std::string
htmlReport(const Diagnosis& d)
{
  std::string html = kHead;
  html += "<h1>" + escaped(d.pair.source.file) + " on " + escaped(d.pair.target.file) +
          "</h1>\n";
  html += std::string("<p class=\"conclusion") + (d.isVerified() ? " good" : "") +
          "\">" + escaped(conclusionOf(d)) + "</p>\n";
  html += "<h2>Clouds</h2>\n" + tableOf(cloudTable(d)) + "<ul>\n";
  for (const std::string& line : settingLines(d))
    html += "<li>" + escaped(line) + "</li>\n";
  html += "</ul>\n<h2>Classes</h2>\n" + tableOf(classTable(d));
  html += "<h2>Findings</h2>\n" + findingsOf(d) + adviceOf(d) + picturesOf(d);
  return html + "</body>\n</html>\n";
}

} // namespace pcl6d::app
