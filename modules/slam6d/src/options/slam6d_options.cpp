// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/option_spec.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/slam6d/slam6d_result.h>

namespace pcl6d {

void
describe(Slam6DOptions& options, Slam6DParameters& used, OptionList& list)
{
  describe(static_cast<PreprocessOptions&>(options), used, list);
  describe(static_cast<MatchingOptions&>(options), used, list);
  describe(static_cast<RecoveryOptions&>(options), list);
  describe(static_cast<LoopOptions&>(options), used, list);
  describe(static_cast<RelaxationOptions&>(options), used, list);
  describe(static_cast<DynamicOptions&>(options), list);
  describe(options.motion, list);
  describe(options.control, list);
  describe(static_cast<VerificationOptions&>(options), list);
  describe(static_cast<RunOptions&>(options), list);
}

std::vector<Parameter*>
parametersOf(Slam6DParameters& used)
{
  Slam6DOptions options;
  OptionList list;
  describe(options, used, list);
  std::vector<Parameter*> parameters;
  for (const OptionSpec& option : list.rows())
    if (option.parameter)
      parameters.push_back(option.parameter);
  return parameters;
}

void
MotionOptions::validate() const
{
  MotionOptions options = *this;
  OptionList list;
  describe(options, list);
  list.check();
}

void
Slam6DOptions::validate() const
{
  ScanParameterOptions::validate();
  Slam6DOptions options = *this;
  Slam6DParameters unused;
  OptionList list;
  describe(options, unused, list);
  list.check();
  require(!max_distance_start || *max_distance_start == 0 || !max_distance ||
              *max_distance_start >= *max_distance,
          list.of(&options.max_distance_start).field.c_str(),
          max_distance_start.value_or(0),
          "0 or at least max_distance");
  const auto field = [&](const void* variable) {
    return list.of(variable).field.c_str();
  };
  require(metascan >= 0, field(&options.metascan), metascan, ">= 0");
  require(minimiser != nullptr, field(&options.minimiser), "none", "a function");
  require(plane_minimiser != nullptr,
          field(&options.plane_minimiser),
          "none",
          "a function");
}

} // namespace pcl6d
