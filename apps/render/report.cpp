// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "common/process/memory_budget.h"
#include "common/progress_bar.h"
#include "render/survey.h"
#include "render/verbs.h"

#include <pcl6d/visualization/report.h>
#include <pcl6d/visualization/survey_report.h>

#include <filesystem>
#include <iostream>

namespace pcl6d::app {

namespace {
struct ReportSettings {
  std::string run;
  std::string output;
  std::string title;
  ReportOptions options;
  SurveySettings survey;
  MemoryOption memory;
  bool quiet = false;
};

bool
parse(const std::vector<std::string>& arguments, ReportSettings& s)
{
  OptionTable table(std::string("usage: ") + kRender +
                    R"( report RUN [options]
Writes a page for a browser, without need of a network: verdict, map in three
dimensions, plots, tables, pictures and options of the run. Missing parts of the run
are named on the page; exit code 3: a file of the run cannot be read.
With --survey: the report of a survey office, for A4 pages: header, verdict, requirements,
residuals of control and check points, stations, links, overlap matrix and histogram;
tables as CSV and XML in the same folder.
)");
  table.positional("RUN", &s.run);
  table.group("Output");
  table.add("output,o FILE.html", &s.output)
      .help("default: RUN/report.html; with --survey RUN/survey.html");
  table.add("title", &s.title).help("default: the name of the folder RUN");
  table.add("max-points", &s.options.max_points)
      .help("largest number of points of the map, evenly reduced, and of dynamic "
            "points; 12 bytes each");
  table.add("survey", &s.survey.is_wanted).help("write the report of a survey office");
  table.add("project KEY=VALUE", &s.survey.project)
      .composing()
      .help("of --survey: an entry of the header (project, client, operator, "
            "instrument, date, coordinate-system or any word); once for each; by "
            "default the entries of the run");
  table.add("tolerance LENGTH", &s.survey.tolerance)
      .help("of --survey: 5mm, 0.5cm or [m]: limit of the residuals and of the bounds "
            "of stations; by default the limit of the run");
  table.add("pdf", &s.survey.pdf)
      .help("of --survey: print the report with Chromium to a .pdf file in the same "
            "folder");
  s.memory.addTo(table);
  table.add("quiet", &s.quiet).help("print warnings and errors only");
  if (!table.parse(arguments))
    return false;
  table.check([&] {
    s.options.validate();
    surveyOptionsFrom(s.survey.project, s.survey.tolerance);
  });
  const bool has_survey_words =
      s.survey.pdf || !s.survey.project.empty() || !s.survey.tolerance.empty();
  if (has_survey_words && !s.survey.is_wanted)
    throw UsageError("--project, --tolerance and --pdf need --survey");
  if (s.output.empty())
    s.output = (std::filesystem::path(s.run) /
                (s.survey.is_wanted ? "survey.html" : "report.html"))
                   .string();
  refuseInputs(s.output, {s.run});
  return true;
}
} // namespace

int
runReport(const std::vector<std::string>& arguments)
{
  ReportSettings settings;
  if (!parse(arguments, settings))
    return kDone;
  if (settings.survey.is_wanted) {
    const auto files = writeSurvey(settings.run, settings.output, settings.survey);
    for (const auto& file : files)
      if (!settings.quiet)
        std::cout << "  " << file.string() << '\n';
    return kDone;
  }
  const MemoryBudget memory(settings.memory, settings.output);
  ProgressBar bar(settings.quiet);
  const ReportData data =
      gatherReport(RunFolder(settings.run), settings.title, settings.options);
  writeReport(settings.output, data, settings.options);
  for (const auto& what : data.missing)
    bar.warn(what);
  if (!settings.quiet)
    std::cout << "  " << settings.output << '\n';
  return data.is_damaged ? kDoubtful : kDone;
}

} // namespace pcl6d::app
