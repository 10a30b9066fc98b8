// SPDX-License-Identifier: BSD-3-Clause
#include "support/temp_folder.h"
#include "targets.h"
#include "text_table.h"

#include <map>

namespace pcl6d::faults {

namespace {
namespace fs = std::filesystem;

const std::map<std::string, Format> kFormats = {{"rows", Format::kRows},
                                                {"pcd", Format::kPcd},
                                                {"ply", Format::kPly},
                                                {"floats", Format::kFloats},
                                                {"stl", Format::kStl},
                                                {"png", Format::kPng},
                                                {"bytes", Format::kBytes},
                                                {"json", Format::kJson},
                                                {"xml", Format::kXml},
                                                {"yaml", Format::kYaml},
                                                {"config", Format::kConfig}};

/** \return program, job and file, as a name for cases */
std::string
nameOf(const Case& call, const std::string& broken)
{
  std::string name = call.program.substr(std::string("pcl_slam6d").size());
  name = name.empty() ? "slam6d" : name.substr(1);
  const std::string job = call.arguments.front();
  if (!fs::path(job).has_extension() && job.find_first_of("/_") == std::string::npos)
    name += '-' + job; // the programs with one job take a file or a folder first
  return name + '/' + broken;
}
} // namespace

std::vector<Target>
readTargets(const fs::path& file)
{
  std::vector<Target> targets;
  for (const std::vector<std::string>& row : rowsOf(file, 6)) {
    Target target;
    target.cases = std::stoul(row[0]);
    target.format = kFormats.at(row[1]);
    target.needs_all_numbers = row[2].find("numbers") == std::string::npos;
    target.may_be_empty = row[2].find("empty") != std::string::npos;
    target.may_be_missing = row[2].find("missing") != std::string::npos;
    target.holds_rotations = row[2].find("rotations") != std::string::npos;
    target.broken = row[3];
    target.inputs = row[4];
    target.call = row[5];
    targets.push_back(target);
  }
  return targets;
}

std::vector<Case>
brokenInputCases(const std::vector<Target>& targets,
                 const fs::path& samples,
                 std::uint64_t seed)
{
  std::vector<Case> cases;
  std::map<std::string, int> count;
  for (const Target& target : targets) {
    Case whole;
    setCall(whole, target.inputs, target.call);
    std::string name = nameOf(whole, target.broken);
    if (++count[name] > 1) // another call that reads the same file
      name += " (" + std::to_string(count[name]) + ")";
    whole.name = name + "/whole";
    whole.intact = true;
    cases.push_back(whole);
    Victim victim;
    victim.format = target.format;
    victim.bytes = test::readText(samples / target.broken);
    victim.needs_all_numbers = target.needs_all_numbers;
    victim.may_be_empty = target.may_be_empty;
    victim.may_be_missing = target.may_be_missing;
    victim.holds_rotations = target.holds_rotations;
    std::map<std::string, int> of_kind;
    for (const Breakage& breakage :
         breakagesOf(victim, target.cases, mixBits(seed) ^ hashOf(name))) {
      Case broken = whole;
      broken.intact = false;
      broken.hopeless = breakage.hopeless;
      broken.name =
          name + '/' + breakage.kind + '-' + std::to_string(++of_kind[breakage.kind]);
      broken.prepare = [apply = breakage.apply,
                        file = target.broken](const fs::path& in) { apply(in / file); };
      cases.push_back(std::move(broken));
    }
  }
  return cases;
}

} // namespace pcl6d::faults
