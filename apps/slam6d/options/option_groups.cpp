// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "slam6d/options/input_options.h"
#include "slam6d/options/option_groups.h"
#include "slam6d/options/plugin_words.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/text.h>

#include <utility>

namespace pcl6d::app {

namespace {
void
takeGuess(Settings& s, const std::string& word)
{
  s.auto_guess = word == "auto";
  if (!s.auto_guess)
    s.slam.initial_guess = initialGuessFromName(word);
}

void
describeFilter(OptionList& list, Settings& s)
{
  list.stage(OptionStage::kPreprocess);
  list.addWord("filter", s.filter, reader(s, takeFilter))
      .countsIf([&s] { return !s.joins; }, "of SCAN_DIR")
      .withDefault(toString(s.filter))
      .withHelp(
          joined(lineFilterNames()) +
          ": along the lines of organized scans; the median moves mixed pixels at "
          "edges, the reduction merges points closer than 0.1 m on a line");
}

/** Words of methods to which plug-ins may add, or with a default derived from the input. */
void
readMethods(OptionList& list, Settings& s)
{
  list.of(&s.slam.minimiser).readBy(reader(s, takeMinimiser));
  list.of(&s.slam.plane_minimiser).readBy(reader(s, takePlaneMinimiser));
  list.of(&s.slam.search).readBy(reader(s, takeSearch));
  list.of(&s.slam.initial_guess)
      .withDefault("auto")
      .countsIf([&s] { return !s.joins; }, "of SCAN_DIR")
      .readBy(reader(s, takeGuess));
}

void
describeGraphFile(OptionList& list, Settings& s)
{
  list.stage(OptionStage::kRelaxation);
  list.add("graph-in FILE", s.graph_in)
      .as(OptionRole::kInputFile)
      .countsIf([&s] { return s.slam.relaxation.has_value(); }, "of --relaxation")
      .withHelp("links to test besides the found links: .g2o, or lines 'a b' with the "
                "indices of two scans; the weight of a link depends on the agreement "
                "with the rest");
}

void
describeControl(OptionList& list, Settings& s, const OptionList& slam)
{
  const auto has_folder = [&s] { return !s.joins; };
  list.group("Control points");
  list.stage(OptionStage::kControl);
  list.add("control FILE", s.control.points)
      .as(OptionRole::kInputFile)
      .countsIf(has_folder, "of SCAN_DIR")
      .withHelp(
          "control points, a line each: name x y z [sigma] in metres; with --targets, "
          "the map is finally adjusted to the control points, and the results are in "
          "their frame. Blunders are found by the residuals, named, and left out");
  list.add("targets FILE", s.control.targets)
      .as(OptionRole::kInputFile)
      .countsIf([&s] { return !s.control.points.empty(); }, "of --control")
      .withHelp(
          "the targets of control points measured in scans, a line each: name scan x y "
          "z, in metres in the frame of the scan; the scan by file name or number");
  list.add("check NAMES", s.control.checks)
      .as(OptionRole::kInput)
      .countsIf([&s] { return !s.control.points.empty(); }, "of --control")
      .withHelp("names of check points, separated by commas: control points left out "
                "of the adjustment and only compared with the result");
  list.append(slam, OptionStage::kControl);
}

void
describeOutput(OptionList& list, Settings& s)
{
  list.stage(OptionStage::kWrite);
  list.add(kPlanesOption, s.planes)
      .as(OptionRole::kOutput)
      .withHelp("find and label the planes of the map: planes.json, planes.pcd, "
                "hulls.ply and a picture (more choice: pcl_slam6d_planes OUT_DIR)");
  list.stage(OptionStage::kDynamic);
  list.addWord("moving",
               s.moving,
               [&s](const std::string& word) { s.moving = movingFromName(word); })
      .withDefault("label")
      .withHelp(
          "keep|label|remove: dynamic points, found because rays of further scans pass "
          "through their places; label: field dynamic (0 or 1) in scans/, and not in "
          "the map; remove: neither in scans/ nor in the map; keep: no search. Unless "
          "kept, planes leave dynamic points out, and so does the last round of "
          "relaxation where dynamic points may pull a scan");
  list.stage(OptionStage::kWrite);
  list.add(kReportOption, s.report)
      .as(OptionRole::kOutput)
      .withHelp("write report.html: verdict, map, plots and tables on one page for a "
                "browser; and survey.html: the report of a survey office for A4 pages, "
                "with the tables as CSV and XML files");
  list.add(std::string(kProjectOption) + " KEY=VALUE", s.project)
      .as(OptionRole::kOutput)
      .mayRepeat()
      .ifNotGiven("none")
      .countsIf([&s] { return s.report; }, "of --report")
      .withHelp("an entry in the header of survey.html: project, client, operator, "
                "instrument, date, coordinate-system or any word; once for each");
  list.add(std::string(kToleranceOption) + " LENGTH", s.tolerance)
      .as(OptionRole::kOutput)
      .ifNotGiven("none")
      .countsIf([&s] { return s.report; }, "of --report")
      .withHelp("5mm, 0.5cm or [m]: limit in survey.html of the residuals of control "
                "and check "
                "points, and of the bounds of stations");
  list.add("epsg CODE", s.epsg)
      .as(OptionRole::kOutput)
      .within(from0())
      .withHelp("EPSG code of the coordinate system of poses and map, projected and in "
                "metres (0: not known): pcl_slam6d_convert writes the code to LAS, LAZ "
                "and E57");
  list.add(kNoPictureOption, s.no_picture)
      .as(OptionRole::kOutput)
      .withHelp("do not draw top_view.png (saves a second)");
}

/** Options of a single call, written to no file. */
void
describeCall(OptionList& list, Settings& s)
{
  const auto add = [&](const std::string& name,
                       bool& variable,
                       const std::string& help) -> OptionSpec& {
    return list.add(name, variable).as(OptionRole::kSession).withHelp(help);
  };
  const auto has_folder = [&s] { return !s.joins; };
  list.stage(OptionStage::kRun);
  add("explain",
      s.explain,
      "print the plan of the run and write nothing: scans and their order, initial "
      "poses, "
      "derived parameters, expected time and memory, measured on the first four scans; "
      "-o is "
      "not needed")
      .countsIf(has_folder, "of SCAN_DIR");
  add("live-view",
      s.live_view,
      "show the growing map in a window, after the end until the window is closed; "
      "without a display the run goes on");
  add("resume",
      s.resume,
      "go on where an interrupted run into OUT_DIR stopped (also the default); warns "
      "without an interrupted run")
      .countsIf(has_folder, "of SCAN_DIR");
  add("fresh", s.fresh, "start anew, and drop the work of an interrupted run")
      .countsIf(has_folder, "of SCAN_DIR");
  add("force", s.force, "write into a folder that is not empty");
  add("quiet", s.quiet, "print warnings and errors only");
  add("verbose", s.verbose, "print a line per scan");
  add("timing",
      s.timing,
      "print at the end the time of each stage, also in summary.json");
}

void
describeRun(OptionList& list, Settings& s, const OptionList& slam)
{
  list.group("Run");
  list.stage(OptionStage::kWrite);
  list.add("output,o OUT_DIR", s.out)
      .as(OptionRole::kSession)
      .withHelp("folder to write; made if missing");
  list.append(slam.of(&s.slam.num_threads));
  list.stage(OptionStage::kRun);
  s.memory.describe(list);
  describeOutput(list, s);
  list.append(slam.of(&s.slam.verify));
  list.append(slam.of(&s.slam.seed));
  describeCall(list, s);
}
} // namespace

void
refuseScale(const std::vector<std::string>& arguments)
{
  for (const std::string& word : arguments)
    if (word == "--scale" || word.rfind("--scale=", 0) == 0)
      throw UsageError(std::string("--scale: ") + kOneScale);
}

OptionList
optionsOf(Settings& s, Slam6DParameters& used)
{
  OptionList slam, list;
  describe(s.slam, used, slam);
  describeInput(list, s, slam);
  list.group("Filters and reduction");
  describeFilter(list, s);
  for (const OptionStage stage : {OptionStage::kPreprocess,
                                  OptionStage::kMatching,
                                  OptionStage::kRecovery,
                                  OptionStage::kLoops,
                                  OptionStage::kRelaxation})
    list.append(slam, stage);
  readMethods(list, s);
  list.group("Loops and graph");
  describeGraphFile(list, s);
  describeControl(list, s, slam);
  describeRun(list, s, slam);
  list.append(slam, OptionStage::kDynamic);
  return list;
}

} // namespace pcl6d::app
