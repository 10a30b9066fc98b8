// SPDX-License-Identifier: BSD-3-Clause
#include "e57/e57_cloud.h"

#include <pcl6d/common/require.h>
#include <pcl6d/io/far_points.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/text.h>
#include <pcl6d/sources/e57_source.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace pcl6d {

using namespace sources;

struct E57Source::Content {
  std::filesystem::path path;
  std::vector<E57Scan> file_scans;
  std::vector<SourceScan> scans;
};

namespace {

/** \return the name in one line, valid as a file name, the form expected by the summary of a run
 */
std::string
nameAsOfFile(std::string name)
{
  for (char& c : name)
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0)
      c = ' ';
    else if (c == '/')
      c = '_';
  return name == "." || name == ".." ? std::string() : name;
}

/** \return pairwise different names */
std::vector<std::string>
distinctNames(const std::vector<E57Scan>& scans)
{
  std::vector<std::string> names;
  std::set<std::string> known;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    std::string name = nameAsOfFile(scans[i].name);
    if (name.empty())
      name = scanName(static_cast<int>(i));
    while (!known.insert(name).second)
      name += " (" + std::to_string(i) + ")";
    names.push_back(name);
  }
  return names;
}

bool
startsAscend(const std::vector<E57Scan>& scans)
{
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (!scans[i].start || (i > 0 && *scans[i].start <= *scans[i - 1].start))
      return false;
  return true;
}

std::vector<SourceScan>
sourceScans(const std::vector<E57Scan>& scans)
{
  const bool has_stamps = startsAscend(scans);
  const bool has_poses =
      std::any_of(scans.begin(), scans.end(), [](const E57Scan& scan) {
        return scan.pose.has_value();
      });
  const std::vector<std::string> names = distinctNames(scans);
  std::vector<SourceScan> list;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    SourceScan one;
    one.name = names[i];
    if (has_poses)
      one.pose = scans[i].pose.value_or(Eigen::Isometry3d::Identity());
    if (has_stamps)
      one.stamp = scans[i].start;
    for (const auto& field : scans[i].fields)
      one.fields.push_back(field.name);
    one.num_points = scans[i].count;
    list.push_back(std::move(one));
  }
  return list;
}

/** \return whether float may be too coarse for the stored coordinates */
bool
hasFineCoordinates(const E57Scan& scan)
{
  const auto x = scan.find("cartesianX");
  return x && scan.fields[*x].kind != E57Kind::kSingle;
}

} // namespace

E57Source::E57Source(const std::filesystem::path& path)
{
  PageReader file(path);
  auto content = std::make_unique<Content>();
  content->path = path;
  content->file_scans = readE57Layout(file);
  if (content->file_scans.empty())
    text::fail(path, "holds no scan");
  content->scans = sourceScans(content->file_scans);
  content_ = std::move(content);
}

E57Source::~E57Source() = default;

const std::filesystem::path&
E57Source::path() const
{
  return content_->path;
}

std::string
E57Source::format() const
{
  return "e57";
}

const std::vector<SourceScan>&
E57Source::scans() const
{
  return content_->scans;
}

ScanCloud
E57Source::read(std::size_t i) const
{
  require(i < content_->scans.size(),
          "scan",
          i,
          "below " + std::to_string(content_->scans.size()));
  PageReader file(content_->path);
  const E57Scan& scan = content_->file_scans[i];
  const std::string title = scan.title(i);
  ScanCloud cloud = readE57Cloud(file, scan, title, Coordinates::kFloat);
  if (hasFineCoordinates(scan) && !offsetOfFar(cloud.cloud).isZero(0))
    cloud = readE57Cloud(file, scan, title, Coordinates::kDouble);
  return cloud;
}

} // namespace pcl6d
