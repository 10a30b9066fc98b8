// SPDX-License-Identifier: BSD-3-Clause
#include "graph/pose_graph_row.h"

#include <pcl6d/io/link_list_io.h>
#include <pcl6d/io/pose_graph_io.h>
#include <pcl6d/io/text.h>

#include <string_view>

namespace pcl6d {

using namespace io;

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
/** \return whether the first word of a file is a word of a pose graph */
bool
isGraph(const std::string& content)
{
  for (text::Lines lines(content); lines.next();) {
    const std::string_view word = text::Tokens(lines.line()).next();
    if (!word.empty() && word.front() != '#')
      return word == "FIX" || graphTag(word) != nullptr;
  }
  return false;
}
} // namespace

std::vector<std::pair<std::size_t, std::size_t>>
readLinkList(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  if (isGraph(content))
    return linksOfGraph(path);
  Links links;
  for (text::Lines lines(content); lines.next();) {
    text::Tokens tokens(lines.line());
    const std::string_view first = tokens.next(), second = tokens.next();
    if (first.empty() || first.front() == '#')
      continue;
    std::size_t a = 0, b = 0;
    if (!text::parseNumber(first, a) || !text::parseNumber(second, b))
      text::failAt(path,
                   lines.number(),
                   "expected the indices of two scans, got " +
                       text::quoted(lines.line()));
    if (a == b)
      text::failAt(
          path, lines.number(), "scan " + std::to_string(a) + " is linked to itself");
    links.emplace_back(a, b);
  }
  return links;
}

} // namespace pcl6d
