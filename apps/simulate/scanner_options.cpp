// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "simulate/scanner_options.h"

#include <pcl6d/scanner/scanner_presets.h>

#include <cmath>

namespace pcl6d::app {
std::string
scannerList()
{
  std::string list;
  for (const auto& name : scannerNames())
    list += "\n  " + name + ": " + scannerDescription(name);
  return list;
}

void
describeScanner(CommandLine& line, ScannerWords& words)
{
  namespace po = boost::program_options;
  line.group("Scanner").add_options()                            //
      ("scanner", valueOf(words.name), "by its name, see above") //
      ("resolution",
       valueOf(words.resolution),
       "[deg] between samples and lines; auto: the scanner's") //
      ("noise",
       valueOf(words.noise),
       "[m] standard deviation of the ranges, apart from what grows with range or "
       "angle; auto: the scanner's") //
      ("max-range",
       valueOf(words.max_range),
       "[m] farther things are not seen; auto: what suits the scene for rotating, the "
       "scanner's for all others") //
      ("exact",
       po::bool_switch(&words.exact),
       "one ideal ray per sample and true ranges; with --noise: that noise and no "
       "other error");
}

void
applyScanner(const ScannerWords& words, double scene_range, SimulationOptions& options)
{
  checkOptions([&] {
    std::optional<double> resolution;
    if (!words.resolution.is_auto)
      resolution = words.resolution.value * M_PI / 180;
    const ScannerPreset preset = scannerByName(words.name, resolution);
    const unsigned num_threads = options.range.num_threads;
    options.scanner = preset.scanner;
    options.range = words.exact ? preset.range.withoutErrors() : preset.range;
    options.range.num_threads = num_threads;
  });
  if (!words.noise.is_auto)
    options.range.noise = words.noise.value;
  if (!words.max_range.is_auto)
    options.range.max_range = words.max_range.value;
  else if (words.name == ScannerWords().name)
    options.range.max_range = scene_range;
}

} // namespace pcl6d::app
