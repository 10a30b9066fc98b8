// SPDX-License-Identifier: BSD-3-Clause
#include "graph/constraint_rows.h"
#include "graph/other_graph_rows.h"
#include "graph/pose_graph_row.h"
#include "graph/poses_along_links.h"

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
constexpr std::size_t kLongestWord = 40; // of a skipped line, in messages
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
  std::vector<std::pair<std::string, std::size_t>> skipped; ///< words and their lines
  ConstraintRows constraints;
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

/** Counts a skipped line. */
void
skip(std::string_view word, Rows& rows)
{
  for (auto& [known, count] : rows.skipped)
    if (known == word.substr(0, kLongestWord)) {
      ++count;
      return;
    }
  rows.skipped.emplace_back(word.substr(0, kLongestWord), 1);
}

Rows
readRows(const fs::path& path, const PoseGraphReaderOptions& options)
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
    if (word == "PARAMS_SE3OFFSET") {
      rows.constraints.addOffset(path, lines, tokens);
      continue;
    }
    if (const ConstraintTag* const constraint = constraintTag(word)) {
      readGraphRow(path, lines, tokens, constraint->row, row);
      rows.constraints.add(path, constraint->kind, row, rows.links.size());
      if (constraint->kind == ConstraintKind::kSwitchedLink)
        addLink(path, row, rows);
      continue;
    }
    const GraphTag* const tag = graphTag(word);
    if (!tag && !options.skip_unknown)
      failAtWord(path, lines, word);
    if (!tag) {
      skip(word, rows);
      continue;
    }
    readGraphRow(path, lines, tokens, *tag, row);
    tag->is_link ? addLink(path, row, rows) : addVertex(path, row, rows);
  }
  return rows;
}

/** Creates the vertices of the links, for a file without vertices. */
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
    throw BadArgument("a pose graph needs an id per pose, but has " +
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
/** \brief Rejects graphs that readPoseGraph() would reject. */
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
checkConstraintsToWrite(const PoseGraph& graph, const GraphConstraints& constraints)
{
  const auto require = [&](std::size_t pose, const char* what) {
    if (pose >= graph.poses.size())
      throw BadArgument(std::string(what) + " pose " + std::to_string(pose) +
                        ", but there are only " +
                        text::counted(graph.poses.size(), "pose"));
  };
  for (const std::size_t pose : constraints.fixed)
    require(pose, "fixed");
  for (const PosePrior& prior : constraints.priors)
    require(prior.pose, "prior of");
  for (const LandmarkSighting& sighting : constraints.sightings) {
    require(sighting.pose, "sighting from");
    if (sighting.landmark >= constraints.landmarks.size())
      throw BadArgument("sighting of an unknown landmark");
  }
  if (constraints.landmark_ids.size() != constraints.landmarks.size())
    throw BadArgument("landmarks need an id each");
  for (const LinkSwitch& one : constraints.switches)
    if (one.link >= graph.links.size())
      throw BadArgument("switch of an unknown link");
}

void
writeGraph(const fs::path& path,
           const PoseGraph& graph,
           const GraphConstraints& constraints,
           const GraphTag& vertex,
           const GraphTag& edge)
{
  checkGraphToWrite(graph);
  checkConstraintsToWrite(graph, constraints);
  const auto idOf = [&](std::size_t i) {
    return std::to_string(graph.ids.empty() ? i : graph.ids[i]);
  };
  std::string text;
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    text.append(vertex.name).append(" ").append(idOf(i));
    appendPose(text, vertex, graph.poses[i]);
    text += '\n';
  }
  for (const std::size_t i : constraints.fixed)
    text.append("FIX ").append(idOf(i)).append("\n");
  appendConstraints(text, constraints, graph.ids);
  std::unordered_map<std::size_t, std::size_t> switches; // from link to id
  for (const LinkSwitch& one : constraints.switches)
    switches.emplace(one.link, one.id);
  for (std::size_t k = 0; k < graph.links.size(); ++k) {
    const PoseLink& link = graph.links[k];
    const auto found = switches.find(k);
    const bool is_switched = found != switches.end();
    text.append(is_switched ? "EDGE_SE3_SWITCHABLE" : edge.name).append(" ");
    text.append(idOf(link.from)).append(" ").append(idOf(link.to));
    if (is_switched)
      text.append(" ").append(std::to_string(found->second));
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
  return readPoseGraphFile(path).graph;
}

PoseGraphFile
readPoseGraphFile(const fs::path& path, const PoseGraphReaderOptions& options)
{
  Rows rows = readRows(path, options);
  const bool has_vertices = !rows.ids.empty();
  if (!has_vertices)
    nameVertices(rows);
  if (rows.ids.empty())
    text::fail(path, "holds no pose");
  PoseGraphFile file;
  file.constraints = rows.constraints.resolved(path, rows.index);
  for (const auto& [id, line] : rows.fixed)
    file.constraints.fixed.push_back(vertexOf(path, rows, id, line));
  for (const auto& [word, count] : rows.skipped)
    file.skipped.push_back(text::counted(count, "line") + " " + word);
  PoseGraph& graph = file.graph;
  graph.links = std::move(rows.links);
  for (std::size_t k = 0; k < graph.links.size(); ++k) {
    PoseLink& link = graph.links[k];
    link.from = vertexOf(path, rows, link.from, rows.lines[k]);
    link.to = vertexOf(path, rows, link.to, rows.lines[k]);
  }
  if (has_vertices)
    graph.poses = std::move(rows.poses);
  else
    graph.poses = posesAlongLinks(rows.ids.size(), graph.links);
  for (std::size_t i = 0; i < graph.poses.size(); ++i)
    if (!graph.poses[i].matrix().allFinite() || !isPlace(graph.poses[i].translation()))
      text::fail(path,
                 "the links to vertex " + std::to_string(rows.ids[i]) +
                     " add up to a position 1e9 m or farther from the origin");
  if (!areDefaultIds(rows.ids))
    graph.ids = std::move(rows.ids);
  return file;
}

void
writePoseGraphG2o(const fs::path& path, const PoseGraph& graph)
{
  writeConstrainedG2o(path, graph, {});
}

void
io::writeConstrainedG2o(const fs::path& path,
                        const PoseGraph& graph,
                        const GraphConstraints& constraints)
{
  writeGraph(path,
             graph,
             constraints,
             *graphTag("VERTEX_SE3:QUAT"),
             *graphTag("EDGE_SE3:QUAT"));
}

void
writePoseGraphToro(const fs::path& path, const PoseGraph& graph)
{
  writeGraph(path, graph, {}, *graphTag("VERTEX3"), *graphTag("EDGE3"));
}

} // namespace pcl6d
