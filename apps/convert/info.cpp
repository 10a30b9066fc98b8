// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/open_scans.h"
#include "common/options/option_table.h"
#include "common/printable.h"
#include "convert/bag_table.h"
#include "convert/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/median.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/scan_sampling.h>
#include <pcl6d/io/text.h>
#include <pcl6d/sources/bag.h>
#include <pcl6d/sources/coordinate_system.h>
#include <pcl6d/sources/open_source.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>
#include <utility>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

constexpr const char* kInfoUsage =
    R"( info FILE|FOLDER [options]
Prints the content of a scan, a folder of scans, an E57 file or a robot's recording:
topics, scans, points, fields, ranges, spacing, times, initial poses, coordinates, and
damages. Each scan is read once. Exit code 3: a scan cannot be read.
)";

/** \brief Facts printed about a scan. */
struct ScanFacts {
  std::string title;
  std::size_t points = 0;
  std::size_t dropped = 0; ///< not finite
  double nearest = 0;      ///< [m]
  double median = 0;       ///< [m]
  double farthest = 0;     ///< [m]
  double spacing = 0;      ///< [m]
  std::string fields;
  std::string sampling;
  bool has_no_return_code = false;
};

std::string
fieldsOf(const pcl::PCLPointCloud2& cloud)
{
  std::string names;
  for (const auto& field : cloud.fields)
    names += (names.empty() ? "" : " ") + field.name;
  return names;
}

ScanFacts
factsOf(const Scan& scan, const std::string& title)
{
  ScanFacts facts;
  facts.title = title;
  facts.points = scan.points.size();
  facts.dropped = scan.dropped;
  facts.fields = fieldsOf(scan.cloud);
  if (scan.points.empty())
    return facts;
  double nearest_sq = std::numeric_limits<double>::infinity(), farthest_sq = 0;
  for (const Eigen::Vector3f& point : scan.points) {
    const double range_sq = point.cast<double>().squaredNorm();
    nearest_sq = std::min(nearest_sq, range_sq);
    farthest_sq = std::max(farthest_sq, range_sq);
  }
  facts.nearest = std::sqrt(nearest_sq);
  facts.farthest = std::sqrt(farthest_sq);
  facts.median = medianRange(scan.points);
  facts.spacing = medianSpacing(scan.points);
  facts.has_no_return_code = noReturnRange(scan.points).has_value();
  const ScanSampling sampling = samplingOf(scan.points);
  facts.sampling = toString(sampling.structure);
  if (sampling.rings > 0)
    facts.sampling = std::to_string(sampling.rings) + " rings";
  return facts;
}

/** \brief Facts printed about the input, in the order of the scans. */
struct InputFacts {
  std::vector<ScanFacts> scans;
  std::vector<std::string> damage; ///< why scans cannot be read
};

void
printTable(const std::vector<ScanFacts>& scans)
{
  std::size_t width = 4;
  for (const ScanFacts& scan : scans)
    width = std::max(width, scan.title.size());
  const auto column = static_cast<int>(width);
  std::cout << std::left << std::setw(column) << "scan" << std::right << std::setw(11)
            << "points" << std::setw(9) << "dropped" << std::setw(9) << "nearest"
            << std::setw(9) << "median" << std::setw(10) << "farthest" << std::setw(9)
            << "spacing"
            << "  sampling\n"
            << std::fixed;
  for (const ScanFacts& scan : scans)
    std::cout << std::left << std::setw(column) << printable(scan.title) << std::right
              << std::setw(11) << scan.points << std::setw(9) << scan.dropped
              << std::setprecision(2) << std::setw(9) << scan.nearest << std::setw(9)
              << scan.median << std::setw(10) << scan.farthest << std::setprecision(4)
              << std::setw(9) << scan.spacing << "  " << scan.sampling << '\n';
}

/** Fields common to every scan are printed in one line. */
void
printFields(const std::vector<ScanFacts>& scans)
{
  std::map<std::string, std::vector<std::string>> by_fields;
  for (const ScanFacts& scan : scans)
    by_fields[scan.fields].push_back(scan.title);
  for (const auto& [fields, titles] : by_fields) {
    std::cout << "fields: " << printable(fields);
    if (by_fields.size() > 1)
      std::cout << " (" << text::counted(titles.size(), "scan") << ", first "
                << printable(titles.front()) << ')';
    std::cout << '\n';
  }
}

void
printTotals(const InputFacts& facts)
{
  std::size_t points = 0, codes = 0;
  std::vector<double> ranges, spacings;
  for (const ScanFacts& scan : facts.scans) {
    points += scan.points;
    codes += scan.has_no_return_code ? 1 : 0;
    if (scan.points > 0) {
      ranges.push_back(scan.median);
      spacings.push_back(scan.spacing);
    }
  }
  std::cout << text::counted(facts.scans.size() + facts.damage.size(), "scan") << ", "
            << text::counted(points, "point");
  if (!ranges.empty())
    std::cout << std::fixed << std::setprecision(2) << "; median range "
              << upperMedian(ranges) << " m, spacing " << std::setprecision(4)
              << upperMedian(spacings) << " m";
  std::cout << '\n';
  if (codes > 0)
    std::cout << "no-return codes: the largest range of "
              << text::counted(codes, "scan") << " is shared by many points\n";
  printFields(facts.scans);
}

void
printTimes(const std::vector<double>& stamps)
{
  if (stamps.empty()) {
    std::cout << "times: none\n";
    return;
  }
  const auto [first, last] = std::minmax_element(stamps.begin(), stamps.end());
  std::cout << "times: " << std::fixed << std::setprecision(3) << *first << " s to "
            << *last << " s\n";
}

void
printPoses(const ScanFolder& folder)
{
  std::cout << "initial poses: " << printable(folder.poseSource());
  if (folder.hasPoses()) {
    Eigen::Vector3d low = folder.initialPose(0).translation(), high = low;
    double longest = 0;
    for (std::size_t i = 1; i < folder.size(); ++i) {
      const Eigen::Vector3d here = folder.initialPose(i).translation();
      low = low.cwiseMin(here);
      high = high.cwiseMax(here);
      longest =
          std::max(longest, (here - folder.initialPose(i - 1).translation()).norm());
    }
    const Eigen::Vector3d extent = high - low;
    std::cout << std::fixed << std::setprecision(2) << "; extent " << extent.x()
              << " x " << extent.y() << " x " << extent.z() << " m, longest step "
              << longest << " m, first at " << std::setprecision(3)
              << folder.initialPose(0).translation().transpose();
  }
  else
    std::cout << " (none were found)";
  std::cout << '\n';
  if (folder.coordinates().empty())
    std::cout << "coordinates: in the frames of the scanners\n";
  else
    std::cout << "coordinates: " << printable(folder.coordinates()) << '\n';
}

/** The coordinate system named by a file, if any. */
void
printCoordinateSystem(const fs::path& file)
{
  const std::string wkt = coordinateSystemOf(file);
  if (!wkt.empty())
    std::cout << "coordinate system: " << printable(nameOfWkt(wkt)) << '\n';
}

InputFacts
readAll(const ScanFolder& folder)
{
  InputFacts facts;
  for (std::size_t i = 0; i < folder.size(); ++i) {
    try {
      facts.scans.push_back(factsOf(folder.read(i), folder.name(i)));
    } catch (const IoFailed& e) {
      facts.damage.emplace_back(e.what());
    }
  }
  return facts;
}

int
printFacts(const InputFacts& facts)
{
  printTable(facts.scans);
  for (const std::string& line : facts.damage)
    std::cout << "damaged: " << printable(line) << '\n';
  flushOutput();
  return facts.damage.empty() ? kDone : kDoubtful;
}
/** The topics of a recording, clouds or not. */
void
printTopics(const Bag& bag)
{
  std::size_t width = 5;
  for (const BagTopic& topic : bag.topics())
    width = std::max(width, topic.name.size());
  std::cout << printable(bag.path().string()) << ": " << bag.format() << ", "
            << text::counted(bag.messages().size(), "message");
  if (!bag.messages().empty()) {
    const std::int64_t first = bag.messages().front().time;
    const std::int64_t last = bag.messages().back().time;
    std::cout << std::fixed << std::setprecision(3) << ", "
              << static_cast<double>(last - first) * 1e-9 << " s";
  }
  std::cout << '\n';
  if (!bag.damage().empty())
    std::cout << "damaged: " << printable(bag.damage()) << '\n';
  for (const BagTopic& topic : bag.topics())
    std::cout << "topic " << std::left << std::setw(static_cast<int>(width))
              << printable(topic.name) << std::right << std::setw(9)
              << topic.num_messages << "  " << printable(topic.type) << '\n';
}

bool
hasClouds(const Bag& bag, const BagOptions& options)
{
  return !options.topic.empty() ||
         std::any_of(bag.topics().begin(), bag.topics().end(), [](const auto& topic) {
           return topic.num_messages > 0 && holdsClouds(topic);
         });
}

} // namespace

int
runInfo(const std::vector<std::string>& arguments)
{
  std::string input;
  ScanFolderOptions options;
  OptionTable table(std::string("usage: ") + kConvert + kInfoUsage);
  table.positional("FILE", &input);
  table.group("Input");
  table.add("format NAME", &options.format, scanFormatFromName)
      .help("auto|pcd|ply|uos|uosr|kitti|xyz|las|laz; auto: by extension");
  table.add("poses FILE", &options.poses_file)
      .help("poses of a folder, KITTI or TUM rows");
  addBagOptions(table, options.bag);
  if (!table.parse(arguments))
    return kDone;
  if (isBag(input)) {
    const auto bag = openBag(input);
    printTopics(*bag);
    if (!hasClouds(*bag, options.bag)) {
      std::cout << "scans: 0, no topic holds clouds\n";
      flushOutput();
      return bag->damage().empty() ? kDone : kDoubtful;
    }
  }
  if (!fs::is_directory(input) && !isSourceFile(input)) {
    InputFacts facts;
    facts.scans.push_back(
        factsOf(readScan(input, options.format), fs::path(input).filename().string()));
    printTotals(facts);
    printCoordinateSystem(input);
    return printFacts(facts);
  }
  const ScanFolder folder = openScanFolder(input, options);
  std::cout << printable(input) << ": " << folder.formatName() << '\n';
  if (folder.layout())
    std::cout << printable(describe(*folder.layout())) << "; scans in "
              << printable(folder.layout()->scans.string()) << '\n';
  const InputFacts facts = readAll(folder);
  printTotals(facts);
  printPoses(folder);
  printCoordinateSystem(folder.file(0));
  printTimes(folder.stamps());
  return printFacts(facts);
}

} // namespace pcl6d::app
