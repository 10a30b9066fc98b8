// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/mutate.h"

#include <boost/crc.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <vector>

namespace pcl6d::fuzz {

namespace {
using Generator = std::mt19937;

// Limits of types, what overflows when it is squared, multiplied by a point's size or cast,
// and what is a number only for some.
const std::array<const char*, 36> kNumbers = {"0",
                                              "-0",
                                              "1",
                                              "-1",
                                              "2",
                                              "3",
                                              "7",
                                              "127",
                                              "255",
                                              "256",
                                              "1000",
                                              "32768",
                                              "65535",
                                              "65536",
                                              "1000000",
                                              "16777217",
                                              "2147483647",
                                              "-2147483648",
                                              "4294967295",
                                              "4294967296",
                                              "1000000000",
                                              "1e9",
                                              "1e20",
                                              "-1e20",
                                              "1e100",
                                              "1e308",
                                              "1e309",
                                              "-1e309",
                                              "1e-320",
                                              "0.5",
                                              "nan",
                                              "inf",
                                              "-inf",
                                              "0x10",
                                              "9223372036854775807",
                                              "18446744073709551615"};

std::size_t
below(Generator& random, std::size_t end)
{
  return end == 0 ? 0 : random() % end;
}

struct Span {
  std::size_t begin, end;
};

bool
isWord(char c)
{
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
         c == '.' || c == '+' || c == '-' || c == '_';
}

/** \return the words of a text, numbers alone or all of them */
std::vector<Span>
wordsOf(const std::string& text, bool numbers)
{
  std::vector<Span> words;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t begin = i;
    while (i < text.size() && isWord(text[i]))
      ++i;
    const bool starts_as_number =
        i > begin && (text[begin] < 'A' || text.compare(begin, 3, "nan") == 0);
    if (i > begin && (!numbers || starts_as_number))
      words.push_back({begin, i});
    i = std::max(i, begin + 1);
  }
  return words;
}

std::vector<Span>
linesOf(const std::string& text)
{
  std::vector<Span> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t found = text.find('\n', begin);
    const std::size_t end = found == std::string::npos ? text.size() : found + 1;
    lines.push_back({begin, end});
    begin = end;
  }
  return lines;
}

std::string
part(const std::string& text, Span span)
{
  return text.substr(span.begin, span.end - span.begin);
}

/** Another number; in place of all that are equal to it, as counts are said twice. */
void
changeNumber(std::string& text, Generator& random)
{
  const auto numbers = wordsOf(text, true);
  if (numbers.empty())
    return;
  const Span chosen = numbers[below(random, numbers.size())];
  const std::string old = part(text, chosen);
  const std::string now = random() % 3 == 0 ? std::to_string(random() % 20)
                                            : kNumbers[below(random, kNumbers.size())];
  if (random() % 2 == 0) {
    text.replace(chosen.begin, old.size(), now);
    return;
  }
  for (auto number = numbers.rbegin(); number != numbers.rend(); ++number)
    if (part(text, *number) == old)
      text.replace(number->begin, old.size(), now);
}

/** A word of the text in the place of another. */
void
copyWord(std::string& text, Generator& random)
{
  const auto words = wordsOf(text, false);
  if (words.empty())
    return;
  const std::string word = part(text, words[below(random, words.size())]);
  const Span place = words[below(random, words.size())];
  text.replace(place.begin, place.end - place.begin, word);
}

/** A line twice, gone, or in another place. */
void
changeLine(std::string& text, Generator& random)
{
  const auto lines = linesOf(text);
  if (lines.empty())
    return;
  const Span line = lines[below(random, lines.size())];
  const std::string content = part(text, line);
  const unsigned int kind = random() % 3;
  const std::size_t place = lines[below(random, lines.size())].begin;
  if (kind > 0) // twice, or moved
    text.insert(place, content);
  if (kind < 2) // gone, or moved
    text.erase(line.begin + (kind > 0 && place <= line.begin ? content.size() : 0),
               content.size());
}

/** Brackets in brackets, as many as break a reader that calls itself. */
void
nest(std::string& text, Generator& random)
{
  const std::array<std::array<const char*, 2>, 4> kinds = {
      {{"[", "]"}, {"{\"a\":", "}"}, {"<g>", "</g>"}, {"(", ")"}}};
  const auto& [open, close] = kinds[below(random, kinds.size())];
  const std::size_t depth = std::size_t(1) << below(random, 14);
  const auto words = wordsOf(text, true);
  const Span place =
      words.empty() ? Span{0, text.size()} : words[below(random, words.size())];
  std::string nested;
  for (std::size_t i = 0; i < depth; ++i)
    nested += open;
  nested += part(text, place);
  for (std::size_t i = 0; i < depth && random() % 8 > 0; ++i) // at times not all closed
    nested += close;
  text.replace(place.begin, place.end - place.begin, nested);
}

std::string
mutateBytes(std::string content, std::size_t max_size, const ByteMutator& bytes)
{
  const std::size_t size = std::min(content.size(), max_size);
  content.resize(max_size);
  content.resize(
      bytes(reinterpret_cast<std::uint8_t*>(content.data()), size, max_size));
  return content;
}

std::string
mutateText(std::string text,
           std::size_t max_size,
           Generator& random,
           const ByteMutator& bytes)
{
  switch (random() % 8) {
  case 0:
  case 1:
  case 2:
    changeNumber(text, random);
    break;
  case 3:
    copyWord(text, random);
    break;
  case 4:
    changeLine(text, random);
    break;
  case 5:
    if (random() % 8 == 0)
      nest(text, random);
    else
      changeNumber(text, random);
    break;
  default:
    return mutateBytes(std::move(text), max_size, bytes);
  }
  return text;
}

/** Writes a number of 4 bytes somewhere: sizes of compressed blocks, counts, indices. */
void
changeWord32(std::string& body, Generator& random)
{
  const std::array<std::uint32_t, 9> values = {0,
                                               1,
                                               3,
                                               255,
                                               0x7FC00000 /* nan */,
                                               0x7FFFFFFF,
                                               0x80000000,
                                               0xFFFFFFFF,
                                               0x00010000};
  if (body.size() < 4)
    return;
  const bool at_start = random() % 2 == 0; // where sizes stand
  const std::size_t place =
      at_start ? 4 * below(random, std::min<std::size_t>(2, body.size() / 4))
               : below(random, body.size() - 3);
  const std::uint32_t value = random() % 3 == 0
                                  ? static_cast<std::uint32_t>(body.size())
                                  : values[below(random, values.size())];
  std::memcpy(body.data() + place, &value, sizeof value);
}

/** \param[in] last the word with which the last line of the header begins */
std::string
mutateHeaderAndBody(const std::string& content,
                    const std::string& last,
                    std::size_t max_size,
                    Generator& random,
                    const ByteMutator& bytes)
{
  const std::size_t word = content.find(last);
  const std::size_t end = word == std::string::npos ? word : content.find('\n', word);
  if (end == std::string::npos)
    return mutateText(content, max_size, random, bytes);
  std::string header = content.substr(0, end + 1), body = content.substr(end + 1);
  if (random() % 2 == 0)
    header = mutateText(std::move(header), max_size, random, bytes);
  else if (random() % 3 == 0)
    changeWord32(body, random);
  else if (header.find("ascii") != std::string::npos)
    body = mutateText(std::move(body), max_size, random, bytes);
  else if (header.size() < max_size)
    body = mutateBytes(std::move(body), max_size - header.size(), bytes);
  return header + body;
}

std::string
mutateStl(std::string content,
          std::size_t max_size,
          Generator& random,
          const ByteMutator& bytes)
{
  constexpr std::size_t kHead = 84, kTriangle = 50;
  if (content.size() < kHead || content.compare(0, 5, "solid") == 0)
    return mutateText(std::move(content), max_size, random, bytes);
  std::string head = content.substr(0, kHead), body = content.substr(kHead);
  if (max_size > kHead)
    body = mutateBytes(std::move(body), max_size - kHead, bytes);
  const bool fits = random() % 4 > 0;
  const auto count =
      static_cast<std::uint32_t>(fits ? body.size() / kTriangle : random());
  if (fits)
    body.resize(count * kTriangle);
  std::memcpy(head.data() + kHead - sizeof count, &count, sizeof count);
  return head + body;
}

/** Bytes of the records, then sizes and checksums that fit them. */
std::string
mutateRecords(std::string content,
              std::size_t max_size,
              Generator& random,
              const ByteMutator& bytes)
{
  const std::size_t end = content.find('\n');
  if (end == std::string::npos || end + 1 >= max_size)
    return mutateBytes(std::move(content), max_size, bytes);
  const std::string head = content.substr(0, end + 1);
  std::string body =
      mutateBytes(content.substr(end + 1), max_size - head.size(), bytes);
  constexpr std::size_t kRecordHead = 16; // size and checksum
  const bool mends = random() % 4 > 0;
  for (std::size_t place = 0; mends && body.size() - place >= kRecordHead;) {
    std::uint64_t size = 0;
    std::memcpy(&size, body.data() + place, sizeof size);
    size = std::min<std::uint64_t>(size, body.size() - place - kRecordHead);
    boost::crc_32_type crc;
    crc.process_bytes(&size, sizeof size);
    crc.process_bytes(body.data() + place + kRecordHead, size);
    const std::uint64_t checksum = crc.checksum();
    std::memcpy(body.data() + place, &size, sizeof size);
    std::memcpy(body.data() + place + sizeof size, &checksum, sizeof checksum);
    place += kRecordHead + size;
  }
  return head + body;
}

std::string
mutateByStructure(const std::string& content,
                  Structure structure,
                  std::size_t max_size,
                  Generator& random,
                  const ByteMutator& bytes)
{
  switch (structure) {
  case Structure::kText:
    return mutateText(content, max_size, random, bytes);
  case Structure::kPcd:
    return mutateHeaderAndBody(content, "DATA", max_size, random, bytes);
  case Structure::kPly:
    return mutateHeaderAndBody(content, "end_header", max_size, random, bytes);
  case Structure::kStl:
    return mutateStl(content, max_size, random, bytes);
  case Structure::kRecordFile:
    return mutateRecords(content, max_size, random, bytes);
  case Structure::kBytes:
    break;
  }
  return mutateBytes(content, max_size, bytes);
}
} // namespace

std::string
mutate(const std::string& content,
       Structure structure,
       std::size_t max_size,
       unsigned int seed,
       const ByteMutator& bytes)
{
  Generator random(seed);
  constexpr unsigned int kOneInPlain = 8; // so that nothing is out of reach
  std::string changed =
      random() % kOneInPlain == 0
          ? mutateBytes(content, max_size, bytes)
          : mutateByStructure(content, structure, max_size, random, bytes);
  changed.resize(std::min(changed.size(), max_size));
  return changed;
}

} // namespace pcl6d::fuzz
