// SPDX-License-Identifier: BSD-3-Clause
#include "round_report.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace pcl6d::faults {

namespace {
/** \return a name that a regular expression finds and nothing else */
std::string
asPattern(const std::string& name)
{
  std::string pattern = "^";
  for (const char c : name) {
    if (std::string("().+^$*?[]{}|\\").find(c) != std::string::npos)
      pattern += '\\';
    pattern += c;
  }
  return pattern + '$';
}
} // namespace

std::string
RoundReport::add(const Case& one,
                 const Trace& trace,
                 const std::vector<Finding>& findings)
{
  ++cases_;
  findings_ += findings.size();
  Row& row = rows_[one.program];
  ++row.cases;
  row.seconds += trace.end.seconds;
  row.peak_memory = std::max(row.peak_memory, trace.end.peak_memory);
  std::string list;
  for (const Finding& finding : findings) {
    ++row.of_kind[finding.kind];
    list += finding.kind + ": " + one.name + ": " + finding.what + '\n';
  }
  if (findings.empty())
    return list;
  Command command;
  command.program = one.program;
  command.arguments = one.arguments;
  list += "  " + shellLine(command) + "\n  test/faults/run.sh --seed " +
          std::to_string(seed_) + " --keep faults '" + asPattern(one.name) + "'\n";
  return list;
}

std::string
RoundReport::table(const std::vector<Acceptance>& acceptances) const
{
  std::ostringstream out;
  out << std::left << std::setw(26) << "program" << std::right << std::setw(7)
      << "cases";
  for (const std::string& kind : findingKinds())
    out << std::setw(static_cast<int>(std::max<std::size_t>(kind.size(), 6)) + 2)
        << kind;
  out << "  seconds  peak MB\n";
  for (const auto& [program, row] : rows_) {
    out << std::left << std::setw(26) << program << std::right << std::setw(7)
        << row.cases;
    for (const std::string& kind : findingKinds()) {
      const auto count = row.of_kind.find(kind);
      out << std::setw(static_cast<int>(std::max<std::size_t>(kind.size(), 6)) + 2)
          << (count == row.of_kind.end() ? 0 : count->second);
    }
    out << std::fixed << std::setprecision(1) << std::setw(9) << row.seconds
        << std::setw(9) << row.peak_memory / 1'000'000 << '\n';
  }
  for (const Acceptance& acceptance : acceptances)
    if (acceptance.uses > 0)
      out << "accepted " << acceptance.uses << " times: " << acceptance.kind << ": "
          << acceptance.reason << '\n';
  out << cases_ << " cases, " << findings_ << " findings (seed " << seed_ << ")\n";
  return out.str();
}

} // namespace pcl6d::faults
