// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_json.h"
#include "report/report_page.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>
#include <pcl6d/visualization/report.h>

#include <algorithm>
#include <ostream>
#include <string_view>
#include <utility>

namespace pcl6d {
using namespace visualization;

namespace {
namespace fs = std::filesystem;

/** Broken files are named in the report, which shows the rest. */
template <typename Read>
auto
readOrTell(const Read& read, ReportData& data) -> decltype(read())
{
  try {
    return read();
  } catch (const IoFailed& error) {
    data.missing.push_back(error.what());
    data.is_damaged = true;
    return {};
  }
}

std::string
titleOf(const std::string& name)
{
  if (name == "top_view.png")
    return "The map and both trajectories from above";
  if (name == "planes.png")
    return "Planes and their labels";
  std::string title = fs::path(name).stem().string();
  std::replace(title.begin(), title.end(), '_', ' ');
  return title;
}

/** \return the pictures of a run by their paths in its folder, the top view first */
std::vector<std::string>
pictureNames(const fs::path& run)
{
  std::vector<std::string> names;
  for (const auto& folder : {run, run / "pictures"}) {
    std::error_code error; // a folder that cannot be listed has no pictures
    for (const auto& entry : fs::directory_iterator(folder, error))
      if (entry.path().extension() == ".png" && entry.is_regular_file(error))
        names.push_back(entry.path().lexically_relative(run).string());
  }
  std::sort(names.begin(), names.end(), [](const auto& a, const auto& b) {
    return std::make_pair(a != "top_view.png", a) <
           std::make_pair(b != "top_view.png", b);
  });
  return names;
}

/** \return the bytes of a picture, never empty \throws IoFailed the file cannot be read
 * or is no picture */
std::string
readPng(const fs::path& folder, const std::string& name)
{
  std::string bytes = text::readFile(folder / name);
  if (bytes.rfind("\x89PNG\r\n\x1a\n", 0) != 0)
    throw IoFailed(name + " is no picture");
  return bytes;
}

void
gatherPictures(const fs::path& folder, std::size_t budget, ReportData& data)
{
  for (const auto& name : pictureNames(folder)) {
    std::error_code error;
    const auto size = fs::file_size(folder / name, error);
    if (error || size > budget) {
      data.missing.push_back(name + " is too large for this page");
      continue;
    }
    std::string png = readOrTell([&] { return readPng(folder, name); }, data);
    if (png.empty())
      continue;
    budget -= png.size();
    data.pictures.push_back({name, titleOf(name), std::move(png)});
  }
}

void
check(const RunMap& map)
{
  for (const auto& [count, what] : {std::pair(map.scans.size(), "scan indices"),
                                    std::pair(map.intensities.size(), "intensities")})
    if (count != 0 && count != map.points.size())
      throw BadArgument("a map of " + std::to_string(map.points.size()) +
                        " points with " + std::to_string(count) + ' ' + what);
}

void
check(const RunResult& run)
{
  if (run.moving && run.moving->points.size() != run.scans.size())
    throw BadArgument("a run of " + std::to_string(run.scans.size()) +
                      " scans with dynamic points of " +
                      std::to_string(run.moving->points.size()));
}
} // namespace

void
ReportOptions::validate() const
{
  require(max_points > 0, "max_points", max_points, "> 0");
}

ReportData
gatherReport(const RunFolder& run,
             const std::string& title,
             const ReportOptions& options)
{
  ReportData data;
  std::error_code error;
  data.title =
      title.empty() ? fs::canonical(run.path(), error).filename().string() : title;
  data.summary = run.summary();
  data.summary.links = readOrTell([&] { return run.readLinks(); }, data);
  data.map = readOrTell([&] { return run.readMap(); }, data);
  data.moving = readOrTell([&] { return run.readMoving(); }, data);
  data.planes = readOrTell([&] { return run.readPlanes(); }, data);
  data.objects = readOrTell([&] { return run.readObjects(); }, data);
  addFolder(run, data, options);
  return data;
}

void
addFolder(const RunFolder& run, ReportData& data, const ReportOptions& options)
{
  const std::vector<std::string> broken = std::exchange(data.missing, {});
  for (const auto& name : run.missing())
    data.missing.push_back("missing: " + name);
  data.missing.insert(data.missing.end(), broken.begin(), broken.end());
  gatherPictures(run.path(), options.max_picture_bytes, data);
}

void
writeReport(const fs::path& path, const ReportData& data, const ReportOptions& options)
{
  options.validate();
  check(data.map);
  check(data.moving);
  check(data.summary);
  const std::string json = reportJson(data, options);
  const std::string_view page = kReportPage;
  const std::size_t place = page.find(kReportPlace);
  writeFileAtomically(path, [&](std::ostream& stream) {
    stream << page.substr(0, place) << json
           << page.substr(place + std::string_view(kReportPlace).size());
  });
}

} // namespace pcl6d
