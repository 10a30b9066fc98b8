// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/scanner/driven_scanner.h>
#include <pcl6d/scanner/scanner_presets.h>

#include <functional>

namespace pcl6d {
namespace {
struct Entry {
  const char* name;
  const char* description;
  std::function<ScannerPreset()> make;
};

ScannerPreset
driven(const DrivenScannerOptions& options, const RangeOptions& range = {})
{
  return {"", "", std::make_shared<DrivenScanner>(options), range};
}

const std::vector<Entry>&
entries()
{
  static const std::vector<Entry> kEntries = {
      {"pitching",
       "Kurt3D: nodding 2D scanner, 180 x 120 deg, 241 lines of 181 samples in 3.2 s",
       [] { return driven(pitchingScanner()); }},
      {"rotating",
       "upright fan turned about the vertical, 360 x 120 deg, 360 lines of 121 samples",
       [] { return driven(rotatingScanner()); }},
  };
  return kEntries;
}
} // namespace

std::vector<std::string>
scannerNames()
{
  std::vector<std::string> names;
  for (const auto& entry : entries())
    names.emplace_back(entry.name);
  return names;
}

ScannerPreset
scannerByName(const std::string& name)
{
  std::string known;
  for (const auto& entry : entries()) {
    if (entry.name == name) {
      ScannerPreset preset = entry.make();
      preset.name = entry.name;
      preset.description = entry.description;
      return preset;
    }
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw BadArgument("scanner = " + name + ", but must be one of " + known);
}

} // namespace pcl6d
