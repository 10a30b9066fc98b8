// SPDX-License-Identifier: BSD-3-Clause
#include "semantic_map/finished_run.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/pose_graph_io.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/run/run_summary.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>

namespace pcl6d::app {
namespace {
namespace fs = std::filesystem;

using Information = Eigen::Matrix<double, 6, 6>;

/** \return the cells of a row; those in double quotes may hold commas */
std::vector<std::string>
cellsOf(const std::string& row)
{
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : row)
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  return cells;
}

/** The rows of links.csv by the names of its columns. */
class LinkTable {
public:
  explicit LinkTable(const fs::path& file) : file_(file.string()), stream_(file)
  {
    std::string header;
    std::getline(stream_, header);
    columns_ = cellsOf(header);
    for (const char* const name : {"from", "to", "kind", "verdict", "pairs", "rms"})
      if (std::find(columns_.begin(), columns_.end(), name) == columns_.end())
        throw IoFailed(file_ + ": line 1: has no column '" + name + "'");
  }

  bool
  next()
  {
    std::string row;
    do {
      if (!std::getline(stream_, row))
        return false;
      ++line_;
    } while (row.empty());
    cells_ = cellsOf(row);
    if (cells_.size() != columns_.size())
      fail("expected " + std::to_string(columns_.size()) + " columns, got " +
           std::to_string(cells_.size()));
    return true;
  }

  const std::string&
  text(const std::string& column) const
  {
    const auto place = std::find(columns_.begin(), columns_.end(), column);
    return cells_[static_cast<std::size_t>(place - columns_.begin())];
  }

  template <typename Number>
  Number
  number(const std::string& column) const
  {
    const std::string& cell = text(column);
    Number number{};
    const auto [end, error] =
        std::from_chars(cell.data(), cell.data() + cell.size(), number);
    if (error != std::errc() || end != cell.data() + cell.size() || !(number >= 0))
      fail(column + " = '" + text(column) + "', but must be a number >= 0");
    return number;
  }

  [[noreturn]] void
  fail(const std::string& message) const
  {
    throw IoFailed(file_ + ": line " + std::to_string(line_) + ": " + message);
  }

private:
  std::string file_;
  std::ifstream stream_;
  std::size_t line_ = 1;
  std::vector<std::string> columns_;
  std::vector<std::string> cells_;
};

/** \return the information of the links of a graph by the ids of their scans */
std::map<std::pair<std::size_t, std::size_t>, Information>
informationOf(const fs::path& file)
{
  std::map<std::pair<std::size_t, std::size_t>, Information> all;
  if (!fs::exists(file))
    return all;
  const PoseGraph graph = readPoseGraph(file);
  const auto id = [&](std::size_t vertex) {
    return graph.ids.empty() ? vertex : graph.ids[vertex];
  };
  for (const auto& link : graph.links)
    all[{id(link.from), id(link.to)}] = link.information;
  return all;
}
} // namespace

FinishedRun::FinishedRun(const fs::path& folder) : folder_(folder)
{
  const fs::path file = folder / "summary.json";
  const RunResult summary = readRunSummary(file);
  if (!summary.complete)
    throw IoFailed(file.string() + ": the run was interrupted; run it again");
  world_offset_ = summary.world_offset;
  for (const auto& scan : summary.scans) {
    if (scan.index < 0)
      throw IoFailed(file.string() + ": " + scan.file +
                     ": index = " + std::to_string(scan.index) + ", but must be >= 0");
    scans_.push_back({static_cast<std::size_t>(scan.index),
                      scan.file,
                      scan.T_world_scan,
                      scan.covariance});
  }
  std::sort(scans_.begin(), scans_.end(), [](const MapScan& a, const MapScan& b) {
    return a.id < b.id;
  });
}

std::vector<MapLink>
FinishedRun::readLinks() const
{
  const fs::path file = folder_ / "links.csv";
  if (!fs::exists(file))
    return {};
  const auto information = informationOf(folder_ / "graph.g2o");
  SemanticMap known;
  known.scans = scans_;
  std::vector<MapLink> links;
  for (LinkTable table(file); table.next();) {
    if (table.text("verdict") == "refused")
      continue;
    MapLink link;
    link.from = table.number<std::size_t>("from");
    link.to = table.number<std::size_t>("to");
    for (const auto id : {link.from, link.to})
      if (!known.placeOf({EntityKind::kScan, id}))
        table.fail("the run has no scan " + std::to_string(id));
    link.kind = table.text("kind");
    link.pairs = table.number<std::size_t>("pairs");
    // of links without pairs there is no rms
    if (table.text("rms").find("nan") == std::string::npos)
      link.rms = table.number<double>("rms");
    const auto found = information.find({link.from, link.to});
    if (found != information.end())
      link.information = found->second;
    links.push_back(link);
  }
  return links;
}

Scan
FinishedRun::readMap() const
{
  return pcl6d::readScan(folder_ / "map.pcd");
}

Scan
FinishedRun::readScan(std::size_t place) const
{
  const int index = static_cast<int>(scans_[place].id);
  return pcl6d::readScan(folder_ / "scans" / (scanName(index) + ".pcd"));
}

} // namespace pcl6d::app
