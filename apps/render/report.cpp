// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/memory_budget.h"
#include "common/option_table.h"
#include "common/progress_bar.h"
#include "render/verbs.h"

#include <pcl6d/visualization/report.h>

#include <filesystem>
#include <iostream>

namespace pcl6d::app {

namespace {
struct ReportSettings {
  std::string run;
  std::string output;
  std::string title;
  ReportOptions options;
  MemoryOption memory;
  bool quiet = false;
};

bool
parse(const std::vector<std::string>& arguments, ReportSettings& s)
{
  OptionTable table(std::string("usage: ") + kRender +
                    R"( report RUN [options]
Writes one page for a browser, which needs no network: whether the map is to be
trusted, the map in three dimensions, plots, tables, pictures and options of the run.
What the run lacks is named on it; of a file that cannot be read the exit code is 3.
)");
  table.positional("RUN", &s.run);
  table.group("Output");
  table.add("output,o FILE.html", &s.output).help("default: RUN/report.html");
  table.add("title", &s.title).help("default: the name of the folder RUN");
  table.add("max-points", &s.options.max_points)
      .help("of the map, which is thinned evenly, and of what moved; 12 bytes each");
  s.memory.addTo(table);
  table.add("quiet", &s.quiet).help("print warnings and errors only");
  if (!table.parse(arguments))
    return false;
  table.check([&] { s.options.validate(); });
  if (s.output.empty())
    s.output = (std::filesystem::path(s.run) / "report.html").string();
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
