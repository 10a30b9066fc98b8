// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/open_scans.h"
#include "common/printable.h"
#include "common/progress_bar.h"
#include "slam6d/explain.h"
#include "slam6d/join.h"
#include "slam6d/run_input.h"
#include "slam6d/shared_reading.h"

#include <pcl6d/io/text.h>
#include <pcl6d/slam6d/slam6d.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <unistd.h>

namespace pcl6d::app {

namespace {
/** Number of scans registered to measure time and memory: the first has no partner, three have. */
constexpr std::size_t kMeasuredScans = 4;

constexpr double kBytesOfMegabyte = 1e6;

/** \return [bytes] resident memory of this process; 0 if unknown */
double
residentBytes()
{
  std::ifstream file("/proc/self/statm");
  double pages = 0, resident = 0;
  file >> pages >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

std::string
orderOf(const ScanFolder& folder)
{
  constexpr std::size_t kShown = 5;
  std::string names;
  for (std::size_t i = 0; i < std::min(kShown, folder.size()); ++i)
    names += (i > 0 ? ", " : "") + folder.name(i);
  if (folder.size() > kShown)
    names += ", ... " + folder.name(folder.size() - 1);
  return names;
}

/** \return the options for the first scans alone */
Slam6DOptions
optionsOfFirst(const Settings& settings)
{
  Slam6DOptions options = settings.slam;
  options.control = {};
  options.given_links.clear();
  return options;
}

/** \return the parameters without those derived from the poses of all scans */
Slam6DParameters
ofFirst(Slam6DParameters parameters)
{
  for (Parameter* parameter : {&parameters.loop_distance,
                               &parameters.loop_gap,
                               &parameters.loop_pairs,
                               &parameters.link_distance})
    if (!parameter->given)
      *parameter = {};
  return parameters;
}

/** Registers the first scans, and extrapolates to all scans. */
void
measure(const Settings& settings, const EarlierRuns& earlier, RunScans& scans)
{
  const std::size_t total = scans.folder().size();
  const std::size_t count = std::min(kMeasuredScans, total);
  const double before = residentBytes();
  const auto start = std::chrono::steady_clock::now();
  Slam6D slam(optionsOfFirst(settings));
  SharedReading reading(scans, earlier, nullptr);
  std::size_t points = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Scan scan = scans.read(i);
    points += scan.points.size();
    reading.add(i, scan, slam);
  }
  optimize(slam, earlier);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  for (const auto& [name, unit, parameter] :
       named(ofFirst(slam.result().parameters), settings))
    std::cout << parameterLine(name, parameter, unit) << '\n';
  const double share = static_cast<double>(total) / static_cast<double>(count);
  const double memory = before + share * std::max(0.0, residentBytes() - before);
  std::cout << "expected, from the first " << text::counted(count, "scan") << " ("
            << points << " points): about " << durationText(share * spent.count())
            << " and " << std::lround(memory / kBytesOfMegabyte)
            << " MB to read and register " << text::counted(total, "scan")
            << "; more where scans have many neighbours or are lost\n";
}
} // namespace

int
explainRun(const Settings& given)
{
  if (!given.joined.empty() || !given.continued.empty())
    throw UsageError("--explain is for the scans of a folder or a file, not for joined "
                     "or continued runs");
  const EarlierRuns earlier = openEarlier(given);
  const RunInput input = openInput(given, earlier);
  const ScanFolder& folder = input.folder;
  RunScans scans = openScans(folder, given, earlier);
  const Settings settings = resolved(given, folder, earlier);
  for (const std::string& line :
       describeInput(settings, scans, earlier, input.drive, 1))
    std::cout << printable(line) << '\n';
  std::cout << "order: " << printable(orderOf(folder)) << '\n';
  if (!settings.slam.control.points.empty())
    std::cout << "control: " << settings.slam.control.points.size() << " points, "
              << settings.slam.control.targets.size() << " targets, "
              << settings.slam.control.checks.size() << " held back\n";
  measure(settings, earlier, scans);
  std::cout << "nothing was written\n";
  flushOutput();
  return kDone;
}

} // namespace pcl6d::app
