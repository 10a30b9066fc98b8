// SPDX-License-Identifier: BSD-3-Clause
// A scan or a map in, its planes out: options, then PlaneFinder, then files.
#include "common/app.h"
#include "common/open_scans.h"
#include "common/output/folder_job.h"
#include "common/output/plane_files.h"
#include "planes/plane_settings.h"

#include <pcl6d/common/error.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/far_points.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_reader.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>

namespace {
using namespace pcl6d;
using app::PlaneSettings;

/** The points of a PCD file, with invalid points to keep an organized cloud on its
 * grid. \return nullopt for other formats, and for files without coordinates */
std::optional<SceneCloud>
readGrid(const PlaneSettings& s)
{
  const ScanFormat format = s.folder.format == ScanFormat::kAuto
                                ? scanFormatOfExtension(s.input)
                                : s.folder.format;
  if (format != ScanFormat::kPcd)
    return {};
  const pcl::PCLPointCloud2 file = readPcd(s.input);
  const auto x = fieldValues(file, "x");
  const auto y = fieldValues(file, "y");
  const auto z = fieldValues(file, "z");
  if (!x || !y || !z)
    return {};
  SceneCloud cloud;
  cloud.width = file.height > 1 ? file.width : 0;
  cloud.world_offset = offsetOfFar(file);
  for (std::size_t i = 0; i < x->values.size(); ++i) {
    const Eigen::Vector3d p(x->values[i], y->values[i], z->values[i]);
    cloud.points.push_back((p - cloud.world_offset).cast<float>());
  }
  return cloud;
}

/** A single scan with every point, moved near the origin. */
SceneCloud
readAll(const PlaneSettings& s, app::ProgressBar& bar)
{
  SceneCloud cloud;
  if (auto grid = readGrid(s)) {
    cloud = *std::move(grid);
  }
  else {
    NearScan scan = readNearScan(s.input, s.folder.format);
    cloud.points = std::move(scan.points);
    cloud.world_offset = scan.offset;
  }
  if (!cloud.world_offset.isZero(0))
    bar.warn("points lie far from the origin of their coordinates" +
             describeMove(cloud.world_offset));
  return cloud;
}

void
sayGate(const ScanParameters& parameters, app::ProgressBar& bar)
{
  bar.say(app::parameterLine("min-range", parameters.min_range));
  bar.say(app::parameterLine("max-range", parameters.max_range));
}

/** A single scan without points outside the range gate. */
SceneCloud
readOne(const PlaneSettings& s,
        const ScanParameterOptions& given,
        app::ProgressBar& bar)
{
  SceneCloud cloud = readAll(s, bar);
  const ScanParameters parameters = deriveScanParameters(given, {cloud.points});
  sayGate(parameters, bar);
  const double min_range = parameters.min_range.value;
  const double max_range = parameters.max_range.value;
  if (cloud.width > 1)
    maskOutOfRange(min_range, max_range, cloud.points);
  else
    cloud.points = gateByRange(cloud.points, min_range, max_range);
  return cloud;
}

/** Reads the input; a folder with one point per voxel of the map.
 * \throws UsageError an option is invalid \throws Interrupted */
SceneCloud
readInput(const PlaneSettings& s, app::FolderJob& job)
{
  const ScanParameterOptions given{s.min_range, s.max_range, s.voxel, {}};
  app::checkOptions([&] { given.validate(); });
  if (!std::filesystem::is_directory(s.input))
    return readOne(s, given, job.bar);
  const RegisteredScans scans = app::openScans(s.input, s.folder, job.bar);
  const ScanParameters parameters =
      sceneParameters(scans, given, app::watched(job.interrupt));
  if (!scans.summary())
    sayGate(parameters, job.bar);
  job.bar.say(app::parameterLine("voxel", parameters.voxel));
  return joinScans(scans, parameters, app::watched(job.bar, job.interrupt));
}

app::OutputRules
outputRules(const PlaneSettings& settings)
{
  app::OutputRules rules;
  rules.folder = settings.out;
  rules.inputs = {settings.input, settings.folder.poses_file, settings.rules_file};
  rules.program = app::kPlanes;
  rules.marker = "planes.json";
  rules.files = std::regex(app::planeFilePattern());
  rules.force = settings.force;
  return rules;
}

void
explain(const FoundPlanes& found)
{
  for (std::size_t i = 0; i < found.segments.planes.size(); ++i)
    std::cout << "plane " << i + 1 << ": " << explanationText(found.interpretation, i)
              << '\n';
}

/** For people: the largest 40. */
void
printTable(const FoundPlanes& found)
{
  constexpr std::size_t kMostRows = 40;
  const auto& planes = found.segments.planes;
  std::printf("%zu planes in %.3f s, %zu points on none\n",
              planes.size(),
              found.seconds,
              found.segments.unassigned.size());
  if (!planes.empty())
    std::printf("   id  label       area [m^2]   points  rms [m]  normal\n");
  for (std::size_t i = 0; i < std::min(planes.size(), kMostRows); ++i) {
    const Plane& p = planes[i].plane;
    std::printf("%5zu  %-10s %11.3f %8zu  %7.4f  %6.3f %6.3f %6.3f\n",
                i + 1,
                p.label.c_str(),
                p.area,
                p.inliers,
                p.rms,
                p.normal.x(),
                p.normal.y(),
                p.normal.z());
  }
  if (planes.size() > kMostRows)
    std::printf("  ... and %zu smaller planes in planes.json\n",
                planes.size() - kMostRows);
}

/** Fewer than three points have no planes; without any point the input is empty. */
void
requirePoints(const PlaneSettings& s, const SceneCloud& cloud)
{
  if (std::none_of(cloud.points.begin(), cloud.points.end(), [](const auto& p) {
        return p.allFinite();
      }))
    throw IoFailed(s.input +
                   ": no point with finite coordinates within the range gate");
}

int
run(const std::vector<std::string>& arguments)
{
  PlaneSettings s;
  if (!app::parsePlaneSettings(arguments, s))
    return app::kDone;
  app::FolderJob job(s.quiet, s.without_effect, outputRules(s));
  const app::MemoryBudget memory(s.memory, job.out->staging());
  try {
    const SceneCloud cloud = readInput(s, job);
    requirePoints(s, cloud);
    const PlaneFinder finder(s.step);
    const FoundPlanes found = finder.find(cloud);
    finder.write(job.out->staging(), cloud, found, app::kPlanes);
    job.publish([&] {
      if (s.verbose && s.step.labels)
        explain(found);
      printTable(found);
    });
    const bool is_drawn = job.draw("planes.png", [&](const auto& picture) {
      app::drawPlanes(picture, cloud, found);
    });
    return is_drawn ? app::kDone : app::kDoubtful;
  } catch (const app::Interrupted&) {
    job.bar.say("interrupted while reading; nothing is written");
    return app::kInterrupted;
  }
}
} // namespace

int
main(int argc, char** argv)
{
  return app::runMain(app::kPlanes, argc, argv, run);
}
