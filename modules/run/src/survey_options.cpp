// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/survey_options.h>

#include <cmath>
#include <string_view>

namespace pcl6d {

namespace {
double
lengthFrom(const std::string& word)
{
  const std::pair<std::string_view, double> units[] = {
      {"mm", 1e-3}, {"cm", 1e-2}, {"m", 1}, {"", 1}};
  for (const auto& [unit, metres] : units) {
    std::string_view number = word;
    if (number.size() < unit.size() ||
        number.substr(number.size() - unit.size()) != unit)
      continue;
    number.remove_suffix(unit.size());
    while (!number.empty() && number.back() == ' ')
      number.remove_suffix(1);
    double value = 0;
    if (text::parseNumber(number, value) && std::isfinite(value) && value > 0)
      return metres * value;
    break;
  }
  throw BadArgument("tolerance = " + word +
                    ", but must be a length above 0, for example 5mm, 0.5cm or 0.005");
}
} // namespace

void
SurveyOptions::validate() const
{
  require(!tolerance || (std::isfinite(*tolerance) && *tolerance > 0),
          "tolerance",
          tolerance.value_or(0),
          "finite and > 0 m");
  for (const auto& entry : project)
    require(!entry.first.empty(), "project", "=" + entry.second, "KEY=VALUE");
}

SurveyOptions
surveyOptionsFrom(const std::vector<std::string>& project, const std::string& tolerance)
{
  SurveyOptions options;
  for (const std::string& entries : project)
    for (text::Lines lines(entries); lines.next();) {
      const std::string entry(lines.line());
      const std::size_t equals = entry.find('=');
      require(equals != std::string::npos && equals > 0, "project", entry, "KEY=VALUE");
      options.project.emplace_back(entry.substr(0, equals), entry.substr(equals + 1));
    }
  if (!tolerance.empty())
    options.tolerance = lengthFrom(tolerance);
  return options;
}

} // namespace pcl6d
