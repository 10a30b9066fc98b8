// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh_formats.h"

#include <pcl6d/common/random.h>
#include <pcl6d/io/text.h>

#include <cmath>
#include <cstring>
#include <unordered_map>

namespace pcl6d::io {
namespace {
using StlCorner = std::array<double, 3>;

struct CornerHash {
  std::size_t
  operator()(const StlCorner& corner) const
  {
    std::uint64_t key = 0;
    for (const double value : corner) {
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      key = mixBits(key ^ bits);
    }
    return key;
  }
};

// Adjacent triangles must share vertices, so equal corners are merged.
class VertexMerger {
public:
  explicit VertexMerger(TriangleMesh& mesh) : mesh_(mesh) {}

  std::uint32_t
  index(StlCorner corner)
  {
    for (auto& value : corner)
      value += 0.0; // -0 is 0
    const auto [known, is_new] =
        indices_.emplace(corner, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new)
      mesh_.vertices.emplace_back(corner[0], corner[1], corner[2]);
    return known->second;
  }

private:
  TriangleMesh& mesh_;
  std::unordered_map<StlCorner, std::uint32_t, CornerHash> indices_;
};

constexpr std::size_t kHeader = 84; // [byte] with the number of triangles
constexpr std::size_t kFacet = 50;  // [byte] normal, three corners, two bytes

std::size_t
facetsOf(std::string_view content)
{
  if (content.size() < kHeader)
    return 0;
  std::uint32_t count;
  std::memcpy(&count, content.data() + kHeader - sizeof count, sizeof count);
  return count;
}

TriangleMesh
readBinary(const std::filesystem::path& path, std::string_view content)
{
  const std::size_t count = facetsOf(content);
  if (content.size() < kHeader + count * kFacet)
    text::fail(path,
               "the file ends ahead of triangle " +
                   std::to_string((content.size() - kHeader) / kFacet + 1) + " of " +
                   std::to_string(count));
  TriangleMesh mesh;
  VertexMerger merger(mesh);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 9> corners;
    std::memcpy(corners.data(),
                content.data() + kHeader + i * kFacet + 3 * sizeof(float),
                sizeof corners);
    std::array<std::uint32_t, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      StlCorner corner;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        corner[axis] = corners[3 * k + axis];
        if (!(std::abs(corner[axis]) <= 3.5e38)) // nan would confuse the merger
          text::fail(path, "triangle " + std::to_string(i + 1) + " is not finite");
      }
      triangle[k] = merger.index(corner);
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

TriangleMesh
readText(const std::filesystem::path& path, std::string_view content)
{
  TriangleMesh mesh;
  VertexMerger merger(mesh);
  std::vector<std::uint32_t> facet;
  text::Lines lines(content);
  while (lines.next()) {
    text::Tokens tokens(lines.line());
    const auto word = tokens.next();
    if (word == "facet")
      facet.clear();
    if (word == "endfacet") {
      if (facet.size() != 3)
        text::failAt(path,
                     lines.number(),
                     "a facet with " + text::counted(facet.size(), "corner") +
                         ", must be 3");
      addPolygon(facet, mesh);
    }
    if (word != "vertex")
      continue;
    StlCorner corner;
    for (auto& value : corner) {
      const auto token = tokens.next();
      if (!text::parseNumber(token, value) || !(std::abs(value) <= 1e300))
        text::failAt(
            path, lines.number(), text::quoted(token) + " is not a finite number");
    }
    facet.push_back(merger.index(corner));
  }
  return mesh;
}
} // namespace

TriangleMesh
readStlMesh(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  // Binary files may begin with "solid" too; the size decides.
  const bool is_binary = content.size() >= kHeader &&
                         content.size() == kHeader + facetsOf(content) * kFacet;
  if (!is_binary && content.compare(0, 5, "solid") == 0)
    return readText(path, content);
  if (content.size() < kHeader)
    text::fail(path, "neither a text nor a binary STL file");
  return readBinary(path, content);
}

} // namespace pcl6d::io
