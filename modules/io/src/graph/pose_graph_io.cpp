// SPDX-License-Identifier: BSD-3-Clause
#include "graph/pose_graph_row.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/information.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/pose_graph_io.h>

#include <algorithm>
#include <numeric>
#include <ostream>
#include <set>
#include <unordered_map>

namespace pcl6d {

using namespace io;

namespace {
namespace fs = std::filesystem;
using Index = std::unordered_map<std::size_t, std::size_t>; // from id to vertex

/** A file's content with ids instead of indices. */
struct Rows {
  std::vector<std::size_t> ids; ///< of the vertices, in their order
  Index index;
  std::vector<Eigen::Isometry3d> poses;
  std::vector<PoseLink> links;
  std::vector<std::size_t> lines; ///< of each link
  /** Ids in lines FIX, with their lines. */
  std::vector<std::pair<std::size_t, std::size_t>> fixed;
};

void
addVertex(const fs::path& path, const GraphRow& row, Rows& rows)
{
  if (!rows.index.emplace(row.ids[0], rows.ids.size()).second)
    text::failAt(
        path, row.line, "vertex " + std::to_string(row.ids[0]) + " is given twice");
  rows.ids.push_back(row.ids[0]);
  rows.poses.push_back(poseOfRow(path, row));
}

void
addLink(const fs::path& path, const GraphRow& row, Rows& rows)
{
  if (row.ids[0] == row.ids[1])
    text::failAt(path,
                 row.line,
                 "a link from vertex " + std::to_string(row.ids[0]) + " to itself");
  PoseLink link;
  link.from = row.ids[0];
  link.to = row.ids[1];
  link.T_from_to = poseOfRow(path, row);
  link.information = informationOfRow(path, row);
  rows.links.push_back(link);
  rows.lines.push_back(row.line);
}

void
addFixed(const fs::path& path,
         const text::Lines& lines,
         text::Tokens& tokens,
         Rows& rows)
{
  auto token = tokens.next();
  if (token.empty())
    text::failAt(path, lines.number(), "expected a vertex id after FIX");
  for (; !token.empty(); token = tokens.next())
    rows.fixed.emplace_back(readVertexId(path, lines, token), lines.number());
}

Rows
readRows(const fs::path& path)
{
  const std::string content = text::readFile(path);
  Rows rows;
  GraphRow row;
  for (text::Lines lines(content); lines.next();) {
    text::Tokens tokens(lines.line());
    const auto word = tokens.next();
    if (word.empty() || word.front() == '#')
      continue;
    if (word == "FIX") {
      addFixed(path, lines, tokens, rows);
      continue;
    }
    const GraphTag* const tag = graphTag(word);
    if (!tag)
      text::failAt(path,
                   lines.number(),
                   text::quoted(word) +
                       " starts no line of a 3D pose graph; known are VERTEX_SE3:QUAT, "
                       "EDGE_SE3:QUAT, FIX (g2o), VERTEX3, EDGE3 (TORO)");
    readGraphRow(path, lines, tokens, *tag, row);
    tag->is_link ? addLink(path, row, rows) : addVertex(path, row, rows);
  }
  return rows;
}

/** The vertices that the links speak of, for a file that has none. */
void
nameVertices(Rows& rows)
{
  std::set<std::size_t> ids;
  for (const auto& link : rows.links) {
    ids.insert(link.from);
    ids.insert(link.to);
  }
  rows.ids.assign(ids.begin(), ids.end());
  for (std::size_t i = 0; i < rows.ids.size(); ++i)
    rows.index.emplace(rows.ids[i], i);
}

std::size_t
vertexOf(const fs::path& path, const Rows& rows, std::size_t id, std::size_t line)
{
  const auto found = rows.index.find(id);
  if (found == rows.index.end())
    text::failAt(path, line, "there is no vertex " + std::to_string(id));
  return found->second;
}

/** \return poses along the links i -> i+1; empty if one is missing */
std::vector<Eigen::Isometry3d>
posesAlongChain(std::size_t size, const std::vector<PoseLink>& links)
{
  std::vector<const PoseLink*> next(size, nullptr);
  for (auto link = links.rbegin(); link != links.rend(); ++link)
    if (link->to == link->from + 1)
      next[link->from] = &*link; // the first in the file wins
  std::vector<Eigen::Isometry3d> poses = {Eigen::Isometry3d::Identity()};
  for (std::size_t i = 0; i + 1 < size; ++i) {
    if (!next[i])
      return {};
    poses.push_back(poses.back() * next[i]->T_from_to);
  }
  return poses;
}

/** \return poses along a breadth-first tree of each component */
std::vector<Eigen::Isometry3d>
posesAlongTrees(std::size_t size, const std::vector<PoseLink>& links)
{
  std::vector<std::vector<const PoseLink*>> links_at(size);
  for (const auto& link : links) {
    links_at[link.from].push_back(&link);
    links_at[link.to].push_back(&link);
  }
  std::vector<Eigen::Isometry3d> poses(size, Eigen::Isometry3d::Identity());
  std::vector<bool> known(size, false);
  for (std::size_t root = 0; root < size; ++root) {
    std::vector<std::size_t> queue = {root};
    if (known[root])
      continue;
    known[root] = true;
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (const PoseLink* const link : links_at[queue[next]]) {
        const bool forward = link->from == queue[next];
        const std::size_t other = forward ? link->to : link->from;
        if (known[other])
          continue;
        known[other] = true;
        poses[other] = poses[queue[next]] *
                       (forward ? link->T_from_to : link->T_from_to.inverse());
        queue.push_back(other);
      }
  }
  return poses;
}

bool
areDefaultIds(const std::vector<std::size_t>& ids)
{
  for (std::size_t i = 0; i < ids.size(); ++i)
    if (ids[i] != i)
      return false;
  return true;
}

void
checkIds(const PoseGraph& graph)
{
  if (!graph.ids.empty() && graph.ids.size() != graph.poses.size())
    throw BadArgument("a pose graph needs one id per pose, but there are " +
                      text::counted(graph.ids.size(), "id") + " and " +
                      text::counted(graph.poses.size(), "pose"));
  std::set<std::size_t> known;
  for (const std::size_t id : graph.ids)
    if (!known.insert(id).second)
      throw BadArgument("id " + std::to_string(id) + " is given twice");
}

void
checkLink(const PoseLink& link, const std::string& name, std::size_t num_poses)
{
  if (std::max(link.from, link.to) >= num_poses)
    throw BadArgument(name + " joins poses " + std::to_string(link.from) + " and " +
                      std::to_string(link.to) + ", but there are only " +
                      text::counted(num_poses, "pose"));
  if (link.from == link.to)
    throw BadArgument(name + " joins pose " + std::to_string(link.from) +
                      " with itself");
  if (!isRigid(link.T_from_to))
    throw BadArgument(name + " measures no rigid motion");
  const std::string fault = informationFault(link.information);
  if (!fault.empty())
    throw BadArgument(name + " has information that is " + fault);
}
/** \brief Refuses what readPoseGraph() would not read again. */
void
checkGraphToWrite(const PoseGraph& graph)
{
  if (graph.poses.empty())
    throw BadArgument("a pose graph needs a pose");
  checkIds(graph);
  for (std::size_t i = 0; i < graph.poses.size(); ++i)
    if (!isRigid(graph.poses[i]))
      throw BadArgument("pose " + std::to_string(i) + " is no rigid motion");
  for (std::size_t k = 0; k < graph.links.size(); ++k)
    checkLink(graph.links[k], "link " + std::to_string(k), graph.poses.size());
}

void
writeGraph(const fs::path& path,
           const PoseGraph& graph,
           const GraphTag& vertex,
           const GraphTag& edge)
{
  checkGraphToWrite(graph);
  const auto idOf = [&](std::size_t i) {
    return std::to_string(graph.ids.empty() ? i : graph.ids[i]);
  };
  std::string text;
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    text.append(vertex.name).append(" ").append(idOf(i));
    appendPose(text, vertex, graph.poses[i]);
    text += '\n';
  }
  for (const auto& link : graph.links) {
    text.append(edge.name).append(" ").append(idOf(link.from)).append(" ");
    text.append(idOf(link.to));
    appendPose(text, edge, link.T_from_to);
    appendInformation(text, edge, link.information);
    text += '\n';
  }
  writeFileAtomically(path, [&](std::ostream& stream) { stream << text; });
}
} // namespace

PoseGraph
readPoseGraph(const fs::path& path)
{
  Rows rows = readRows(path);
  const bool has_vertices = !rows.ids.empty();
  if (!has_vertices)
    nameVertices(rows);
  if (rows.ids.empty())
    text::fail(path, "holds no pose");
  for (const auto& [id, line] : rows.fixed)
    vertexOf(path, rows, id, line);
  PoseGraph graph;
  graph.links = std::move(rows.links);
  for (std::size_t k = 0; k < graph.links.size(); ++k) {
    PoseLink& link = graph.links[k];
    link.from = vertexOf(path, rows, link.from, rows.lines[k]);
    link.to = vertexOf(path, rows, link.to, rows.lines[k]);
  }
  if (has_vertices)
    graph.poses = std::move(rows.poses);
  else
    graph.poses = posesAlongChain(rows.ids.size(), graph.links);
  if (graph.poses.empty())
    graph.poses = posesAlongTrees(rows.ids.size(), graph.links);
  for (std::size_t i = 0; i < graph.poses.size(); ++i)
    if (!graph.poses[i].matrix().allFinite() || !isPlace(graph.poses[i].translation()))
      text::fail(path,
                 "the links to vertex " + std::to_string(rows.ids[i]) +
                     " add up to a position 1e9 m or farther from the origin");
  if (!areDefaultIds(rows.ids))
    graph.ids = std::move(rows.ids);
  return graph;
}

void
writePoseGraphG2o(const fs::path& path, const PoseGraph& graph)
{
  writeGraph(path, graph, *graphTag("VERTEX_SE3:QUAT"), *graphTag("EDGE_SE3:QUAT"));
}

void
writePoseGraphToro(const fs::path& path, const PoseGraph& graph)
{
  writeGraph(path, graph, *graphTag("VERTEX3"), *graphTag("EDGE3"));
}

} // namespace pcl6d
