// SPDX-License-Identifier: BSD-3-Clause
// The halo of cells on the faces of a cube, against one look at all nine.
#include <pcl6d/common/random.h>
#include <pcl6d/visibility/cube_faces.h>

#include <gtest/gtest.h>

#include <map>
#include <tuple>

namespace {
using pcl6d::visibility::Faces;
using pcl6d::visibility::haloOf;
using pcl6d::visibility::Interval;

/** The middle of a cell of the cube [-side, side]^3, or of one beyond an edge of its face,
 * pushed onto the face that it is on then: whole numbers, so that cells are found by them. */
using Place = std::tuple<int, int, int>;

Place
placeOf(std::size_t face, int row, int col, int side)
{
  int p[3];
  const int axis = static_cast<int>(face / 2);
  p[axis] = face % 2 == 0 ? side : -side;
  p[(axis + 1) % 3] = 2 * col + 1 - side;
  p[(axis + 2) % 3] = 2 * row + 1 - side;
  // Beyond an edge: the cell there lies on the other face, one cell behind this one.
  for (const int other : {(axis + 1) % 3, (axis + 2) % 3})
    if (p[other] > side || p[other] < -side) {
      p[other] = p[other] > 0 ? side : -side;
      p[axis] += p[axis] > 0 ? -1 : 1;
    }
  return {p[0], p[1], p[2]};
}

Faces
randomFaces(int side, double measured, bool with_missing_faces)
{
  pcl6d::Random random(7);
  Faces faces;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (with_missing_faces && f % 3 == 1)
      continue;
    faces[f].resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (Interval& cell : faces[f])
      for (int k = 0; k < 2; ++k)
        if (random.uniform() < measured)
          cell.add(static_cast<std::uint16_t>(1 + random.uniform() * 60000));
  }
  return faces;
}

/** The halo by its definition. */
Interval
expectedHalo(const std::map<Place, Interval>& cells,
             std::size_t face,
             int row,
             int col,
             int side,
             int filled,
             bool enclosed)
{
  Interval around;
  int count = 0;
  bool above = false, below = false, left = false, right = false; // measured there
  for (int r = row - 1; r <= row + 1; ++r)
    for (int c = col - 1; c <= col + 1; ++c) {
      const bool corner = (r < 0 || r >= side) && (c < 0 || c >= side);
      const auto cell = corner ? cells.end() : cells.find(placeOf(face, r, c, side));
      if (cell == cells.end() || cell->second.isEmpty())
        continue;
      ++count;
      below |= r < row;
      above |= r > row;
      left |= c < col;
      right |= c > col;
      around.add(cell->second.nearest);
      around.add(cell->second.farthest);
    }
  const bool all_sides = above && below && left && right;
  return count >= filled && (all_sides || !enclosed) ? around : Interval{};
}
} // namespace

TEST(HaloOf, DoesNotAnswerBeyondTheLastLine)
{
  // Two rows of a face are measured: neither has anything on both of its sides.
  constexpr int kSide = 8;
  Faces faces;
  faces[0].resize(kSide * kSide);
  const auto measure = [&](int row) {
    for (int col = 0; col < kSide; ++col)
      faces[0][static_cast<std::size_t>(row * kSide + col)].add(100);
  };
  const auto answers = [&](int row) {
    return !haloOf(faces, 0, kSide, 6, true)[static_cast<std::size_t>(row * kSide + 4)]
                .isEmpty();
  };
  measure(3);
  measure(4);
  for (int row = 1; row < kSide - 1; ++row)
    EXPECT_FALSE(answers(row)) << row;
  measure(5);
  for (int row = 1; row < kSide - 1; ++row)
    EXPECT_EQ(answers(row), row == 4) << row;
}

TEST(HaloOf, IsThatOfAllNineCellsAcrossTheEdgesToo)
{
  for (const int side : {2, 3, 5, 12})
    for (const bool with_missing_faces : {false, true})
      for (const double measured : {0.3, 0.8}) {
        const Faces faces = randomFaces(side, measured, with_missing_faces);
        std::map<Place, Interval> cells;
        for (std::size_t f = 0; f < faces.size(); ++f)
          for (std::size_t i = 0; i < faces[f].size(); ++i)
            cells[placeOf(
                f, static_cast<int>(i) / side, static_cast<int>(i) % side, side)] =
                faces[f][i];
        for (std::size_t f = 0; f < faces.size(); ++f)
          for (const bool enclosed : {false, true}) {
            const auto halo = haloOf(faces, f, side, 6, enclosed);
            ASSERT_EQ(halo.size(), faces[f].size());
            for (std::size_t i = 0; i < halo.size(); ++i) {
              const int row = static_cast<int>(i) / side,
                        col = static_cast<int>(i) % side;
              const Interval expected =
                  expectedHalo(cells, f, row, col, side, 6, enclosed);
              ASSERT_EQ(halo[i].nearest, expected.nearest)
                  << "side " << side << " face " << f << " row " << row << " col "
                  << col;
              ASSERT_EQ(halo[i].farthest, expected.farthest);
            }
          }
      }
}
