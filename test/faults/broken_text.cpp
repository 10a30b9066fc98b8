// SPDX-License-Identifier: BSD-3-Clause
// Breakages of text: its numbers, its lines, its characters.
#include "breakage.h"
#include "extreme_numbers.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <utility>

namespace pcl6d::faults {

namespace {
struct Span {
  std::size_t at, length;
};

/** \return the numbers of a text that stand by themselves */
std::vector<Span>
numbersOf(const std::string& text)
{
  static const std::regex number(R"([-+]?[0-9]+\.?[0-9]*([eE][-+]?[0-9]+)?)");
  std::vector<Span> result;
  for (std::sregex_iterator i(text.begin(), text.end(), number), end; i != end; ++i) {
    const auto at = static_cast<std::size_t>(i->position());
    if (at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0)
      result.push_back({at, static_cast<std::size_t>(i->length())});
  }
  return result;
}

bool
isFinite(const std::string& number)
{
  return number.find("nan") == std::string::npos &&
         number.find("inf") == std::string::npos;
}

/** \return whether the number at a place says how many points there are */
bool
isCount(const std::string& text, std::size_t at)
{
  const std::size_t start = text.rfind('\n', at) + 1; // 0 in the first line
  for (const char* const word :
       {"POINTS ", "WIDTH ", "element vertex ", "element face "})
    if (text.compare(start, std::string(word).size(), word) == 0)
      return true;
  return false;
}

/** Each extreme value in the place of some number, in the header where there is one. */
Breakages
extremeNumbers(const Victim& victim, Random& random)
{
  Breakages result;
  const std::string text =
      victim.bytes.substr(0, isText(victim) ? std::string::npos : bodyOf(victim));
  const std::vector<Span> numbers = numbersOf(text);
  if (numbers.empty())
    return result;
  const bool header = bodyOf(victim) > 0;
  const auto in_header = static_cast<std::size_t>(
      std::count_if(numbers.begin(), numbers.end(), [&](const Span& number) {
        return number.at < bodyOf(victim);
      }));
  for (const std::string& value : extremeNumberTexts())
    for (int i = 0; i < 4; ++i) {
      const bool low = header && i % 2 == 0;
      const Span number = numbers[pick(random, low ? in_header : numbers.size())];
      const bool count =
          header && number.at < bodyOf(victim) && isCount(text, number.at);
      const bool hopeless =
          count || (victim.needs_all_numbers && victim.format == Format::kRows &&
                    !isFinite(value));
      result.push_back(
          withBytes(low ? "header-number" : "number",
                    hopeless,
                    replaced(victim.bytes, number.at, number.length, value)));
    }
  return result;
}

/** All numbers of the body times a factor: a scan or a path of another size. */
Breakages
scaledNumbers(const Victim& victim)
{
  Breakages result;
  const std::size_t body = bodyOf(victim);
  if (victim.format == Format::kConfig || !isText(victim))
    return result;
  const std::string text = victim.bytes.substr(body);
  for (const int digits : {-300, -30, -9, 4, 9, 12, 19, 30, 100, 250}) {
    std::string scaled = victim.bytes.substr(0, body);
    std::size_t done = 0;
    for (const Span number : numbersOf(text)) {
      scaled += text.substr(done, number.at + number.length - done);
      done = number.at + number.length;
      if (scaled.find_first_of("eE", scaled.size() - number.length) ==
          std::string::npos)
        scaled += "e" + std::to_string(digits);
    }
    result.push_back(
        withBytes("scaled", victim.holds_rotations, scaled + text.substr(done)));
  }
  return result;
}

/** \return the places where the lines of a text begin */
std::vector<Span>
linesOf(const std::string& text)
{
  std::vector<Span> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    lines.push_back({at, end - at});
    at = end;
  }
  return lines;
}

Breakages
changedLines(const Victim& victim, Random& random)
{
  Breakages result;
  const std::string& all = victim.bytes;
  const std::vector<Span> lines = linesOf(all);
  for (int i = 0; i < 10; ++i) {
    const Span a = lines[pick(random, lines.size())],
               b = lines[pick(random, lines.size())];
    const std::string line = all.substr(a.at, a.length);
    const std::size_t middle = a.at + a.length / 2;
    result.push_back(withBytes("lost-line", false, replaced(all, a.at, a.length, "")));
    result.push_back(withBytes("twice-line", false, replaced(all, a.at, 0, line)));
    result.push_back(withBytes("moved-line", false, replaced(all, b.at, 0, line)));
    result.push_back(withBytes("broken-line", false, replaced(all, middle, 0, "\n")));
    const std::size_t blank = line.find_last_of(" ,\t");
    if (blank != std::string::npos)
      result.push_back(withBytes(
          "lost-column", false, replaced(all, a.at + blank, a.length - 1 - blank, "")));
    result.push_back(
        withBytes("more-columns",
                  false,
                  replaced(all, a.at + a.length - 1, 0, i % 2 ? " 1 2 3" : ",1,2,3")));
  }
  return result;
}

Breakages
longTokens(const Victim& victim, Random& random)
{
  Breakages result;
  for (const std::size_t size : {100'000u, 10'000'000u})
    for (const char* const token : {"7", "x", " ", "1 ", "-", "0.", "\"", "<", "\n"}) {
      const std::size_t at = pick(random, victim.bytes.size());
      // The victim goes, its bytes stay: a copy in the closure.
      result.push_back(
          withMadeBytes(size > 1'000'000 ? "very-long" : "long",
                        false,
                        [bytes = victim.bytes, at, size, text = std::string(token)] {
                          std::string long_one;
                          while (long_one.size() < size)
                            long_one += text;
                          return replaced(bytes, at, 0, long_one);
                        }));
    }
  return result;
}

Breakages
oddCharacters(const Victim& victim, Random& random)
{
  static const std::vector<std::pair<const char*, std::string>> kOdd = {
      {"control", "\x1b[31m\x07"},
      {"control", "\x7f\x08\x0b"},
      {"control", std::string(1, '\0')},
      {"bad-utf8", "\xff\xfe\xc3"},
      {"bad-utf8", "\xed\xa0\x80"},
      {"bad-utf8", "\xf4\x90\x80\x80"},
      {"latin1", "B\xfcro"},
      {"utf8", "\u202e\u0416\u4e2d"},
      {"format", "%s%n%08x"},
      {"markup", "<script>alert(1)</script>&amp;"}};
  Breakages result;
  const std::string& all = victim.bytes;
  for (const auto& [kind, text] : kOdd)
    for (int i = 0; i < 3; ++i) {
      // Half of them inside words: names and texts.
      std::size_t at = pick(random, all.size());
      for (std::size_t k = 0; i > 0 && k < 200 && !std::isalpha(all[at] & 0x7f); ++k)
        at = pick(random, all.size());
      result.push_back(withBytes(kind, false, replaced(all, at, 0, text)));
    }
  std::string crlf;
  for (const char c : all)
    crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  std::string old_mac = all, wide;
  std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
  for (const char c : all)
    (wide += c) += '\0';
  result.push_back(withBytes("crlf", false, crlf));
  result.push_back(withBytes("cr", false, old_mac));
  result.push_back(withBytes("byte-order-mark", false, "\xef\xbb\xbf" + all));
  result.push_back(
      withBytes("utf16", victim.format != Format::kConfig, "\xff\xfe" + wide));
  return result;
}
} // namespace

Breakages
brokenText(const Victim& victim, Random& random)
{
  Breakages result = extremeNumbers(victim, random);
  if (!isText(victim) || victim.bytes.empty())
    return result;
  for (const auto& family : {scaledNumbers(victim),
                             changedLines(victim, random),
                             longTokens(victim, random),
                             oddCharacters(victim, random)})
    result.insert(result.end(), family.begin(), family.end());
  return result;
}

} // namespace pcl6d::faults
