// SPDX-License-Identifier: BSD-3-Clause
#include "scan/ply/ply_header.h"

#include <pcl/PCLPointField.h>

#include <map>

namespace pcl6d::io {

namespace {

using pcl::PCLPointField;

const std::map<std::string, std::uint8_t, std::less<>> kDatatypes = {
    {"char", PCLPointField::INT8},
    {"int8", PCLPointField::INT8},
    {"uchar", PCLPointField::UINT8},
    {"uint8", PCLPointField::UINT8},
    {"short", PCLPointField::INT16},
    {"int16", PCLPointField::INT16},
    {"ushort", PCLPointField::UINT16},
    {"uint16", PCLPointField::UINT16},
    {"int", PCLPointField::INT32},
    {"int32", PCLPointField::INT32},
    {"uint", PCLPointField::UINT32},
    {"uint32", PCLPointField::UINT32},
    {"float", PCLPointField::FLOAT32},
    {"float32", PCLPointField::FLOAT32},
    {"double", PCLPointField::FLOAT64},
    {"float64", PCLPointField::FLOAT64}};

const std::map<std::string, PlyEncoding, std::less<>> kPlyEncodings = {
    {"ascii", PlyEncoding::kAscii},
    {"binary_little_endian", PlyEncoding::kLittleEndian},
    {"binary_big_endian", PlyEncoding::kBigEndian}};

/** Longer than any real name; usual names have a word or two. */
constexpr std::size_t kLongestName = 255;

/** \brief Takes a header line by line. */
class Parser {
public:
  explicit Parser(const std::filesystem::path& path) : path_(path) {}

  /** \return false after the last line of the header */
  bool
  take(const FileInput& lines)
  {
    line_ = lines.number();
    text::Tokens tokens(lines.line());
    const auto word = tokens.next();
    if (line_ == 1 && word != "ply")
      fail("expected 'ply', got " + text::quoted(word));
    if (word == "format")
      takeFormat(tokens);
    else if (word == "element")
      takeElement(tokens);
    else if (word == "property")
      takeProperty(tokens);
    else if (!word.empty() && word != "ply" && word != "comment" &&
             word != "obj_info" && word != "end_header")
      fail(text::quoted(word) + " is not an entry of a PLY header");
    return word != "end_header";
  }

  PlyHeader
  finish()
  {
    if (!has_format_)
      text::fail(path_, "the header has no format");
    return std::move(header_);
  }

private:
  [[noreturn]] void
  fail(const std::string& message) const
  {
    text::failAt(path_, line_, message);
  }

  void
  takeFormat(text::Tokens& tokens)
  {
    const auto name = tokens.next();
    const auto encoding = kPlyEncodings.find(name);
    if (encoding == kPlyEncodings.end())
      fail("format " + text::quoted(name) + " is not known");
    const auto version = tokens.next();
    if (version != "1.0")
      fail("version " + text::quoted(version) + " is not known, must be 1.0");
    header_.encoding = encoding->second;
    has_format_ = true;
  }

  void
  takeElement(text::Tokens& tokens)
  {
    PlyElement element;
    element.name = name(tokens.next());
    const auto count = tokens.next();
    if (!text::parseNumber(count, element.count))
      fail(text::quoted(count) + " is not a number of elements");
    for (const auto& other : header_.elements)
      if (other.name == element.name)
        fail("a second element " + text::quoted(element.name));
    header_.elements.push_back(element);
  }

  void
  takeProperty(text::Tokens& tokens)
  {
    if (header_.elements.empty())
      fail("a property ahead of the first element");
    PlyProperty property;
    auto type = tokens.next();
    property.is_list = type == "list";
    if (property.is_list) {
      property.length_datatype = datatype(tokens.next());
      if (property.length_datatype == PCLPointField::FLOAT32 ||
          property.length_datatype == PCLPointField::FLOAT64)
        fail("the length of a list must have an integer type");
      type = tokens.next();
    }
    property.datatype = datatype(type);
    property.name = name(tokens.next());
    if (property.name.empty())
      fail("a property without a name");
    header_.elements.back().properties.push_back(property);
  }

  /** Names appear in messages and become names of fields. */
  std::string
  name(std::string_view token) const
  {
    if (token.size() > kLongestName)
      fail(text::quoted(token) + " is a name of " + std::to_string(token.size()) +
           " characters, must be at most " + std::to_string(kLongestName));
    return std::string(token);
  }

  std::uint8_t
  datatype(std::string_view name) const
  {
    const auto known = kDatatypes.find(name);
    if (known == kDatatypes.end())
      fail("type " + text::quoted(name) + " is not known");
    return known->second;
  }

  const std::filesystem::path& path_;
  PlyHeader header_;
  std::size_t line_ = 0;
  bool has_format_ = false;
};

} // namespace

PlyHeader
readPlyHeader(FileInput& input)
{
  Parser parser(input.path());
  while (input.next())
    if (!parser.take(input))
      return parser.finish();
  text::fail(input.path(), "the header ends without end_header");
}

} // namespace pcl6d::io
