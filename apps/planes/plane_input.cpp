// SPDX-License-Identifier: BSD-3-Clause
#include "common/open_scans.h"
#include "planes/plane_input.h"

#include <pcl6d/common/error.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/slam6d/auto_parameters.h>
#include <pcl6d/slam6d/map_builder.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <sstream>

namespace pcl6d::app {

namespace {
constexpr std::size_t kScansForParameters = 16;

/** Range gate and voxel, those that the user left open derived as pcl_slam6d does. */
Slam6DParameters
parametersOf(const PlaneSettings& s, const std::vector<Points>& scans)
{
  Slam6DOptions options;
  options.min_range = s.min_range;
  options.max_range = s.max_range;
  options.voxel = s.voxel;
  Slam6DParameters parameters;
  checkOptions([&] {
    options.validate();
    parameters = deriveParameters(options, scans);
  });
  return parameters;
}

void
say(ProgressBar& bar, const std::string& name, const Parameter& parameter)
{
  std::ostringstream line;
  line << "  " << name << " = " << parameter.value << " m ("
       << (parameter.given ? "given" : "auto: " + parameter.why) << ")";
  bar.say(line.str());
}

/** What lies outside the range gate becomes NaN. */
void
dropOutOfRange(const Slam6DParameters& parameters, Points& points)
{
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (auto& p : points)
    if (!isWithinRange(p, parameters.min_range.value, parameters.max_range.value))
      p.setConstant(kNan);
}

/** The points of a PCD file with all those without a measurement, which keep an organized
 * one on its grid. \return nothing for other files, and for one without coordinates */
std::optional<PlaneStepCloud>
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
  PlaneStepCloud cloud;
  cloud.width = file.height > 1 ? file.width : 0;
  for (std::size_t i = 0; i < x->values.size(); ++i)
    cloud.points.push_back(
        Eigen::Vector3d(x->values[i], y->values[i], z->values[i]).cast<float>());
  return cloud;
}

PlaneStepCloud
readOne(const PlaneSettings& s, ProgressBar& bar)
{
  PlaneStepCloud cloud;
  if (auto grid = readGrid(s))
    cloud = *std::move(grid);
  else
    cloud.points = readScan(s.input, s.folder.format).points;
  const Slam6DParameters parameters = parametersOf(s, {cloud.points});
  say(bar, "min-range", parameters.min_range);
  say(bar, "max-range", parameters.max_range);
  if (cloud.width > 1)
    dropOutOfRange(parameters, cloud.points);
  else
    cloud.points = gateByRange(
        cloud.points, parameters.min_range.value, parameters.max_range.value);
  return cloud;
}

/** Joins the scans of a folder. */
class FolderReader {
public:
  FolderReader(const PlaneSettings& settings, ProgressBar& bar)
  : settings_(settings), bar_(bar), scans_(openScans(settings.input, settings.folder))
  {}

  std::optional<PlaneStepCloud>
  read(const Interrupt& interrupt)
  {
    bar_.say(std::to_string(scans_.folder().size()) + " scans, poses from " +
             scans_.poseSource());
    if (!deriveLengths(interrupt))
      return {};
    MapBuilder map(parameters_.voxel.value, scans_.worldOffset());
    std::vector<Eigen::Isometry3d> poses;
    for (std::size_t i = 0; i < scans_.folder().size(); ++i) {
      if (interrupt.requested())
        return {};
      poses.push_back(scans_.pose(i));
      Points points = scans_.folder().read(i).points;
      dropOutOfRange(parameters_, points);
      map.addScan(points, {}, poses.back(), static_cast<std::uint32_t>(i));
      bar_.show({"reading", i + 1, scans_.folder().size()});
    }
    return planeCloudOf(map, poses, scans_.worldOffset());
  }

private:
  bool
  deriveLengths(const Interrupt& interrupt)
  {
    std::vector<Points> first;
    for (std::size_t i = 0; i < std::min(scans_.folder().size(), kScansForParameters);
         ++i) {
      if (interrupt.requested())
        return false;
      first.push_back(scans_.folder().read(i).points);
    }
    PlaneSettings settings = settings_;
    if (scans_.summary()) { // the run knows its range gate
      settings.min_range = settings.min_range.value_or(scans_.minRange());
      settings.max_range = settings.max_range.value_or(scans_.maxRange());
    }
    parameters_ = parametersOf(settings, first);
    if (!scans_.summary()) {
      say(bar_, "min-range", parameters_.min_range);
      say(bar_, "max-range", parameters_.max_range);
    }
    if (!parameters_.voxel.given) {
      parameters_.voxel.value = planeVoxel(parameters_.voxel.value);
      parameters_.voxel.why = "a third of the voxel that matching would take";
    }
    say(bar_, "voxel", parameters_.voxel);
    return true;
  }

  const PlaneSettings& settings_;
  ProgressBar& bar_;
  const RegisteredScans scans_;
  Slam6DParameters parameters_;
};
} // namespace

std::optional<PlaneStepCloud>
readPlaneInput(const PlaneSettings& settings,
               ProgressBar& bar,
               const Interrupt& interrupt)
{
  if (std::filesystem::is_directory(settings.input))
    return FolderReader(settings, bar).read(interrupt);
  return readOne(settings, bar);
}

} // namespace pcl6d::app
