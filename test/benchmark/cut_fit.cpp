// SPDX-License-Identifier: BSD-3-Clause
#include "cut_fit.h"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace pcl6d::bench {

namespace {
using verification::CutConstants;

/** A constant with the values to try. */
struct Ladder {
  const char* name; ///< in calibration.h
  double CutConstants::*constant;
  std::vector<double> values; ///< ascending
};

/** \return factors of two about the value in use; its three neighbours on either side */
std::vector<double>
doubled(double value)
{
  std::vector<double> values;
  for (int power = -3; power <= 3; ++power)
    values.push_back(std::ldexp(value, power));
  return values;
}

const std::vector<Ladder>&
ladders()
{
  static const CutConstants in_use = verification::cutConstants();
  static const std::vector<Ladder> all = {
      {"kEvenShare", &CutConstants::even_share, doubled(in_use.even_share)},
      {"kCutPrecision", &CutConstants::precision, doubled(in_use.precision)},
      {"kLeastCutBackground",
       &CutConstants::least_background,
       doubled(in_use.least_background)},
      {"kRestPatches", &CutConstants::rest_patches, doubled(in_use.rest_patches)},
      {"kCutSurfaces", &CutConstants::surfaces, {0, 0.2, 0.4, 0.6, 0.8, 1, 1.5}},
      {"kGoodBelow", &CutConstants::cut_from, doubled(in_use.cut_from)}};
  return all;
}

std::array<double, 6>
valuesOf(const CutConstants& constants)
{
  std::array<double, 6> values{};
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = constants.*ladders()[i].constant;
  return values;
}

/** A sensor with the constants fitted to all others. */
struct LeftOutSensor {
  std::string sensor;
  CutCounts in_use,
      fitted; ///< of the sensor, with the constants in use and the fitted ones
  CutConstants constants;
};

CutCounts
totalOf(const CutFit::BySensor& counts)
{
  CutCounts total;
  for (const auto& [sensor, of_sensor] : counts)
    total += of_sensor;
  return total;
}
} // namespace

CutCounts&
CutCounts::operator+=(const CutCounts& other)
{
  runs += other.runs;
  good += other.good;
  doubted += other.doubted;
  wrong += other.wrong;
  false_goods += other.false_goods;
  right += other.right;
  false_doubts += other.false_doubts;
  misplaced += other.misplaced;
  missed += other.missed;
  right_cuts += other.right_cuts;
  return *this;
}

std::size_t
CutCounts::loss() const
{
  constexpr std::size_t kMissed =
      10; // chosen: a wrong map called good is the worst result
  return kMissed * missed + right_cuts;
}

const CutFit::BySensor&
CutFit::counts(const CutConstants& constants)
{
  const auto [place, is_new] = known_.try_emplace(valuesOf(constants));
  if (!is_new)
    return place->second;
  for (const CutRun& run : runs_) {
    const CutVerdict verdict = verdictWith(constants, run);
    const bool is_wrong = isWrong(verdict.map), is_right = isRight(verdict.map);
    CutCounts& counts = place->second[run.sensor];
    ++counts.runs;
    counts.good += verdict.map.call == TrustCall::kGood;
    counts.doubted += verdict.map.call == TrustCall::kDoubted;
    counts.wrong += is_wrong;
    counts.false_goods += is_wrong && verdict.map.call == TrustCall::kGood;
    counts.right += is_right;
    counts.false_doubts += is_right && verdict.map.call == TrustCall::kDoubted;
    counts.misplaced += verdict.is_misplaced;
    counts.missed += verdict.is_missed;
    counts.right_cuts += verdict.is_right_cut;
  }
  return place->second;
}

std::size_t
CutFit::lossWithout(const std::string& left_out, const CutConstants& constants)
{
  std::size_t loss = 0;
  for (const auto& [sensor, of_sensor] : counts(constants))
    if (sensor != left_out)
      loss += of_sensor.loss();
  return loss;
}

CutConstants
CutFit::fitWithout(const std::string& left_out)
{
  constexpr int kMostRounds = 4;
  CutConstants best = verification::cutConstants();
  bool changed = true;
  for (int round = 0; changed && round < kMostRounds; ++round) {
    changed = false;
    for (const Ladder& ladder : ladders()) {
      std::vector<std::size_t> losses;
      for (const double value : ladder.values) {
        CutConstants tried = best;
        tried.*ladder.constant = value;
        losses.push_back(lossWithout(left_out, tried));
      }
      const std::size_t least = *std::min_element(losses.begin(), losses.end());
      std::vector<double> equal;
      for (std::size_t i = 0; i < losses.size(); ++i)
        if (losses[i] == least)
          equal.push_back(ladder.values[i]);
      const double middle = equal[equal.size() / 2];
      changed = changed || best.*ladder.constant != middle;
      best.*ladder.constant = middle;
    }
  }
  return best;
}

void
printLeftOutSensors(CutFit& fit, std::ostream& out)
{
  const CutFit::BySensor used = fit.counts(verification::cutConstants());
  std::vector<LeftOutSensor> rows;
  for (const auto& [sensor, in_use] : used) {
    const CutConstants constants = fit.fitWithout(sensor);
    rows.push_back({sensor, in_use, fit.counts(constants).at(sensor), constants});
  }
  LeftOutSensor all{"all", totalOf(used), {}, verification::cutConstants()};
  for (const LeftOutSensor& row : rows)
    all.fitted += row.fitted;
  rows.push_back(all);
  out << "| sensor | runs | good | doubted | wrong | called good: in use | fitted to "
         "the "
         "others | right | doubted: in use | fitted |\n"
         "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const LeftOutSensor& row : rows)
    out << "| " << row.sensor << " | " << row.in_use.runs << " | " << row.in_use.good
        << " | " << row.in_use.doubted << " | " << row.in_use.wrong << " | "
        << row.in_use.false_goods << " | " << row.fitted.false_goods << " | "
        << row.in_use.right << " | " << row.in_use.false_doubts << " | "
        << row.fitted.false_doubts << " |\n";
  out << "\n| left out | maps with a wrong place | missed: in use | fitted | right "
         "maps cut: "
         "in use | fitted |";
  for (const Ladder& ladder : ladders())
    out << ' ' << ladder.name << " |";
  out << "\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const LeftOutSensor& row : rows) {
    out << "| " << row.sensor << " | " << row.in_use.misplaced << " | "
        << row.in_use.missed << " | " << row.fitted.missed << " | "
        << row.in_use.right_cuts << " | " << row.fitted.right_cuts << " |";
    for (const double value : valuesOf(row.constants))
      out << ' ' << value << " |";
    out << '\n';
  }
  out << "\nThe constants of the last row are in use.\n";
}

void
printLadders(CutFit& fit, std::ostream& out)
{
  out << "| constant | value: wrong places missed, right maps cut |\n|---|---|\n";
  for (const Ladder& ladder : ladders()) {
    out << "| " << ladder.name << " |";
    for (const double value : ladder.values) {
      CutConstants tried = verification::cutConstants();
      tried.*ladder.constant = value;
      const CutCounts counts = totalOf(fit.counts(tried));
      out << ' ' << value << ": " << counts.missed << ", " << counts.right_cuts << ';';
    }
    out << " |" << std::endl;
  }
}

} // namespace pcl6d::bench
