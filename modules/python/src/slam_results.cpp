// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.h"
#include "options.h"
#include "pose_results.h"
#include "slam_results.h"

#include <pcl6d/common/option_spec.h>
#include <pcl6d/io/text.h>

#include <algorithm>
#include <pybind11/stl.h>
#include <type_traits>

namespace pcl6d::python {

namespace {
/** \return the name of an option in Python arguments */
std::string
argumentName(const OptionSpec& option)
{
  std::string name = option.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

template <typename Value>
void
setVariable(Value* variable, const py::handle& value, const std::string& name)
{
  if constexpr (std::is_same_v<Value, std::filesystem::path>)
    *variable = valueOf<std::string>(value, name, "a path");
  else if constexpr (std::is_same_v<Value, bool>)
    *variable = valueOf<bool>(value, name, "True or False");
  else if constexpr (std::is_same_v<Value, std::string>)
    *variable = valueOf<Value>(value, name, "a word");
  else
    *variable = valueOf<Value>(value, name, "a number");
}

void
setVariable(const OptionWordReader& reader, const py::handle& value, const std::string&)
{
  reader.take(py::str(value));
}

/** None selects a derived value, or the default. */
void
setOption(const OptionSpec& option, const py::handle& value)
{
  if (value.is_none())
    return;
  std::visit(
      [&](const auto& variable) { setVariable(variable, value, argumentName(option)); },
      option.variable);
}
} // namespace

Slam6DOptions
slamOptions(const py::dict& values)
{
  Slam6DOptions options;
  Slam6DParameters used;
  OptionList list;
  describe(options, used, list);
  for (const auto& [key, value] : values) {
    const std::string name = py::str(key);
    const auto& rows = list.rows();
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const OptionSpec& option) {
          return argumentName(option) == name;
        });
    if (row == rows.end())
      throw BadArgument("there is no option " + name +
                        ": share/doc/options.md lists every option");
    setOption(*row, value);
  }
  options.validate();
  return options;
}

OptionWords
wordsOf(const py::dict& values)
{
  OptionWords words;
  for (const auto& [key, value] : values)
    if (!value.is_none())
      words[py::str(key)] = py::str(value);
  return words;
}

std::vector<RunResult::Option>
usedOptions(const OptionWords& given, const Slam6DParameters& used)
{
  Slam6DOptions options;
  Slam6DParameters parameters = used;
  OptionList list;
  describe(options, parameters, list);
  std::vector<RunResult::Option> rows;
  for (const OptionSpec& option : list.rows()) {
    if (!isInSummary(option.role))
      continue;
    const Parameter* const value = option.parameter;
    if (value && (value->given || !value->why.empty())) // else not known in this run
      rows.push_back({option.name,
                      text::shortest(value->value),
                      value->given ? "given" : "derived",
                      value->why});
    else if (const auto word = given.find(argumentName(option)); word != given.end())
      rows.push_back({option.name, word->second, "given", ""});
  }
  return rows;
}

py::dict
scanDict(const ScanResult& scan, const Eigen::Vector3d& offset)
{
  const Eigen::Translation3d back(-offset);
  py::dict dict;
  dict["name"] = scan.file;
  dict["index"] = scan.index;
  dict["T_world_scan"] = arrayOf(Eigen::Isometry3d(scan.T_world_scan * back));
  dict["initial_pose"] = arrayOf(Eigen::Isometry3d(scan.initial_pose * back));
  dict["state"] = toString(scan.state);
  dict["status"] = toString(scan.status);
  dict["converged"] =
      scan.state == ScanState::kMatched || scan.state == ScanState::kFixed;
  dict["num_points"] = scan.points;
  dict["num_inliers"] = scan.pairs;
  dict["fitness"] = scan.overlap;
  dict["inlier_rmse"] = scan.rms;
  dict["iterations"] = scan.iterations;
  dict["covariance"] =
      scan.covariance
          ? matrixOrNone(movedCovariance(*scan.covariance, scan.T_world_scan, offset))
          : py::none();
  dict["reason"] = toWords(scan.rejections);
  return dict;
}

py::object
verificationOrNone(const std::optional<MapVerification>& map)
{
  if (!map)
    return py::none();
  py::dict dict;
  dict["verdict"] = toString(map->trust);
  dict["doubts"] = wordsOfEach(map->doubts);
  py::list links;
  for (const LinkCheck& link : map->links) {
    py::dict row;
    row["first"] = link.from;
    row["second"] = link.to;
    row["result"] = toString(link.trust);
    row["probability_wrong"] = link.probability_wrong;
    row["reason"] = toWords(link.rejection);
    links.append(row);
  }
  dict["links"] = links;
  return std::move(dict);
}

} // namespace pcl6d::python
