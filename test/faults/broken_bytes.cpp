// SPDX-License-Identifier: BSD-3-Clause
// Breakages that know of bytes only, and what may stand in a file's place.
#include "breakage.h"

#include <algorithm>
#include <sys/stat.h>

namespace pcl6d::faults {

namespace {
namespace fs = std::filesystem;

constexpr int kPlaces = 12; // of each kind: round robin takes as many as are asked for

/** \return whether what is left of a file cannot be taken for a whole one */
bool
isHopelessCut(const Victim& victim, std::size_t size)
{
  const std::string& all = victim.bytes;
  const std::size_t end = all.find_last_not_of(" \n\r\t");
  switch (victim.format) {
  case Format::kJson:
  case Format::kXml:
    return end != std::string::npos && size <= end;
  case Format::kPcd:
  case Format::kPly: // rows are counted: one that is lost, or none after its header
    return std::count(
               all.begin() + static_cast<std::ptrdiff_t>(size), all.end(), '\n') > 1 ||
           !isText(victim);
  case Format::kStl:
    return true;
  case Format::kPng: // the last chunk holds nothing
    return size + 12 < all.size();
  case Format::kFloats:
    return size % 16 != 0;
  default:
    return false;
  }
}

Breakages
cutBytes(const Victim& victim, Random& random)
{
  Breakages result;
  const std::string& all = victim.bytes;
  const std::size_t body = bodyOf(victim);
  for (int i = 0; i < kPlaces; ++i) {
    // In the header, anywhere, and near the end.
    const std::size_t within = i % 3 == 0 && body > 0 ? body : all.size();
    std::size_t size = pick(random, within);
    if (i % 3 == 2)
      size = all.size() - 1 - pick(random, std::min<std::size_t>(24, all.size() - 1));
    result.push_back(
        withBytes("cut",
                  size == 0 ? !victim.may_be_empty : isHopelessCut(victim, size),
                  all.substr(0, size)));
  }
  return result;
}

/** Changes that keep the length, or change it by a block. */
Breakages
changedBytes(const Victim& victim, Random& random)
{
  Breakages result;
  const std::string& all = victim.bytes;
  const std::size_t body = bodyOf(victim);
  for (int i = 0; i < kPlaces; ++i) {
    const std::size_t within = i % 2 == 0 && body > 0 ? body : all.size();
    const std::size_t at = pick(random, within);
    const std::size_t length = std::min(all.size() - at, 1 + pick(random, 64));
    std::string flipped = all, noise = all, swapped = all;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << pick(random, 8)));
    for (int k = 0; k < 8; ++k)
      noise[pick(random, within)] = static_cast<char>(pick(random, 256));
    std::swap(swapped[at], swapped[pick(random, within)]);
    const std::string block = all.substr(at, length);
    result.push_back(withBytes("flip", false, flipped));
    result.push_back(withBytes("noise", false, noise));
    result.push_back(withBytes("swap", false, swapped));
    result.push_back(withBytes("lost-block", false, replaced(all, at, length, "")));
    result.push_back(withBytes("twice-block", false, replaced(all, at, 0, block)));
    result.push_back(withBytes(
        "zero-block", false, replaced(all, at, length, std::string(length, '\0'))));
  }
  return result;
}

Breakages
otherContent(const Victim& victim, Random& random)
{
  const std::string& all = victim.bytes;
  std::string noise;
  for (int i = 0; i < 1001; ++i)
    noise += static_cast<char>(pick(random, 256));
  // Comments of a config file may be anything, and any bytes are some float.
  const bool none = victim.format != Format::kFloats && victim.format != Format::kBytes;
  return {
      withBytes("empty", !victim.may_be_empty, ""),
      withBytes("blank", !victim.may_be_empty, "\n \n\t\n"),
      withBytes("one-byte", none, all.substr(0, 1) == "#" ? "x" : all.substr(0, 1)),
      withBytes("one-zero", none, std::string(1, '\0')),
      withBytes("zeros", none, std::string(all.size(), '\0')),
      withBytes("ones", none, std::string(all.size(), '\xff')),
      withBytes("random", none, noise),
      withBytes("other-format", none, "\x89PNG\r\n\x1a\n" + noise),
      withBytes(
          "html", none, "<!DOCTYPE html>\n<html><body>404 Not Found</body></html>\n"),
      withBytes("twice", false, all + all),
      withBytes("tail", false, all + noise),
  };
}
} // namespace

Breakages
brokenBytes(const Victim& victim, Random& random)
{
  Breakages result = otherContent(victim, random);
  if (victim.bytes.empty())
    return result;
  for (const auto& family : {cutBytes(victim, random), changedBytes(victim, random)})
    result.insert(result.end(), family.begin(), family.end());
  return result;
}

Breakages
brokenPlaces(const Victim& victim)
{
  const auto linkTo = [](const fs::path& target) {
    return [target](const fs::path& file) { fs::create_symlink(target, file); };
  };
  const auto instead =
      [](const std::string& kind, const auto& make, bool hopeless = true) {
        return Breakage{kind, hopeless, [make](const fs::path& file) {
                          fs::remove(file);
                          make(file);
                        }};
      };
  return {
      instead(
          "missing", [](const fs::path&) {}, !victim.may_be_missing),
      instead("pipe", [](const fs::path& file) { ::mkfifo(file.c_str(), 0600); }),
      instead("folder", [](const fs::path& file) { fs::create_directory(file); }),
      instead("device", linkTo("/dev/zero")),
      instead("null-device", linkTo("/dev/null"), !victim.may_be_empty),
      instead("dangling-link", linkTo("nowhere")),
      instead("link-to-itself",
              [](const fs::path& file) { fs::create_symlink(file.filename(), file); }),
      instead("no-memory-file", linkTo("/proc/self/mem")),
  };
}

} // namespace pcl6d::faults
