// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/report/report.h"
#include "doctor/report/run_words.h"
#include "doctor/report/words.h"

#include <pcl6d/io/text.h>

#include <limits>

namespace pcl6d::app {

namespace {
std::string
fieldWords(const DoctorCloud& cloud)
{
  std::string words;
  for (const auto& field : cloud.fields)
    words += (words.empty() ? "" : " ") + field;
  return words;
}

Cells
cloudRow(const char* role, const DoctorCloud& cloud, const CloudMeasures& of)
{
  Cells cells = {role,
                 cloud.file,
                 std::to_string(cloud.width) + " x " + std::to_string(cloud.height),
                 std::to_string(of.points),
                 std::to_string(of.not_finite + cloud.left_out)};
  if (of.points == 0)
    cells.insert(cells.end(), {"-", "-", "-", "-"});
  else {
    const Eigen::Vector3d size = of.box.diagonal();
    cells.insert(cells.end(),
                 {placeText(of.middle),
                  shortNumber(size.x()) + " x " + shortNumber(size.y()) + " x " +
                      shortNumber(size.z()),
                  shortNumber(of.spacing),
                  shortNumber(of.float_step, 2)});
  }
  cells.push_back(fieldWords(cloud));
  return cells;
}

std::string
matrixRow(const Eigen::Isometry3d& pose, int row)
{
  std::string line;
  for (int i = 0; i < 4; ++i)
    line += (i > 0 ? " " : "") + text::shortest(pose.matrix()(row, i));
  return line;
}

std::vector<std::string>
matrixRows(const Eigen::Isometry3d& pose)
{
  return {
      matrixRow(pose, 0), matrixRow(pose, 1), matrixRow(pose, 2), matrixRow(pose, 3)};
}

Cells
classRow(const Diagnosis& d, const Experiment& row)
{
  const ClassOutcome& out = row.outcome;
  Cells cells = {toString(row.method), row.setting_words, saidShortly(out)};
  if (out.end != RunEnd::kDone) {
    cells.insert(cells.end(), {"-", "-", "-", "-", "-", "-", "-"});
    return cells;
  }
  cells.push_back(std::to_string(out.iterations) + "/" + std::to_string(out.limit));
  cells.push_back(shortNumber(out.seconds, 2));
  const bool is_fitness = out.fitness < std::numeric_limits<double>::max();
  cells.push_back(is_fitness ? shortNumber(out.fitness) : "-"); // that: no pairs
  if (!out.is_rigid || !d.best) {
    cells.insert(cells.end(),
                 {"-", "-", "-", out.is_rigid ? "not verified" : "no pose"});
    return cells;
  }
  const auto moved = d.pair.between(d.pair.start, out.pose);
  const auto off = d.pair.between(d.rows[*d.best].outcome.pose, out.pose);
  cells.push_back(motionText(moved.translation, moved.rotation));
  cells.push_back(motionText(off.translation, off.rotation));
  cells.push_back(percentText(row.verdict.fit.share) + ", " +
                  metres(row.verdict.fit.misfit));
  cells.push_back(row.verdict.trust.empty() ? "not verified" : row.verdict.trust);
  return cells;
}
} // namespace

ReportTable
cloudTable(const Diagnosis& d)
{
  ReportTable table;
  table.heads = {"cloud",
                 "file",
                 "rows",
                 "points",
                 "not finite",
                 "middle [m]",
                 "size [m]",
                 "spacing [m]",
                 "float step [m]",
                 "fields"};
  table.rows = {cloudRow("SOURCE", d.pair.source, d.pair.of_source),
                cloudRow("TARGET", d.pair.target, d.pair.of_target)};
  return table;
}

ReportTable
classTable(const Diagnosis& d)
{
  ReportTable table;
  table.heads = {"class",
                 "settings",
                 "says",
                 "iterations",
                 "time [s]",
                 "fitness [m^2]",
                 "moved by",
                 "off the best by",
                 "met, misfit",
                 "verdict"};
  for (const Experiment& row : d.rows)
    table.rows.push_back(classRow(d, row));
  return table;
}

std::vector<std::string>
settingLines(const Diagnosis& d)
{
  const DoctorPair& pair = d.pair;
  std::vector<std::string> lines = {"start: " + pair.guess_words};
  if (!pair.canBeMatched())
    return lines;
  lines.back() += "; " + percentText(pair.at_start.share) +
                  " of the source's points are within the max distance there";
  lines.push_back("max distance = " + metres(pair.max_distance) + " (" +
                  pair.max_distance_why + ")");
  lines.push_back("resolution = " + metres(pair.resolution) +
                  " (6 spacings, at least the max distance)");
  lines.push_back("poses are told apart from " + metres(pair.tolerance()) +
                  " on (a tenth of the spacing)");
  lines.push_back("scanner of SOURCE at (" + placeText(pair.of_source.scanner.place) +
                  "): " + pair.of_source.scanner.why);
  lines.push_back("scanner of TARGET at (" + placeText(pair.of_target.scanner.place) +
                  "): " + pair.of_target.scanner.why);
  return lines;
}

std::vector<std::pair<std::string, std::vector<std::string>>>
poseBlocks(const Diagnosis& d)
{
  std::vector<std::pair<std::string, std::vector<std::string>>> blocks;
  if (!d.best_of_ours)
    return blocks;
  const Experiment& row = d.rows[*d.best_of_ours];
  const std::string trust =
      row.verdict.trust.empty() ? "not verified" : row.verdict.trust;
  blocks.emplace_back("pose of SOURCE in the frame of TARGET by " + row.name() + " (" +
                          trust + ")",
                      matrixRows(d.pair.toFull(row.outcome.pose)));
  if (d.pair.isFar())
    blocks.emplace_back("after subtracting the offsets", matrixRows(row.outcome.pose));
  if (!row.start_words.empty())
    blocks.emplace_back("guess by " + row.start_words,
                        matrixRows(d.pair.toFull(row.start)));
  return blocks;
}

} // namespace pcl6d::app
