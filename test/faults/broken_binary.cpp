// SPDX-License-Identifier: BSD-3-Clause
// Breakages of formats whose numbers are bytes: floats, counts, sizes, chunks.
#include "breakage.h"

#include <array>
#include <cstring>
#include <limits>

namespace pcl6d::faults {

namespace {
template <typename T>
std::string
bytesOf(T value)
{
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/** \return the bytes of a number, the most significant first */
std::string
bigEndian(std::uint32_t value)
{
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes += static_cast<char>(value >> shift);
  return bytes;
}

/** Extreme float32 numbers at some of the places where numbers are. */
Breakages
brokenFloats(const std::string& all, std::size_t body, Random& random)
{
  using Limits = std::numeric_limits<float>;
  Breakages result;
  const std::size_t count = (all.size() - body) / sizeof(float);
  if (count == 0)
    return result;
  for (const float value : {Limits::quiet_NaN(),
                            Limits::infinity(),
                            -Limits::infinity(),
                            Limits::max(),
                            Limits::denorm_min(),
                            -0.0F,
                            1e10F,
                            1e20F,
                            -1e30F})
    for (const std::size_t share : {1u, 4u, 40u, 0u}) { // of 0: all
      std::string broken = all;
      const std::size_t first = share ? pick(random, count) : 0;
      const std::size_t last = share ? std::min(count, first + share) : count;
      for (std::size_t i = first; i < last; ++i)
        broken.replace(body + i * sizeof(float), sizeof(float), bytesOf(value));
      result.push_back(withBytes(share ? "float" : "all-floats", false, broken));
    }
  return result;
}

/** A count of four bytes that the file does not hold. */
Breakages
brokenCount(const std::string& all, std::size_t at, const std::string& kind)
{
  Breakages result;
  if (at + 4 > all.size())
    return result;
  for (const std::uint32_t value :
       {0u, 1u, 0x7fffffffu, 0x80000000u, 0xffffffffu, 1'000'000'000u, 100'000u})
    result.push_back(withBytes(kind, value > 1, replaced(all, at, 4, bytesOf(value))));
  return result;
}

/** \return the checksum of PNG's chunks (ISO 3309) */
std::uint32_t
checksum(const std::string& bytes)
{
  std::uint32_t sum = 0xffffffffu;
  for (const char c : bytes) {
    sum ^= static_cast<unsigned char>(c);
    for (int i = 0; i < 8; ++i)
      sum = (sum >> 1) ^ (sum & 1 ? 0xedb88320u : 0);
  }
  return ~sum;
}

/** Width, height, depth and colour type that are not the picture's, rightly summed. */
Breakages
brokenPng(const std::string& all)
{
  constexpr std::size_t kChunk = 12, kLength = 17; // "IHDR" and its 13 bytes
  Breakages result;
  const auto with = [&](std::size_t at, const std::string& bytes) {
    const std::string chunk =
        replaced(all.substr(kChunk, kLength), at, bytes.size(), bytes);
    result.push_back(withBytes(
        "png-header",
        false,
        replaced(all, kChunk, kLength + 4, chunk + bigEndian(checksum(chunk)))));
  };
  for (const std::size_t side : {4u, 8u})
    for (const std::uint32_t value :
         {0u, 1u, 65u, 100'000u, 0x7fffffffu, 0x80000000u, 0xffffffffu})
      with(side, bigEndian(value));
  with(4, bigEndian(100'000) + bigEndian(100'000));
  for (const char value : {'\0', '\1', '\10', '\20', '\77'})
    for (const std::size_t at : {12u, 13u, 16u}) // depth, colour, interlace
      with(at, std::string(1, value));
  return result;
}
} // namespace

Breakages
brokenBinary(const Victim& victim, Random& random)
{
  const std::string& all = victim.bytes;
  const std::size_t body = bodyOf(victim);
  switch (victim.format) {
  case Format::kFloats:
    return brokenFloats(all, 0, random);
  case Format::kPng:
    return brokenPng(all);
  case Format::kStl: {
    Breakages result = brokenCount(all, 80, "stl-count");
    for (const auto& more : brokenFloats(all, 84, random))
      result.push_back(more);
    return result;
  }
  case Format::kPcd:
  case Format::kPly: {
    if (isText(victim))
      return {};
    if (all.compare(0, body, "") &&
        all.rfind("binary_compressed", body) != std::string::npos) {
      Breakages result = brokenCount(all, body, "packed-size");
      for (const auto& more : brokenCount(all, body + 4, "unpacked-size"))
        result.push_back(more);
      return result;
    }
    return brokenFloats(all, body, random);
  }
  default:
    return {};
  }
}

} // namespace pcl6d::faults
