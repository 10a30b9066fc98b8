// SPDX-License-Identifier: BSD-3-Clause
#include "common/printable.h"

#include <algorithm>
#include <string_view>

namespace pcl6d::app {

namespace {
unsigned char
byteOf(char c)
{
  return static_cast<unsigned char>(c);
}

bool
continues(char c)
{
  return (byteOf(c) & 0xC0U) == 0x80U;
}

/** \return the length [bytes] of the UTF-8 character at the start of a text; 0: not a
 * printable character */
std::size_t
shownBytes(std::string_view text)
{
  const unsigned char first = byteOf(text[0]);
  if (first < 0x80)
    return first >= ' ' && first != 0x7f ? 1 : 0;
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < size ||
      !std::all_of(text.begin() + 1, text.begin() + size, continues))
    return 0;
  const bool is_control = first == 0xC2 && byteOf(text[1]) < 0xA0;
  return is_control ? 0 : size;
}

std::string
escaped(char c)
{
  constexpr char kDigits[] = "0123456789abcdef";
  if (c == '\n')
    return "\\n";
  return {'\\', 'x', kDigits[byteOf(c) / 16], kDigits[byteOf(c) % 16]};
}

/** \return the text without its middle \param[in] size [bytes] of the remaining text,
 * exceeded by a few bytes */
std::string
shortened(const std::string& text, std::size_t size)
{
  std::size_t head = 2 * size / 3, tail = text.size() - size / 3;
  while (head > 0 && continues(text[head])) // no half characters
    --head;
  while (tail < text.size() && continues(text[tail]))
    ++tail;
  return text.substr(0, head) + " [...] " + text.substr(tail);
}
} // namespace

std::string
printable(const std::string& text, std::size_t size)
{
  std::string shown;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t bytes = shownBytes(rest);
    shown += bytes > 0 ? std::string(rest.substr(0, bytes)) : escaped(rest[0]);
    rest.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return shown.size() > size ? shortened(shown, size) : shown;
}

std::string
printableLines(const std::string& text)
{
  std::string shown;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    shown += printable(text.substr(begin, end - begin));
    if (end < text.size())
      shown += '\n';
    begin = end + 1;
  }
  return shown;
}

} // namespace pcl6d::app
