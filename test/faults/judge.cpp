// SPDX-License-Identifier: BSD-3-Clause
#include "breakage.h"
#include "judge.h"
#include "support/temp_folder.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <sstream>

namespace pcl6d::faults {

namespace {
namespace fs = std::filesystem;

constexpr std::size_t kMuchMemory = 500'000'000; // [B] for inputs below 1 MB
constexpr std::size_t kLongLine = 2000;          // [B]

/** Words of libraries and of the language, which tell a user nothing. */
const std::vector<std::string> kRawWords = {": Success",
                                            "error: Invalid argument\n",
                                            "error: Resource temporarily",
                                            "std::",
                                            "vector::",
                                            "basic_",
                                            "[json.exception",
                                            "boost::",
                                            "terminate called",
                                            "pcl::",
                                            "what():",
                                            "cv::",
                                            "OpenCV(",
                                            "_S_create",
                                            "locale::facet",
                                            "Assertion",
                                            "bad_alloc",
                                            "stoi",
                                            "stod",
                                            "regex_error",
                                            "map::at",
                                            "string::",
                                            "iostream error",
                                            "[ERROR",
                                            "[ WARN",
                                            "nlohmann",
                                            "ERROR: In ",
                                            "Error: In "};

std::vector<std::string>
crashes(const Trace& trace)
{
  std::vector<std::string> result;
  const Ended& end = trace.end;
  if (end.signal != 0 && !end.timed_out)
    result.push_back("signal " + std::to_string(end.signal) + " (" +
                     ::strsignal(end.signal) + ")");
  else if (!end.timed_out && (end.exit_code < 0 || end.exit_code > 3))
    result.push_back("exit code " + std::to_string(end.exit_code));
  for (const char* const report : {"ERROR: AddressSanitizer",
                                   "runtime error: ",
                                   "WARNING: ThreadSanitizer",
                                   "ERROR: LeakSanitizer"})
    if (trace.err.find(report) != std::string::npos)
      result.push_back(trace.err.substr(trace.err.find(report), 200));
  return result;
}

/** \return whether memory ran out within the limit that protects the machine */
bool
ranOut(const Trace& trace)
{
  for (const char* const words : {"bad_alloc",
                                  "out of memory",
                                  "ut of memory",
                                  "not enough memory",
                                  "cannot allocate",
                                  "Failed to allocate"})
    if (trace.err.find(words) != std::string::npos)
      return true;
  return false;
}

std::string
lineAround(const std::string& text, std::size_t at)
{
  const std::size_t start = text.rfind('\n', at) + 1;
  const std::size_t from = std::max(start, at < 80 ? 0 : at - 80);
  std::string line =
      text.substr(from, std::min(text.find('\n', at) - from, std::size_t{200}));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 32 || c == 127)
      c = '?';
  return line;
}

void
addRawTexts(const std::string& text, std::vector<std::string>& found)
{
  for (const std::string& word : kRawWords) {
    const std::size_t at = text.find(word);
    if (at != std::string::npos) {
      found.push_back('"' + word + "\" in: " + lineAround(text, at));
      break;
    }
  }
  const auto control = std::find_if(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 32 && c != '\n' && c != '\t') || byte == 127;
  });
  if (control != text.end())
    found.push_back(
        "a control character (" + std::to_string(static_cast<unsigned char>(*control)) +
        ") in: " + lineAround(text, static_cast<std::size_t>(control - text.begin())));
  std::size_t longest = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    longest = std::max(longest, end - at);
    at = end + 1;
  }
  if (longest > kLongLine)
    found.push_back("a line of " + std::to_string(longest) + " bytes");
}

std::vector<std::string>
rawTexts(const Case& one, const Trace& trace)
{
  std::vector<std::string> found;
  addRawTexts(trace.err, found);
  addRawTexts(trace.out, found);
  const Ended& end = trace.end;
  const bool failed =
      !end.timed_out && end.signal == 0 && (end.exit_code == 1 || end.exit_code == 2);
  const std::string prefix = one.program + ": error: ";
  if (failed && trace.err.rfind(prefix, 0) != 0 &&
      trace.err.find('\n' + prefix) == std::string::npos)
    found.push_back("exit code " + std::to_string(end.exit_code) + " without \"" +
                    prefix + "...\"");
  return found;
}

/** \return whether a path is the output, or lies in it, that the caller named */
bool
isOutput(const Case& one, const std::string& path)
{
  const auto holds = [](const std::vector<std::string>& all, const std::string& name) {
    return std::find(all.begin(), all.end(), name) != all.end();
  };
  const std::string first = path.substr(0, path.find('/'));
  return first.rfind("out", 0) == 0 ||
         (holds(one.arguments, first) && !holds(one.inputs, first));
}

bool
isTemporary(const std::string& path)
{
  const std::string name = fs::path(path).filename();
  return name.rfind('.', 0) == 0 || name.find("tmp") != std::string::npos;
}

std::vector<std::string>
leftovers(const Case& one, const Trace& trace)
{
  std::vector<std::string> found;
  const bool killed = trace.end.timed_out || trace.end.signal != 0;
  if (killed)
    return found; // said already
  for (const auto& [path, content] : trace.after) {
    const auto before = trace.before.find(path);
    if (before != trace.before.end()) {
      if (before->second != content && !isOutput(one, path))
        found.push_back("input changed: " + path);
    }
    else if (!isOutput(one, path))
      found.push_back("new: " + path);
    else if (isTemporary(path))
      found.push_back("temporary: " + path);
    else if (trace.end.exit_code != 0 && trace.end.exit_code != 3 &&
             path.find('/') == std::string::npos && content != "folder")
      found.push_back("a result in spite of the error: " + path);
  }
  for (const auto& [path, content] : trace.before)
    if (trace.after.count(path) == 0 && !isOutput(one, path))
      found.push_back("input lost: " + path);
  if (trace.left_processes > 0)
    found.push_back(std::to_string(trace.left_processes) + " processes");
  return found;
}
} // namespace

Listing
listingOf(const fs::path& folder)
{
  Listing listing;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(folder, ignored)) {
    const fs::file_status status = entry.symlink_status(ignored);
    std::string content = "other";
    if (fs::is_directory(status))
      content = "folder";
    else if (fs::is_regular_file(status))
      content = std::to_string(hashOf(test::readText(entry.path())));
    listing[entry.path().lexically_relative(folder).string()] = content;
  }
  return listing;
}

std::vector<Finding>
evaluate(const Case& one, const Trace& trace)
{
  std::vector<Finding> findings;
  const auto add = [&](const std::string& kind, const std::vector<std::string>& found) {
    for (const std::string& what : found)
      findings.push_back({kind, what});
  };
  const Ended& end = trace.end;
  add("crash", crashes(trace));
  if (end.timed_out)
    findings.push_back(
        {"hang", "ended after " + std::to_string(int(end.seconds)) + " s"});
  if (trace.input_size < 1'000'000 && (end.peak_memory > kMuchMemory || ranOut(trace)))
    findings.push_back({"memory", std::to_string(end.peak_memory / 1'000'000) + " MB"});
  add("raw text", rawTexts(one, trace));
  add("leftover", leftovers(one, trace));
  const bool done = !end.timed_out && end.signal == 0 && end.exit_code == 0;
  if (one.hopeless && done)
    findings.push_back({"false success", "exit code 0"});
  if (one.intact && !done && end.exit_code != 3)
    findings.push_back({"not whole",
                        "exit code " + std::to_string(end.exit_code) + ": " +
                            trace.err.substr(0, 300)});
  return findings;
}

} // namespace pcl6d::faults
