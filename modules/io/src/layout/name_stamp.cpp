// SPDX-License-Identifier: BSD-3-Clause
#include "layout/name_stamp.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

namespace pcl6d {

using namespace io;

namespace {
constexpr std::size_t kSecondDigits = 10; // of seconds since 1970, from 2001 to 2286
constexpr std::size_t kMicrosecondDigits = 16, kNanosecondDigits = 19;
constexpr std::uint64_t kNanoseconds = 1000000000, kMicroseconds = 1000000; // a second

/** \return a number of digits without a leading zero; else empty */
std::optional<std::uint64_t>
wholeNumber(std::string_view word, std::size_t digits)
{
  std::uint64_t value = 0;
  const bool is_whole = word.size() == digits && word[0] != '0' &&
                        std::all_of(word.begin(), word.end(), [](unsigned char c) {
                          return std::isdigit(c) != 0;
                        });
  return is_whole && text::parseNumber(word, value) ? std::optional(value)
                                                    : std::nullopt;
}

/** \return up to nine digits, leading zeros included; else empty */
std::optional<std::uint64_t>
fractionOfSecond(std::string_view word)
{
  std::uint64_t value = 0;
  const bool is_fraction = !word.empty() && word.size() <= 9 &&
                           std::all_of(word.begin(), word.end(), [](unsigned char c) {
                             return std::isdigit(c) != 0;
                           });
  return is_fraction && text::parseNumber(word, value) ? std::optional(value)
                                                       : std::nullopt;
}

double
secondsOf(std::uint64_t count, std::uint64_t per_second)
{
  const std::uint64_t whole = count / per_second, rest = count % per_second;
  return static_cast<double>(whole) +
         static_cast<double>(rest) / static_cast<double>(per_second);
}

/** \return the part behind the last separator; without separator the whole name */
std::string_view
lastWord(std::string_view name, char separator)
{
  const std::size_t place = name.rfind(separator);
  return place == std::string_view::npos ? name : name.substr(place + 1);
}

/** \return the stamp from seconds and a fraction with a separator in between
 * \param[in] is_decimal whether digits behind the separator are decimals, or a number of
 * nanoseconds */
std::optional<double>
twoParts(std::string_view name, char separator, bool is_decimal)
{
  const std::size_t place = name.rfind(separator);
  if (place == std::string_view::npos)
    return std::nullopt;
  const std::string_view behind = name.substr(place + 1);
  const auto seconds = wholeNumber(lastWord(name.substr(0, place), '_'), kSecondDigits);
  const auto fraction = fractionOfSecond(behind);
  if (!seconds || !fraction)
    return std::nullopt;
  std::uint64_t steps = kNanoseconds;
  if (is_decimal) {
    steps = 1;
    for (std::size_t i = 0; i < behind.size(); ++i)
      steps *= 10;
  }
  return static_cast<double>(*seconds) +
         static_cast<double>(*fraction) / static_cast<double>(steps);
}
} // namespace

std::optional<NameStamp>
io::stampOfName(const std::filesystem::path& scan)
{
  std::filesystem::path stem = scan.stem();
  if (stem.extension() == ".pcd") // nuScenes: .pcd.bin
    stem = stem.stem();
  const std::string name = stem.string();
  const std::string_view last = lastWord(name, '_');
  if (const auto count = wholeNumber(last, kNanosecondDigits))
    return NameStamp{secondsOf(*count, kNanoseconds), ScanNames::kNanoseconds};
  if (const auto count = wholeNumber(last, kMicrosecondDigits))
    return NameStamp{secondsOf(*count, kMicroseconds), ScanNames::kMicroseconds};
  if (const auto seconds = twoParts(name, '_', false))
    return NameStamp{*seconds, ScanNames::kSecondsNanoseconds};
  if (const auto seconds = twoParts(name, '.', true))
    return NameStamp{*seconds, ScanNames::kDecimal};
  return std::nullopt;
}

std::vector<double>
stampsOfNames(const std::vector<std::filesystem::path>& scans)
{
  std::vector<double> stamps;
  for (const auto& scan : scans) {
    const auto stamp = stampOfName(scan);
    if (!stamp || (!stamps.empty() && stamp->seconds <= stamps.back()))
      return {};
    stamps.push_back(stamp->seconds);
  }
  return stamps;
}

} // namespace pcl6d
