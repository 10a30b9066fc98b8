// SPDX-License-Identifier: BSD-3-Clause
#include "scan/ply/ply_body.h"
#include "scan/point_field.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace pcl6d::io {

namespace {

std::size_t
sizeOf(std::uint8_t datatype)
{
  return withTypeOf(datatype, [](auto value) { return sizeof value; });
}

/** \brief A line per element, or per property, decided from the first element. */
class TextBody : public PlyBody {
public:
  explicit TextBody(FileInput& input) : PlyBody(input), tokens_({}) {}

  void
  finish() override
  {
    endRow();
    while (input_.next())
      if (!text::isBlank(input_.line()))
        fail("more elements than the header declares");
  }

private:
  [[noreturn]] void
  fail(const std::string& message) const
  {
    text::failAt(input_.path(), input_.number(), message);
  }

  void
  endRow()
  {
    const auto token = tokens_.next();
    if (!token.empty())
      fail(text::quoted(token) + " is more than the element's properties");
  }

  void
  nextRow() override
  {
    endRow();
    do {
      if (!input_.next())
        text::fail(input_.path(), "the file ends ahead of " + place());
    } while (text::isBlank(input_.line()));
    tokens_ = text::Tokens(input_.line());
    if (isFirstOfSeveral()) {
      text::Tokens first = tokens_;
      first.next();
      line_per_property_ = first.next().empty();
    }
  }

  /** \return the next number, from the next line if each property has a separate line */
  std::string_view
  nextToken()
  {
    auto token = tokens_.next();
    while (token.empty() && line_per_property_ && input_.next()) {
      tokens_ = text::Tokens(input_.line());
      token = tokens_.next();
    }
    return token;
  }

  bool
  takeRow(std::uint8_t* target) override
  {
    if (!io::takeRow(input_.line(), columns_, target))
      return false;
    tokens_ = text::Tokens({});
    return true;
  }

  void
  read(std::uint8_t datatype, const PlyProperty& property, std::uint8_t* value) override
  {
    const auto token = nextToken();
    if (token.empty())
      fail(place() + " has no " + property.name);
    withTypeOf(datatype, [&](auto number) {
      if (!text::parseNumber(token, number))
        fail(text::quoted(token) + " is not a number that property " +
             text::quoted(property.name) + " can hold");
      std::memcpy(value, &number, sizeof number);
    });
  }

  void
  skip(const PlyProperty& property, std::size_t count) override
  {
    std::uint8_t ignored[sizeof(double)];
    for (std::size_t i = 0; i < count; ++i)
      read(property.datatype, property, ignored);
  }

  text::Tokens tokens_;
  bool line_per_property_ = false;
};

class BinaryBody : public PlyBody {
public:
  BinaryBody(FileInput& input, bool big_endian)
  : PlyBody(input), big_endian_(big_endian)
  {}

  void
  finish() override
  {} // some writers end the file with an empty line

private:
  void
  nextRow() override
  {}

  bool
  takeRow(std::uint8_t* target) override
  {
    std::size_t size = 0;
    for (const auto& column : columns_)
      size += sizeOf(column.datatype);
    if (in_order_ && !big_endian_) {
      take(target, size);
      return true;
    }
    row_.resize(size);
    take(row_.data(), size);
    const std::uint8_t* value = row_.data();
    for (const auto& column : columns_)
      value = put(value, sizeOf(column.datatype), target + column.offset);
    return true;
  }

  void
  read(std::uint8_t datatype, const PlyProperty&, std::uint8_t* value) override
  {
    std::uint8_t bytes[sizeof(double)];
    take(bytes, sizeOf(datatype));
    put(bytes, sizeOf(datatype), value);
  }

  void
  skip(const PlyProperty& property, std::size_t count) override
  {
    std::uint8_t ignored[sizeof(double)];
    for (std::size_t i = 0; i < count; ++i)
      take(ignored, sizeOf(property.datatype));
  }

  void
  take(std::uint8_t* target, std::size_t size)
  {
    if (input_.read(target, size) < size)
      text::fail(input_.path(), "the file ends inside " + place());
  }

  /** \return the address after the value. The machine is little-endian, a requirement of PCL's
   * PCD files too. */
  const std::uint8_t*
  put(const std::uint8_t* value, std::size_t size, std::uint8_t* target) const
  {
    if (big_endian_)
      std::reverse_copy(value, value + size, target);
    else
      std::memcpy(target, value, size);
    return value + size;
  }

  bool big_endian_;
  std::vector<std::uint8_t> row_;
};

} // namespace

void
PlyBody::start(const PlyElement& element,
               const std::vector<std::size_t>& offsets,
               std::optional<std::size_t> kept)
{
  element_ = &element;
  kept_ = kept;
  offsets_ = offsets;
  count_ = 0;
  has_list_ = false;
  columns_.clear();
  in_order_ = true;
  std::size_t end = 0; // of the preceding columns
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    has_list_ |= element.properties[i].is_list;
    columns_.push_back({element.properties[i].datatype, offsets[i]});
    in_order_ &= offsets[i] == end;
    end += sizeOf(element.properties[i].datatype);
  }
}

void
PlyBody::next(std::uint8_t* target)
{
  ++count_;
  nextRow();
  if (!has_list_ && takeRow(target))
    return;
  for (std::size_t i = 0; i < offsets_.size(); ++i) {
    const auto& property = element_->properties[i];
    property.is_list ? readList(i)
                     : read(property.datatype, property, target + offsets_[i]);
  }
}

std::int64_t
PlyBody::readWhole(std::uint8_t datatype, const PlyProperty& property)
{
  std::uint8_t bytes[sizeof(double)];
  read(datatype, property, bytes);
  return withTypeOf(datatype, [&](auto number) -> std::int64_t {
    if constexpr (std::is_floating_point_v<decltype(number)>)
      text::fail(input_.path(),
                 "list " + text::quoted(property.name) + " has no integer type");
    else {
      std::memcpy(&number, bytes, sizeof number);
      return static_cast<std::int64_t>(number);
    }
  });
}

/** A list is read number by number: the declared length is not trusted beyond the end of the
 * file. */
void
PlyBody::readList(std::size_t i)
{
  const PlyProperty& property = element_->properties[i];
  const std::int64_t length = readWhole(property.length_datatype, property);
  if (length < 0)
    text::fail(input_.path(),
               place() + ": list " + text::quoted(property.name) + " has length " +
                   std::to_string(length));
  if (i != kept_)
    return skip(property, static_cast<std::size_t>(length));
  list_.clear();
  for (std::int64_t k = 0; k < length; ++k)
    list_.push_back(readWhole(property.datatype, property));
}

void
PlyBody::skipAll(const PlyElement& element)
{
  std::uint8_t ignored[sizeof(double)];
  start(element, std::vector<std::size_t>(element.properties.size(), 0));
  for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i)
    next(ignored);
}

std::string
PlyBody::place() const
{
  return element_->name + ' ' + std::to_string(count_) + " of " +
         std::to_string(element_->count);
}

std::unique_ptr<PlyBody>
openPlyBody(FileInput& input, const PlyHeader& header)
{
  if (header.encoding == PlyEncoding::kAscii)
    return std::make_unique<TextBody>(input);
  return std::make_unique<BinaryBody>(input,
                                      header.encoding == PlyEncoding::kBigEndian);
}

} // namespace pcl6d::io
