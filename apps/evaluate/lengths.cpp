// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "evaluate/result_file.h"
#include "evaluate/result_json.h"
#include "evaluate/verbs.h"

#include <pcl6d/benchmarking/length_ratio.h>
#include <pcl6d/common/error.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/text.h>

#include <Eigen/Core>

#include <cmath>
#include <cstdio>

namespace pcl6d::app {

namespace {

/** \throws IoFailed unless the row holds 2 or 7 finite numbers, or 12 */
LengthPair
parseRow(std::string_view row, const std::string& place)
{
  std::vector<double> v;
  text::Tokens tokens(row);
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    v.emplace_back();
    if (!text::parseNumber(token, v.back()) || !std::isfinite(v.back()))
      throw IoFailed(place + ": " + text::quoted(token) +
                     ", but must be a finite number");
  }
  const auto distance = [&](std::size_t a) {
    return (Eigen::Vector3d(v[a], v[a + 1], v[a + 2]) -
            Eigen::Vector3d(v[a + 3], v[a + 4], v[a + 5]))
        .norm();
  };
  LengthPair length;
  if (v.size() == 2)
    length = {v[0], v[1]};
  else if (v.size() == 7)
    length = {distance(0), v[6]};
  else if (v.size() == 12)
    length = {distance(0), distance(6)};
  else
    throw IoFailed(place + ": " + std::to_string(v.size()) +
                   " numbers: must be 2 (length in the map, in the reference), 7 (two "
                   "points of the map, length) or 12 (two points of each)");
  for (const double one : {length.estimate, length.reference})
    if (!(one > 0))
      throw IoFailed(place + ": " + std::to_string(one) + ": a length must be > 0");
  return length;
}

std::vector<LengthPair>
readLengths(const std::string& file)
{
  const std::string content = text::readFile(file);
  std::vector<LengthPair> lengths;
  for (text::Lines lines(content); lines.next();) {
    const auto first = text::Tokens(lines.line()).next();
    if (!first.empty() && first.front() != '#')
      lengths.push_back(
          parseRow(lines.line(), file + ": line " + std::to_string(lines.number())));
  }
  if (lengths.size() < 2)
    throw IoFailed(file + ": " + std::to_string(lengths.size()) +
                   " lengths: a ratio needs two");
  return lengths;
}

void
print(const std::string& file,
      const std::vector<LengthPair>& lengths,
      const LengthRatioErrors& errors)
{
  std::printf(R"(%s: %zu lengths, %zu ratios
  ratios are off by %.3f %% rms, %.3f %% mean, %.3f %% at most
  scale (median of map / reference): %.6f
)",
              file.c_str(),
              lengths.size(),
              errors.ratio.count,
              100 * errors.ratio.rms,
              100 * errors.ratio.mean,
              100 * errors.ratio.max,
              errors.scale);
}

void
write(const std::string& output,
      const std::string& file,
      const std::vector<LengthPair>& lengths,
      const LengthRatioErrors& errors)
{
  const Json json = {{"schema_version", 1},
                     {"lengths", file},
                     {"count", lengths.size()},
                     {"ratios", errors.ratio.count},
                     {"rms", errors.ratio.rms},
                     {"mean", errors.ratio.mean},
                     {"median", errors.ratio.median},
                     {"max", errors.ratio.max},
                     {"scale", errors.scale}};
  writeJson(output, json, 2);
}
} // namespace

int
runLengths(const std::vector<std::string>& arguments)
{
  std::string file, output;
  OptionTable table(std::string("usage: ") + kEvaluate +
                    R"( lengths FILE [options]
Compares ratios of lengths in a map with the ratios in a reference (plan, aerial
picture); the scale of the reference need not be known. A row of FILE is a length in the
map and in the reference (2 numbers), two points of the map and the length (7), or
two points of each (12).
)");
  table.positional("FILE", &file);
  table.group("Evaluation");
  table.add("output,o FILE", &output).help("write the numbers (.json)");
  if (!table.parse(arguments))
    return kDone;
  requireResultFile("--output", output, {".json"});
  refuseInputs(output, {file});
  const std::vector<LengthPair> lengths = readLengths(file);
  const LengthRatioErrors errors = lengthRatioErrors(lengths);
  print(file, lengths, errors);
  flushOutput();
  if (!output.empty())
    write(output, file, lengths, errors);
  return kDone;
}

} // namespace pcl6d::app
