// SPDX-License-Identifier: BSD-3-Clause
#include "surface_pieces.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/deskew/motion_correction.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace pcl6d::semi_rigid {

namespace {
/** Lower bound of the error of a mean, relative to the noise: a cell is no perfect plane. */
constexpr double kLeastShare = 0.3;

/** Points farther from their plane, in deviations, belong to a different surface in the cell. */
constexpr double kMostDeviations = 4;

std::size_t
knotBefore(const std::vector<double>& stamps, double time)
{
  const auto next = std::upper_bound(stamps.begin() + 1, stamps.end() - 1, time);
  return static_cast<std::size_t>(next - stamps.begin()) - 1;
}

/** \return the pieces of single points, in their order */
std::vector<SurfacePiece>
pointsOnPlanes(const MotionScan& scan,
               std::size_t first,
               const SurfaceMap& map,
               double noise)
{
  const MotionCorrection path(scan.knots);
  std::vector<SurfacePiece> pieces;
  for (std::size_t i = 0; i < scan.sample.points.size(); ++i) {
    const double time = scan.sample.times[i];
    const Eigen::Isometry3d pose = path.poseAt(time);
    const Eigen::Vector3d arm = pose.linear() * scan.sample.points[i].cast<double>();
    const Eigen::Vector3d place = arm + pose.translation();
    const SurfacePlane* plane = map.planeAt(place);
    if (!plane)
      continue;
    SurfacePiece piece;
    piece.height = plane->normal.dot(place - plane->mean);
    piece.variance = plane->variance + noise * noise;
    if (piece.height * piece.height >
        kMostDeviations * kMostDeviations * piece.variance)
      continue;
    const std::size_t knot = knotBefore(scan.knots.stamps, time);
    const auto& stamps = scan.knots.stamps;
    const double share = (time - stamps[knot]) / (stamps[knot + 1] - stamps[knot]);
    const Eigen::Vector3d turning = arm.cross(plane->normal);
    piece.row << (1 - share) * plane->normal, (1 - share) * turning,
        share * plane->normal, share * turning;
    piece.plane = plane->number;
    piece.knot = first + knot;
    pieces.push_back(piece);
  }
  return pieces;
}

bool
comesBefore(const SurfacePiece& a, const SurfacePiece& b)
{
  return std::tie(a.plane, a.knot) < std::tie(b.plane, b.knot);
}

/** \return the mean of the points of each plane and knot, sorted */
std::vector<SurfacePiece>
joined(std::vector<SurfacePiece> points, double noise)
{
  std::stable_sort(points.begin(), points.end(), comesBefore);
  std::vector<SurfacePiece> pieces;
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    SurfacePiece piece = points[begin];
    for (end = begin + 1;
         end < points.size() && !comesBefore(points[begin], points[end]);
         ++end) {
      piece.height += points[end].height;
      piece.variance += points[end].variance;
      piece.row += points[end].row;
    }
    const auto count = static_cast<double>(end - begin);
    piece.height /= count;
    piece.row /= count;
    piece.variance /= count * count;
    piece.variance += kLeastShare * kLeastShare * noise * noise;
    pieces.push_back(piece);
  }
  return pieces;
}
} // namespace

std::vector<SurfacePiece>
piecesOf(const std::vector<MotionScan>& scans,
         const std::vector<std::size_t>& first,
         const MotionRelaxationOptions& options)
{
  SurfaceMapOptions map_options = options.map;
  map_options.points_of_cell = std::numeric_limits<double>::infinity();
  SurfaceMap map(map_options);
  for (const MotionScan& scan : scans)
    map.add(worldPoints(scan.sample, scan.knots, options.num_threads));
  std::vector<std::vector<SurfacePiece>> parts(scans.size());
  parallelFor(scans.size(), options.num_threads, [&](std::size_t i) {
    parts[i] =
        joined(pointsOnPlanes(scans[i], first[i], map, options.noise), options.noise);
  });
  std::vector<SurfacePiece> pieces;
  for (const auto& part : parts)
    pieces.insert(pieces.end(), part.begin(), part.end());
  std::stable_sort(pieces.begin(), pieces.end(), comesBefore);
  return pieces;
}

std::vector<PieceLink>
linksOf(const std::vector<SurfacePiece>& pieces)
{
  std::vector<PieceLink> links;
  std::vector<double> counts(pieces.size(), 0);
  for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
    for (end = begin + 1;
         end < pieces.size() && pieces[end].plane == pieces[begin].plane;)
      ++end;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t stride = 1; i + stride < end; stride *= 2) {
        links.push_back({i, i + stride, 1});
        counts[i] += 1;
        counts[i + stride] += 1;
      }
  }
  for (PieceLink& link : links)
    link.share = 2 / (counts[link.from] + counts[link.to]);
  std::stable_sort(links.begin(), links.end(), [&](const auto& a, const auto& b) {
    return std::tie(pieces[a.from].knot, pieces[a.to].knot) <
           std::tie(pieces[b.from].knot, pieces[b.to].knot);
  });
  return links;
}

} // namespace pcl6d::semi_rigid
