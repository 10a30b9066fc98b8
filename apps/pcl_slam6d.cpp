// SPDX-License-Identifier: BSD-3-Clause
// A folder of scans with rough poses in, a registered map out: options, then Slam6D, then
// files.
#include "common/app.h"
#include "common/interrupt.h"
#include "common/output_folder.h"
#include "common/progress_bar.h"
#include "slam6d/run_writer.h"
#include "slam6d/settings.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/slam6d/slam6d.h>

#include <pcl/console/print.h>

#include <chrono>
#include <iostream>
#include <sstream>

namespace {
using namespace pcl6d;
using app::Settings;

constexpr const char* kName = "pcl_slam6d";

/** Reads all scans into the chain. \return false if interrupted */
bool
readScans(const ScanFolder& folder,
          const app::Interrupt& interrupt,
          app::ProgressBar& bar,
          Slam6D& slam,
          app::Run& run)
{
  const app::StageTimer timer("reading", run);
  for (std::size_t i = 0; i < folder.size(); ++i) {
    if (interrupt.requested())
      return false;
    const Scan scan = folder.read(i);
    const std::string file = folder.file(i).string();
    if (scan.points.size() < 3)
      throw IoFailed(file + ": " + std::to_string(scan.points.size()) +
                     " points with finite coordinates (" +
                     std::to_string(scan.dropped) +
                     " without), but at least 3 are needed");
    run.dropped.push_back(scan.dropped);
    slam.addScan(scan.points, folder.initialPose(i), file);
    bar.show({"reading", i + 1, folder.size()});
  }
  return true;
}

void
printParameters(const Slam6DParameters& parameters, app::ProgressBar& bar)
{
  for (const auto& [name, parameter] : app::named(parameters)) {
    std::ostringstream line;
    line << "  " << name << " = " << parameter.value << " m ("
         << (parameter.given ? "given" : "auto: " + parameter.why) << ")";
    bar.say(line.str());
  }
}

/** Registers all scans. \return false if interrupted */
bool
match(const Settings& settings,
      const ScanFolder& folder,
      const app::Interrupt& interrupt,
      app::ProgressBar& bar,
      Slam6D& slam,
      app::Run& run)
{
  const app::StageTimer timer("matching", run);
  slam.setProgressCallback([&](const Progress& progress) { bar.show(progress); });
  slam.setObserver([&](std::size_t i, const ScanResult& scan) {
    if (i == 0)
      printParameters(slam.result().parameters, bar);
    if (interrupt.requested())
      slam.cancel();
    if (!settings.verbose)
      return;
    std::ostringstream line;
    line << folder.file(i).filename().string() << ": " << toString(scan.state) << " ("
         << toString(scan.status) << "), " << scan.iterations << " iterations, "
         << scan.pairs << " pairs, rms " << scan.rms << " m, overlap " << scan.overlap;
    bar.say(line.str());
  });
  return slam.optimize();
}

/** A selection that holds no scan is a mistake of the command line. */
ScanFolder
openFolder(const Settings& settings)
try {
  return ScanFolder(settings.input, settings.folder);
} catch (const BadArgument& e) {
  throw app::UsageError(e.what());
}

int
run(const Settings& settings)
{
  const app::Interrupt interrupt;
  app::ProgressBar bar(settings.quiet);
  app::Run run;
  const ScanFolder folder = openFolder(settings);
  app::OutputFolder out(settings.out, settings.input, app::kRunMarker, settings.force);
  bar.say(std::to_string(folder.size()) + " scans, initial poses from " +
          folder.poseSource());

  Slam6D slam(settings.slam);
  if (!readScans(folder, interrupt, bar, slam, run)) {
    bar.say("interrupted while reading; nothing is written");
    return app::kInterrupted;
  }
  const bool complete = match(settings, folder, interrupt, bar, slam, run);

  app::writeRun(settings, folder, slam.result(), complete, bar, out, run);
  out.commit();
  if (!settings.quiet)
    std::cout << app::closingText(run.summary, out) << std::flush;
  if (!complete)
    return app::kInterrupted;
  return slam.result().trusted() ? app::kDone : app::kDoubtful;
}
} // namespace

int
main(int argc, char** argv)
{
  return app::runMain(kName, argc, argv, [](const std::vector<std::string>& arguments) {
    Settings settings;
    if (!app::parseSettings(arguments, settings))
      return static_cast<int>(app::kDone);
    if (settings.verbose)
      pcl::console::setVerbosityLevel(pcl::console::L_INFO);
    return run(settings);
  });
}
