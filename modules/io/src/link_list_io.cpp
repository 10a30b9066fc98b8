// SPDX-License-Identifier: BSD-3-Clause
#include "text.h"

#include <pcl6d/io/link_list_io.h>
#include <pcl6d/io/pose_graph_io.h>

#include <sstream>

namespace pcl6d {

namespace {
using Links = std::vector<std::pair<std::size_t, std::size_t>>;

Links
linksOfGraph(const std::filesystem::path& path)
{
  const PoseGraph graph = readPoseGraph(path);
  const auto id = [&](std::size_t vertex) {
    return graph.ids.empty() ? vertex : graph.ids[vertex];
  };
  Links links;
  for (const PoseLink& link : graph.links)
    links.emplace_back(id(link.from), id(link.to));
  return links;
}
} // namespace

std::vector<std::pair<std::size_t, std::size_t>>
readLinkList(const std::filesystem::path& path)
{
  if (path.extension() == ".g2o")
    return linksOfGraph(path);
  std::ifstream file = text::open(path);
  Links links;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    std::istringstream words(line);
    std::string first;
    if (!(words >> first) || first.front() == '#')
      continue;
    std::istringstream numbers(line);
    long long a = -1, b = -1;
    if (!(numbers >> a >> b) || a < 0 || b < 0)
      text::failAt(
          path, number, "expected the indices of two scans, got " + text::quoted(line));
    if (a == b)
      text::failAt(path, number, "scan " + std::to_string(a) + " is linked to itself");
    links.emplace_back(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  }
  return links;
}

} // namespace pcl6d
