// SPDX-License-Identifier: BSD-3-Clause
#include "ply_body.h"
#include "point_field.h"

#include <algorithm>
#include <cstring>

namespace pcl6d {

namespace {

std::size_t
sizeOf(std::uint8_t datatype)
{
  return withTypeOf(datatype, [](auto value) { return sizeof value; });
}

/** \brief One line per element. */
class TextBody : public PlyBody {
public:
  TextBody(const std::filesystem::path& path, std::string_view body, std::size_t line)
  : PlyBody(path), lines_(body, line), tokens_({})
  {}

  void
  read(std::uint8_t datatype, const PlyProperty& property, std::uint8_t* value) override
  {
    const auto token = tokens_.next();
    if (token.empty())
      text::failAt(path_, lines_.number(), place() + " has no " + property.name);
    withTypeOf(datatype, [&](auto number) {
      if (!text::parseNumber(token, number))
        text::failAt(path_,
                     lines_.number(),
                     text::quoted(token) + " is not a number that property " +
                         text::quoted(property.name) + " can hold");
      std::memcpy(value, &number, sizeof number);
    });
  }

  void
  finish() override
  {
    endRow();
    while (lines_.next())
      if (!text::isBlank(lines_.line()))
        text::failAt(path_, lines_.number(), "more elements than the header declares");
  }

private:
  void
  endRow()
  {
    const auto token = tokens_.next();
    if (!token.empty())
      text::failAt(path_,
                   lines_.number(),
                   text::quoted(token) + " is more than the element's properties");
  }

  void
  nextRow() override
  {
    endRow();
    do {
      if (!lines_.next())
        text::fail(path_, "the file ends ahead of " + place());
    } while (text::isBlank(lines_.line()));
    tokens_ = text::Tokens(lines_.line());
  }

  void
  skip(const PlyProperty& property, std::size_t count) override
  {
    std::uint8_t ignored[sizeof(double)];
    for (std::size_t i = 0; i < count; ++i)
      read(property.datatype, property, ignored);
  }

  text::Lines lines_;
  text::Tokens tokens_;
};

class BinaryBody : public PlyBody {
public:
  BinaryBody(const std::filesystem::path& path, std::string_view body, bool big_endian)
  : PlyBody(path), rest_(body), big_endian_(big_endian)
  {}

  void
  read(std::uint8_t datatype, const PlyProperty&, std::uint8_t* value) override
  {
    const std::size_t size = sizeOf(datatype);
    const std::string_view bytes = take(size);
    std::copy(bytes.begin(), bytes.end(), value);
    if (big_endian_) // the machine is little-endian, as PCL's PCD files are
      std::reverse(value, value + size);
  }

  void
  finish() override
  {} // some writers end the file with a line end

private:
  std::string_view
  take(std::size_t size)
  {
    if (size > rest_.size())
      text::fail(path_, "the file ends inside " + place());
    const std::string_view bytes = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return bytes;
  }

  void
  nextRow() override
  {}

  void
  skip(const PlyProperty& property, std::size_t count) override
  {
    const std::size_t size = sizeOf(property.datatype);
    take(count > rest_.size() ? count : count * size); // without overflow
  }

  std::string_view rest_;
  bool big_endian_;
};

} // namespace

void
PlyBody::next(const PlyElement& element, std::size_t index)
{
  element_ = &element;
  index_ = index;
  nextRow();
}

void
PlyBody::skipList(const PlyProperty& property)
{
  std::uint8_t bytes[sizeof(double)];
  read(property.length_datatype, property, bytes);
  const auto length = withTypeOf(property.length_datatype, [&](auto number) {
    std::memcpy(&number, bytes, sizeof number);
    return static_cast<std::int64_t>(number);
  });
  if (length < 0)
    text::fail(path_,
               place() + ": list " + text::quoted(property.name) + " has length " +
                   std::to_string(length));
  skip(property, static_cast<std::size_t>(length));
}

std::string
PlyBody::place() const
{
  return element_->name + ' ' + std::to_string(index_ + 1) + " of " +
         std::to_string(element_->count);
}

std::unique_ptr<PlyBody>
openPlyBody(const std::filesystem::path& path,
            const PlyHeader& header,
            std::string_view content)
{
  content.remove_prefix(header.size);
  if (header.encoding == PlyEncoding::kAscii)
    return std::make_unique<TextBody>(path, content, header.num_lines + 1);
  return std::make_unique<BinaryBody>(
      path, content, header.encoding == PlyEncoding::kBigEndian);
}

} // namespace pcl6d
