// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "common/progress_bar.h"
#include "render/verbs.h"

#include <pcl6d/visualization/report.h>

#include <filesystem>
#include <iostream>

namespace pcl6d::app {

namespace {
namespace po = boost::program_options;

struct ReportSettings {
  std::string run;
  std::string output;
  std::string title;
  ReportOptions options;
  bool quiet = false;
};

bool
parse(const std::vector<std::string>& arguments, ReportSettings& s)
{
  CommandLine line(
      std::string("usage: ") + kRender +
      " report RUN [options]\n"
      "Writes one page for a browser, which needs no network: whether the "
      "map is to be\ntrusted, the map in three dimensions, plots, tables, "
      "pictures and options of the run.\nWhat the run lacks is named on it.\n");
  line.positional("RUN", &s.run);
  line.group("Output").add_options()("output,o",
                                     po::value(&s.output)->value_name("FILE.html"),
                                     "default: RUN/report.html")(
      "title", po::value(&s.title), "default: the name of the folder RUN")(
      "max-points",
      valueOf(s.options.max_points),
      "of the map, which is thinned evenly; 12 bytes each")(
      "quiet", po::bool_switch(&s.quiet), "print warnings and errors only");
  if (!line.parse(arguments))
    return false;
  checkOptions([&] { s.options.validate(); }, {{"max_points", "max-points"}});
  if (s.output.empty())
    s.output = (std::filesystem::path(s.run) / "report.html").string();
  return true;
}
} // namespace

int
runReport(const std::vector<std::string>& arguments)
{
  ReportSettings settings;
  if (!parse(arguments, settings))
    return kDone;
  ProgressBar bar(settings.quiet);
  const ReportData data =
      gatherReport(RunFolder(settings.run), settings.title, settings.options);
  writeReport(settings.output, data, settings.options);
  for (const auto& what : data.missing)
    bar.warn(what);
  if (!settings.quiet)
    std::cout << "  " << settings.output << '\n';
  return kDone;
}

} // namespace pcl6d::app
