// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/simulation/scene_builder.h>

namespace pcl6d {
namespace {
using Corners =
    std::array<Eigen::Vector3d, 8>; // lower face, then the upper face above it
enum Face { kBottom, kTop, kRight, kFar, kLeft, kNear, kNumFaces };
using Faces = std::array<std::uint32_t, kNumFaces>; // surfaces

// Right-handed around each face seen from outside, if the lower face is given
// counter-clockwise seen from above.
constexpr int kFaceCorners[kNumFaces][4] = {{3, 2, 1, 0},
                                            {4, 5, 6, 7},
                                            {0, 1, 5, 4},
                                            {1, 2, 6, 5},
                                            {2, 3, 7, 6},
                                            {3, 0, 4, 7}};

void
addSolid(TriangleScene& scene, const Corners& corners, const Faces& faces)
{
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), corners.begin(), corners.end());
  for (int face = 0; face < kNumFaces; ++face) {
    std::array<std::uint32_t, 4> quad;
    for (std::size_t i = 0; i < 4; ++i)
      quad[i] = first + static_cast<std::uint32_t>(kFaceCorners[face][i]);
    scene.addQuad(quad, faces[static_cast<std::size_t>(face)]);
  }
}

Faces
addFaces(TriangleScene& scene, const Surface& material)
{
  Faces faces;
  for (auto& face : faces)
    face = scene.addSurface(material);
  return faces;
}

// A body over the rectangle around a centre line: unit direction `ahead`, from `begin`
// to `end` along it, `half_width` to both sides.
struct Strip {
  Eigen::Vector2d origin;
  Eigen::Vector2d ahead;
  double half_width;
};

Corners
stripCorners(const Strip& strip, double begin, double end)
{
  const Eigen::Vector2d left(-strip.ahead.y(), strip.ahead.x());
  const std::array<Eigen::Vector2d, 4> plan = {
      strip.origin + begin * strip.ahead - strip.half_width * left,
      strip.origin + end * strip.ahead - strip.half_width * left,
      strip.origin + end * strip.ahead + strip.half_width * left,
      strip.origin + begin * strip.ahead + strip.half_width * left};
  Corners corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] << plan[i % 4], 0;
  return corners;
}

void
setHeights(Corners& corners, double bottom, double near_top, double far_top)
{
  for (std::size_t i = 0; i < 4; ++i)
    corners[i].z() = bottom;
  corners[4].z() = corners[7].z() = near_top;
  corners[5].z() = corners[6].z() = far_top;
}

// One piece of a wall between two heights; an empty piece is skipped.
void
addPiece(TriangleScene& scene, const Strip& strip, const Opening& piece, Faces faces)
{
  if (!(piece.end > piece.begin && piece.high > piece.low))
    return;
  const Surface material = scene.surfaces[faces[kRight]];
  for (const auto face : {kBottom, kTop, kFar, kNear})
    faces[face] = scene.addSurface(material);
  Corners corners = stripCorners(strip, piece.begin, piece.end);
  setHeights(corners, piece.low, piece.high, piece.high);
  addSolid(scene, corners, faces);
}
} // namespace

void
addBox(TriangleScene& scene, const Box& box, const Surface& material)
{
  require((box.size.array() > 0).all(), "size of a box", box.size.transpose(), "> 0");
  const SinCos turn = portableSinCos(box.yaw);
  const Strip strip{box.centre.head<2>(), {turn.cos, turn.sin}, box.size.y() / 2};
  Corners corners = stripCorners(strip, -box.size.x() / 2, box.size.x() / 2);
  const double top = box.centre.z() + box.size.z() / 2;
  setHeights(corners, box.centre.z() - box.size.z() / 2, top, top);
  addSolid(scene, corners, addFaces(scene, material));
}

void
addBox(TriangleScene& scene,
       const Eigen::Vector3d& low,
       const Eigen::Vector3d& high,
       const Surface& material)
{
  addBox(scene, {(low + high) / 2, high - low, 0}, material);
}

void
addWall(TriangleScene& scene, const Wall& wall, const Surface& material)
{
  const double length = (wall.to - wall.from).norm();
  require(length > 0, "length of a wall", length, "> 0");
  require(wall.thickness > 0, "thickness of a wall", wall.thickness, "> 0");
  require(wall.top > wall.bottom, "top of a wall", wall.top, "above its bottom");
  const Strip strip{wall.from, (wall.to - wall.from) / length, wall.thickness / 2};
  Faces faces{};
  faces[kRight] = scene.addSurface(material);
  faces[kLeft] = scene.addSurface(material);
  double done = 0;
  for (const auto& hole : wall.openings) {
    require(
        hole.begin >= done, "begin of an opening", hole.begin, "after the last one");
    require(hole.end > hole.begin, "end of an opening", hole.end, "after its begin");
    require(hole.end <= length, "end of an opening", hole.end, "within the wall");
    addPiece(scene, strip, {done, hole.begin, wall.bottom, wall.top}, faces);
    addPiece(scene, strip, {hole.begin, hole.end, wall.bottom, hole.low}, faces);
    addPiece(scene, strip, {hole.begin, hole.end, hole.high, wall.top}, faces);
    done = hole.end;
  }
  addPiece(scene, strip, {done, length, wall.bottom, wall.top}, faces);
}

void
addRamp(TriangleScene& scene, const Ramp& ramp, const Surface& material)
{
  const double length = (ramp.to - ramp.from).norm();
  require(length > 0, "length of a ramp", length, "> 0");
  require(ramp.width > 0, "width of a ramp", ramp.width, "> 0");
  require(ramp.from_height > ramp.bottom, "from_height", ramp.from_height, "> bottom");
  require(ramp.to_height > ramp.bottom, "to_height", ramp.to_height, "> bottom");
  const Strip strip{ramp.from, (ramp.to - ramp.from) / length, ramp.width / 2};
  Corners corners = stripCorners(strip, 0, length);
  setHeights(corners, ramp.bottom, ramp.from_height, ramp.to_height);
  addSolid(scene, corners, addFaces(scene, material));
}

} // namespace pcl6d
