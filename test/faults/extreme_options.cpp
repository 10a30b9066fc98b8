// SPDX-License-Identifier: BSD-3-Clause
#include "breakage.h"
#include "child.h"
#include "extreme_options.h"
#include "support/temp_folder.h"
#include "text_table.h"

#include <algorithm>
#include <map>
#include <regex>
#include <stdexcept>

namespace pcl6d::faults {

namespace {
namespace fs = std::filesystem;

constexpr std::size_t kPerNumber = 6, kPerWord = 3; // beside the empty text

struct Value {
  std::string name; ///< in the name of the case
  std::string text;
  bool hopeless; ///< no number option can take it
};

const Value kNothing = {"nothing", "", true}; // which no option can take

const std::vector<Value>&
extremeValues()
{
  static const std::vector<Value> values = {{"0", "0", false},
                                            {"-0", "-0", false},
                                            {"1e-320", "1e-320", false},
                                            {"1e-30", "1e-30", false},
                                            {"1e10", "1e10", false},
                                            {"1e20", "1e20", false},
                                            {"1e100", "1e100", false},
                                            {"1e308", "1e308", false},
                                            {"inf", "inf", false},
                                            {"nan", "nan", true},
                                            {"-1", "-1", false},
                                            {"2^31", "2147483648", false},
                                            {"2^32", "4294967296", false},
                                            {"2^63", "9223372036854775808", false},
                                            {"2^64", "18446744073709551616", false},
                                            {"blank", " ", true},
                                            {"1e", "1e", true},
                                            {"0x10", "0x10", false},
                                            {"1,5", "1,5", true},
                                            {"--", "--", true},
                                            {"10kB", std::string(10'000, '7'), true},
                                            {"root", "/", true},
                                            {"device", "/dev/null", true},
                                            {"nowhere", "out/no/where", true},
                                            {"control", "1\x1b[31m", true},
                                            {"bad-utf8", "\xff\xfe", true}};
  return values;
}

std::string
helpOf(const fs::path& program, const std::string& job, const fs::path& scratch)
{
  fs::create_directories(scratch);
  Command command;
  command.program = program;
  command.arguments = {"--help"};
  if (!job.empty())
    command.arguments.insert(command.arguments.begin(), job);
  command.folder = command.temporary = scratch;
  command.out = scratch / "help";
  command.err = scratch / "err";
  if (const Ended end = runToEnd(command, {}); end.signal != 0 || end.exit_code != 0)
    throw std::runtime_error(shellLine(command) + " fails");
  return test::readText(command.out);
}

/** \return the words of a call without an option and its values */
std::vector<std::string>
without(const std::vector<std::string>& words, const Option& option)
{
  std::vector<std::string> rest;
  bool skipping = false;
  for (const std::string& word : words) {
    if (word.rfind('-', 0) == 0)
      skipping = word == option.name ||
                 (!option.short_name.empty() && word == option.short_name);
    if (!skipping)
      rest.push_back(word);
  }
  return rest;
}

void
addCases(const Case& call,
         const std::string& job_name,
         const std::vector<Option>& options,
         std::uint64_t seed,
         std::vector<Case>& cases)
{
  for (const Option& option : options) {
    const std::string name = "option/" + job_name + '/' + option.name;
    Random random(mixBits(seed) ^ hashOf(name));
    std::vector<Value> values = extremeValues();
    const auto add = [&](const Value& value) {
      Case extreme = call;
      extreme.arguments = without(call.arguments, option);
      extreme.arguments.push_back(option.name);
      extreme.arguments.push_back(value.text);
      extreme.name = name + '=' + value.name;
      extreme.hopeless = value.hopeless && (option.is_number || value.text.empty());
      cases.push_back(std::move(extreme));
    };
    add(kNothing);
    for (std::size_t i = 0; i < (option.is_number ? kPerNumber : kPerWord); ++i) {
      const auto one =
          values.begin() + static_cast<std::ptrdiff_t>(pick(random, values.size()));
      add(*one);
      values.erase(one);
    }
  }
}

/** \return the calls of the table by program and job */
std::map<std::string, Case>
callsOf(const fs::path& table)
{
  std::map<std::string, Case> calls;
  for (const std::vector<std::string>& row : rowsOf(table, 2)) {
    Case call;
    setCall(call, row[0], row[1]);
    calls[call.program + ' ' + call.arguments.front()] = call;
  }
  return calls;
}
} // namespace

std::vector<Option>
optionsOf(const std::string& help)
{
  static const std::regex line(
      R"(\n  (?:(-\w), )?(--[a-z0-9-]+) (\S+)(?: \.\.\.)?(?: \(=([^)\n]*))?)");
  static const std::regex word("N|M|S|D|P|R|Z|PX|DEG|HZ|VALUE|FX,FY,CX,CY|R,P,Y|X,Y,Z");
  static const std::regex number(R"([-+0-9.,e]+|auto|inf|half of.*|all)");
  std::vector<Option> options;
  const std::string text = '\n' + help;
  for (std::sregex_iterator i(text.begin(), text.end(), line), end; i != end; ++i) {
    Option option;
    option.short_name = (*i)[1];
    option.name = (*i)[2];
    option.is_number = std::regex_match((*i)[3].str(), word) ||
                       (std::regex_match((*i)[4].str(), number) &&
                        option.name.find("format") == std::string::npos &&
                        option.name.find("colour") == std::string::npos);
    options.push_back(option);
  }
  return options;
}

std::vector<std::string>
jobsOf(const std::string& help)
{
  std::vector<std::string> jobs;
  if (help.find("--help tells the options") == std::string::npos)
    return jobs;
  static const std::regex line("\n  ([a-z][a-z-]*)[ \n]");
  for (std::sregex_iterator i(help.begin(), help.end(), line), end; i != end; ++i)
    jobs.push_back((*i)[1]);
  if (help.find("\n  --") != std::string::npos)
    jobs.emplace_back(); // what it does without a job
  return jobs;
}

std::vector<Case>
extremeOptionCases(const fs::path& calls,
                   const fs::path& programs,
                   const fs::path& scratch,
                   std::uint64_t seed)
{
  const std::map<std::string, Case> table = callsOf(calls);
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(programs))
    if (entry.path().filename().string().rfind("pcl_slam6d", 0) == 0)
      all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  std::vector<Case> cases;
  for (const fs::path& program : all) {
    const std::string name = program.filename();
    std::vector<std::string> jobs = jobsOf(helpOf(program, "", scratch));
    if (jobs.empty())
      jobs.emplace_back(); // the program's only one
    for (const std::string& job : jobs) {
      const auto call = std::find_if(table.begin(), table.end(), [&](const auto& row) {
        const std::string& first = row.second.arguments.front();
        return row.second.program == name &&
               (job.empty() ? std::find(jobs.begin(), jobs.end(), first) == jobs.end()
                            : first == job);
      });
      if (call == table.end())
        throw std::runtime_error(calls.string() + ": no row for " + name + ' ' + job);
      Case whole = call->second;
      const std::string job_name = job.empty() ? name : name + '-' + job;
      whole.name = "option/" + job_name + "/whole";
      whole.intact = true;
      cases.push_back(whole);
      whole.intact = false;
      addCases(whole, job_name, optionsOf(helpOf(program, job, scratch)), seed, cases);
    }
  }
  return cases;
}

} // namespace pcl6d::faults
