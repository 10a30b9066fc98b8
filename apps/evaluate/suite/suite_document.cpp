// SPDX-License-Identifier: BSD-3-Clause
#include "common/options/option_table.h"
#include "evaluate/suite/suite_report.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/version.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>

#include <fstream>
#include <ostream>
#include <set>
#include <thread>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

/** \return the value of a key in a file of lines `key<separator>value`; or "unknown" */
std::string
valueIn(const fs::path& file, const std::string& key, char separator)
{
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const auto place = line.find(separator);
    if (place == std::string::npos || line.rfind(key, 0) != 0)
      continue;
    std::string value = line.substr(place + 1);
    value.erase(0, value.find_first_not_of(" \t\""));
    while (!value.empty() && value.back() == '"')
      value.pop_back();
    return value;
  }
  return "unknown";
}

std::string
machine()
{
  return valueIn("/proc/cpuinfo", "model name", ':') + ", " +
         std::to_string(std::thread::hardware_concurrency()) + " threads, " +
         valueIn("/etc/os-release", "PRETTY_NAME", '=') + ", pcl6d " PCL6D_VERSION;
}

std::string
nameForShell(const std::string& name)
{
  return name.find(' ') == std::string::npos ? name : '"' + name + '"';
}

/** The commands to run, in the form typed by a user. */
std::string
commandsOf(const Suite& suite)
{
  std::string text, options_of_data;
  std::set<std::string> told;
  for (const SuiteData& data : suite.data) {
    if (!data.scene.empty() && told.insert(data.base).second)
      text += "pcl_slam6d_simulate " + data.scene + " -o " + nameForShell(data.base) +
              ' ' + joined(wordsOf(data.simulation), " ") + '\n';
    if (!data.options.empty() && told.insert('\n' + data.entry).second)
      options_of_data +=
          "# on " + data.entry + " also: " + joined(wordsOf(data.options), " ") + '\n';
  }
  for (const SuiteMethod& method : suite.methods) {
    const std::string options =
        joined(wordsOf(overlaid(suite.defaults, method.options)), " ");
    text += "pcl_slam6d SCANS -o OUT " + options + "   # " + method.name + '\n';
  }
  text += options_of_data;
  for (const SuiteDamage& damage : suite.damages)
    text += "# " + damage.name + ": " + damage.text.dump() + ' ' +
            joined(wordsOf(damage.options), " ") + '\n';
  return text;
}

std::string
contentOf(const fs::path& file)
{
  return text::isThere(file) ? text::readFile(file) : "";
}
} // namespace

std::string
documentOf(const Suite& suite,
           const std::string& table,
           const std::string& sentence,
           const std::string& command)
{
  std::string text = "## " + suite.title + "\n\n";
  if (!suite.description.empty())
    text += suite.description + "\n\n";
  text += table;
  text += "\n" + sentence + " Machine: " + machine() + ".\n\n```sh\n" + command +
          "\n```\nruns, each in a process of its own:\n```sh\n" + commandsOf(suite) +
          "```\n";
  return text;
}

void
putIntoDocument(const fs::path& file, const std::string& name, const std::string& text)
{
  const std::string begin = "<!-- suite " + name + " -->\n";
  const std::string end = "<!-- end of suite " + name + " -->";
  std::string content = contentOf(file);
  const auto first = content.find(begin), last = content.find(end);
  const std::string block = begin + text + end;
  if (first == std::string::npos && last == std::string::npos)
    content += (content.empty() ? "" : "\n") + block + '\n';
  else if (first == std::string::npos || last == std::string::npos || last < first)
    throw IoFailed(file.string() + ": holds only one of the lines '" +
                   begin.substr(0, begin.size() - 1) + "' and '" + end +
                   "', or not in this order");
  else
    content.replace(first, last + end.size() - first, block);
  writeFileAtomically(file, [&](std::ostream& stream) { stream << content; });
}

} // namespace pcl6d::app
