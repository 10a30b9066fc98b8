// SPDX-License-Identifier: BSD-3-Clause
#include "breakage.h"
#include "support/temp_folder.h"

#include <map>
#include <utility>

namespace pcl6d::faults {

Breakage
withBytes(const std::string& kind, bool hopeless, std::string bytes)
{
  return {
      kind, hopeless, [bytes = std::move(bytes)](const std::filesystem::path& file) {
        test::writeText(file, bytes);
      }};
}

Breakage
withMadeBytes(const std::string& kind, bool hopeless, std::function<std::string()> make)
{
  return {kind, hopeless, [make = std::move(make)](const std::filesystem::path& file) {
            test::writeText(file, make());
          }};
}

std::string
replaced(const std::string& text,
         std::size_t at,
         std::size_t length,
         const std::string& with)
{
  return std::string(text).replace(at, length, with);
}

std::size_t
bodyOf(const Victim& victim)
{
  const char* const last = victim.format == Format::kPcd   ? "\nDATA "
                           : victim.format == Format::kPly ? "\nend_header"
                                                           : nullptr;
  if (!last)
    return 0;
  const std::size_t at = victim.bytes.find(last);
  const std::size_t end =
      at == std::string::npos ? at : victim.bytes.find('\n', at + 1);
  return end == std::string::npos ? victim.bytes.size() : end + 1;
}

bool
isText(const Victim& victim)
{
  switch (victim.format) {
  case Format::kFloats:
  case Format::kStl:
  case Format::kPng:
  case Format::kBytes:
    return false;
  default:
    return victim.bytes.find('\0') == std::string::npos;
  }
}

Breakages
breakagesOf(const Victim& victim, std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  std::map<std::string, Breakages> by_kind; // in an order of its own, not in memory's
  for (const auto& family : {brokenBytes(victim, random),
                             brokenPlaces(victim),
                             brokenText(victim, random),
                             brokenTree(victim, random),
                             brokenBinary(victim, random)})
    for (const auto& breakage : family)
      by_kind[breakage.kind].push_back(breakage);
  Breakages chosen;
  while (chosen.size() < count && !by_kind.empty())
    for (auto kind = by_kind.begin(); kind != by_kind.end() && chosen.size() < count;) {
      Breakages& rest = kind->second;
      const auto one =
          rest.begin() + static_cast<std::ptrdiff_t>(pick(random, rest.size()));
      chosen.push_back(std::move(*one));
      rest.erase(one);
      kind = rest.empty() ? by_kind.erase(kind) : std::next(kind);
    }
  return chosen;
}

} // namespace pcl6d::faults
