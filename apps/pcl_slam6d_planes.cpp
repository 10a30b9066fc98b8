// SPDX-License-Identifier: BSD-3-Clause
// A scan or a map in, its planes out: options, then the plane step, then files.
#include "common/app.h"
#include "common/interrupt.h"
#include "common/output_folder.h"
#include "common/progress_bar.h"
#include "planes/plane_input.h"

#include <iostream>

namespace {
using namespace pcl6d;

app::OutputRules
outputRules(const app::PlaneSettings& settings)
{
  app::OutputRules rules;
  rules.folder = settings.out;
  rules.inputs = {settings.input, settings.folder.poses_file};
  rules.program = app::kPlanes;
  rules.marker = "planes.json";
  rules.files = std::regex(app::planeFilePattern());
  rules.force = settings.force;
  return rules;
}

void
explain(const app::PlaneStepResult& result)
{
  for (std::size_t i = 0; i < result.segments.planes.size(); ++i)
    std::cout << "plane " << i + 1 << ": " << explanationText(result.interpretation, i)
              << '\n';
}

int
run(const std::vector<std::string>& arguments)
{
  app::PlaneSettings settings;
  if (!app::parsePlaneSettings(arguments, settings))
    return app::kDone;
  const app::Interrupt interrupt;
  app::ProgressBar bar(settings.quiet);
  if (!settings.without_effect.empty())
    bar.warn(settings.without_effect);
  app::OutputFolder out(outputRules(settings));
  const auto cloud = app::readPlaneInput(settings, bar, interrupt);
  if (!cloud) {
    bar.say("interrupted while reading; nothing is written");
    return app::kInterrupted;
  }
  const app::PlaneStepResult result =
      app::findPlanes(*cloud, settings.step, settings.num_threads);
  for (const auto& warning :
       app::writePlaneFiles(out, *cloud, result, settings.step, app::kPlanes))
    bar.warn(warning);
  const auto written = out.publish();
  if (settings.quiet)
    return app::kDone;
  if (settings.verbose && settings.step.labels)
    explain(result);
  std::cout << app::planeTable(result);
  for (const auto& path : written)
    std::cout << "  " << path.string() << '\n';
  std::cout << std::flush;
  return app::kDone;
}
} // namespace

int
main(int argc, char** argv)
{
  return app::runMain(app::kPlanes, argc, argv, run);
}
