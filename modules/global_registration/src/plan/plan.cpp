// SPDX-License-Identifier: BSD-3-Clause
#include "plan/plan.h"

#include <pcl6d/common/number_range.h>
#include <pcl6d/common/portable_math.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace pcl6d::global_registration {

namespace {
/** A surface is upright if its normal is nearly level: cosine of 60 deg. */
constexpr double kLevelNormal = 0.5;

/** Least cell size in voxels: half of this size found no more poses in a prototype. Larger where
 * too many cells would be filled, because pairs of cells vote. */
constexpr double kCellVoxels = 2;
constexpr std::size_t kMostCells = 1000;

/** Share of the points within the reach of a scan: a step of the turn moves a point there by at
 * most about two cells. */
constexpr double kWithinReach = 0.95;

/** Sectors of directions: cells match if their sectors are equal or neighbours. */
constexpr int kSectors = 24;

/** [cells] Margin of the square around a shift for the background of its votes. */
constexpr int kAround = 7;

/** Number of shifts kept per turn. With parallel walls every good shift has one of a few turns.
 * With 12 shifts the right shift was missing for a third of the pairs of rooms; 40 include the
 * right shift, and 400 are no better. */
constexpr std::size_t kShiftsOfTurn = 40;

/** Two placements are different from this number of cells, or turns, on. */
constexpr int kApartCells = 3, kApartTurns = 3;

constexpr double kPi = 3.14159265358979323846;

int
sectorOf(const Eigen::Vector2d& facing)
{
  const double angle = portableAtan2(facing.y(), facing.x()) + kPi;
  return std::min(static_cast<int>(angle / (2 * kPi) * kSectors), kSectors - 1);
}

/** A point of an upright surface. */
struct Upright {
  std::tuple<int, int, int> key; ///< cell, sector
  Eigen::Vector2d place, facing;
};

std::vector<Upright>
uprightPoints(const Points& points,
              const Normals& normals,
              const Eigen::Matrix3d& R_level_scan,
              double cell)
{
  std::vector<Upright> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d n = R_level_scan * normals[i].cast<double>();
    if (normals[i].isZero(0) || !points[i].allFinite() ||
        std::abs(n.z()) > kLevelNormal)
      continue;
    const Eigen::Vector2d p = (R_level_scan * points[i].cast<double>()).head<2>();
    const Eigen::Vector2d facing = n.head<2>().normalized();
    all.push_back({{clampedTo<int>(std::floor(p.x() / cell)),
                    clampedTo<int>(std::floor(p.y() / cell)),
                    sectorOf(facing)},
                   p,
                   facing});
  }
  return all;
}

/** \return [cells] edge of the table of votes for shifts between plans of this reach */
int
sideOf(int reach)
{
  return 4 * reach;
}

/** By sector: the cells within reach, each as its offset in the table of votes. */
using Sectors = std::array<std::vector<int>, kSectors>;

Sectors
sectorsOf(const Plan& plan, double yaw, int reach)
{
  const SinCos turn = portableSinCos(yaw);
  Eigen::Matrix2d R;
  R << turn.cos, -turn.sin, turn.sin, turn.cos;
  Sectors sectors;
  for (const auto& cell : plan.cells) {
    const Eigen::Vector2d place = R * cell.place / plan.cell;
    if (place.cwiseAbs().maxCoeff() < reach)
      sectors[static_cast<std::size_t>(sectorOf(R * cell.facing))].push_back(
          static_cast<int>(std::floor(place.y())) * sideOf(reach) +
          static_cast<int>(std::floor(place.x())));
  }
  return sectors;
}

/** Votes for shifts, and their significance. */
class VoteTable {
public:
  /** \param[in] reach [cells] of both plans: their sum limits the shift */
  explicit VoteTable(int reach)
  : side_(sideOf(reach))
  , votes_(static_cast<std::size_t>(side_ * side_))
  , narrow_(static_cast<std::size_t>(side_))
  , wide_(static_cast<std::size_t>(side_))
  , left_(static_cast<std::size_t>(side_ + 1))
  , is_peak_(static_cast<std::size_t>(side_))
  {}

  /** \return whether any shift has enough votes */
  bool
  vote(const Sectors& fixed, const Sectors& moved)
  {
    std::fill(votes_.begin(), votes_.end(), std::uint16_t{0});
    std::size_t most = 0;
    for (int s = 0; s < kSectors; ++s)
      for (int beside = -1; beside <= 1; ++beside) {
        const auto& there =
            fixed[static_cast<std::size_t>((s + beside + kSectors) % kSectors)];
        const auto& here = moved[static_cast<std::size_t>(s)];
        vote(there, here);
        most += there.size() * here.size();
      }
    return most >= kLeastVotes;
  }

  /** Adds the most significant shifts, in the order of the table. */
  void
  addBest(double yaw, double cell, std::vector<PlanPlacement>& placements)
  {
    std::vector<std::pair<double, int>> best;
    std::fill(wide_.begin(), wide_.end(), 0);
    for (int y = 1; y < 2 * kAround + 1; ++y)
      add(y, 1, wide_);
    for (int y = kAround + 1; y < side_ - kAround - 1; ++y) {
      add(y + kAround, 1, wide_);
      markPeaks(y);
      int x = nextPeak(kAround + 1);
      if (x >= 0)
        sumBeside();
      for (; x >= 0; x = nextPeak(x + 1))
        best.emplace_back(-standingOut(x), y * side_ + x);
      add(y - kAround, -1, wide_);
    }
    const std::size_t count = std::min(best.size(), kShiftsOfTurn);
    std::partial_sort(
        best.begin(), best.begin() + static_cast<std::ptrdiff_t>(count), best.end());
    for (std::size_t i = 0; i < count; ++i) {
      const int x = best[i].second % side_ - side_ / 2;
      const int y = best[i].second / side_ - side_ / 2;
      placements.push_back({yaw, Eigen::Vector2d(x, y) * cell, -best[i].first});
    }
  }

private:
  static constexpr int kLeastVotes = 9;

  /** Cells within reach of both plans never vote for a shift outside the table. */
  void
  vote(const std::vector<int>& fixed, const std::vector<int>& moved)
  {
    const int no_shift = side_ / 2 * side_ + side_ / 2;
    for (const int m : moved) {
      std::uint16_t* const start = votes_.data() + (no_shift - m);
      for (const int f : fixed)
        ++start[f];
    }
  }

  const std::uint16_t*
  row(int y) const
  {
    return votes_.data() + static_cast<std::ptrdiff_t>(y) * side_;
  }

  void
  add(int y, int times, std::vector<int>& columns) const
  {
    const std::uint16_t* const votes = row(y);
    for (int x = 0; x < side_; ++x)
      columns[static_cast<std::size_t>(x)] += times * votes[x];
  }

  /** Peaks of a row: cells with enough votes around, and at least as many as each neighbour. */
  void
  markPeaks(int y)
  {
    const std::uint16_t *const below = row(y - 1), *const here = row(y),
                               *const above = row(y + 1);
    for (int x = 0; x < side_; ++x)
      narrow_[static_cast<std::size_t>(x)] = below[x] + here[x] + above[x];
    for (int x = 1; x < side_ - 1; ++x) {
      const auto i = static_cast<std::size_t>(x);
      const int most = std::max({here[x - 1],
                                 here[x + 1],
                                 below[x - 1],
                                 below[x],
                                 below[x + 1],
                                 above[x - 1],
                                 above[x],
                                 above[x + 1]});
      is_peak_[i] = static_cast<char>((here[x] >= most) & (square(x) >= kLeastVotes));
    }
  }

  /** \return the next peak of the row from x on, except near its ends; -1: none */
  int
  nextPeak(int x) const
  {
    const auto from = is_peak_.begin() + x, end = is_peak_.end() - (kAround + 1);
    const auto peak = from < end ? std::find(from, end, char{1}) : end;
    return peak == end ? -1 : static_cast<int>(peak - is_peak_.begin());
  }

  /** Sums of the votes around the cells of the row. */
  void
  sumBeside()
  {
    int sum = 0;
    for (std::size_t x = 0; x < wide_.size(); ++x)
      left_[x + 1] = sum += wide_[x];
  }

  /** Votes of the cell of the current row and its eight neighbours. */
  int
  square(int x) const
  {
    const auto i = static_cast<std::size_t>(x);
    return narrow_[i - 1] + narrow_[i] + narrow_[i + 1];
  }

  /** [standard deviations] of the chance votes, at the rate of the surroundings. */
  double
  standingOut(int x) const
  {
    constexpr double kSquare = 9, kAll = (2 * kAround + 1) * (2 * kAround + 1);
    const double here = square(x);
    constexpr auto kReach = static_cast<std::size_t>(kAround);
    const auto i = static_cast<std::size_t>(x);
    const double around = left_[i + kReach + 1] - left_[i - kReach] - here;
    const double expected = around * kSquare / (kAll - kSquare);
    return (here - expected) / std::sqrt(expected + kSquare);
  }

  int side_; ///< of the table
  std::vector<std::uint16_t> votes_;
  // Of the current row:
  std::vector<int> narrow_,
      wide_;              ///< votes of each column, up to 1 and kAround rows away
  std::vector<int> left_; ///< sums of wide_ left of each column
  std::vector<char> is_peak_;
};

bool
areNear(const PlanPlacement& a, const PlanPlacement& b, double cell, double step)
{
  return (a.shift - b.shift).cwiseAbs().maxCoeff() < (kApartCells - 0.5) * cell &&
         std::abs(std::remainder(a.yaw - b.yaw, 2 * kPi)) < (kApartTurns - 0.5) * step;
}
} // namespace

double
planCell(const Points& points,
         const Normals& normals,
         const Eigen::Matrix3d& R_level_scan,
         double voxel)
{
  std::vector<double> reach;
  for (const auto& p : points)
    if (p.allFinite())
      reach.push_back(
          (R_level_scan * p.cast<double>()).head<2>().cwiseAbs().maxCoeff());
  double cell = kCellVoxels * voxel;
  if (!reach.empty()) {
    const auto most =
        reach.begin() +
        static_cast<std::ptrdiff_t>(kWithinReach * static_cast<double>(reach.size()));
    std::nth_element(reach.begin(), most, reach.end());
    cell = std::max(cell, *most / PlanSearch().reach);
  }
  constexpr int kWidenings = 8;
  for (int k = 0; k < kWidenings; ++k, cell *= 1.25)
    if (drawPlan(points, normals, R_level_scan, cell).cells.size() <= kMostCells)
      break;
  return cell;
}

Plan
drawPlan(const Points& points,
         const Normals& normals,
         const Eigen::Matrix3d& R_level_scan,
         double cell)
{
  std::vector<Upright> all = uprightPoints(points, normals, R_level_scan, cell);
  std::stable_sort(all.begin(), all.end(), [](const Upright& a, const Upright& b) {
    return a.key < b.key;
  });
  Plan plan;
  plan.cell = cell;
  for (std::size_t i = 0; i < all.size();) {
    PlanCell one;
    std::size_t end = i;
    for (; end < all.size() && all[end].key == all[i].key; ++end) {
      one.place += all[end].place;
      one.facing += all[end].facing;
    }
    one.place /= static_cast<double>(end - i);
    one.facing.normalize();
    plan.cells.push_back(one);
    i = end;
  }
  return plan;
}

std::vector<PlanPlacement>
placePlan(const Plan& fixed,
          const Plan& moved,
          std::size_t most,
          const PlanSearch& search)
{
  std::vector<PlanPlacement> all;
  VoteTable table(search.reach);
  const double step = 2 * kPi / search.turns;
  const Sectors sectors = sectorsOf(fixed, 0, search.reach);
  for (int turn = 0; turn < search.turns; ++turn) {
    if (table.vote(sectors, sectorsOf(moved, turn * step, search.reach)))
      table.addBest(turn * step, fixed.cell, all);
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.votes > b.votes;
  });
  std::vector<PlanPlacement> best;
  for (const auto& one : all) {
    if (best.size() == most)
      break;
    if (std::none_of(best.begin(), best.end(), [&](const PlanPlacement& other) {
          return areNear(one, other, fixed.cell, step);
        }))
      best.push_back(one);
  }
  return best;
}

} // namespace pcl6d::global_registration
