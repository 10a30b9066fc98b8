// SPDX-License-Identifier: BSD-3-Clause
#include "scan/pcd/pcd_header.h"
#include "scan/scan_encoder.h"

#include <algorithm>
#include <array>

namespace pcl6d::io {

namespace {

using pcl::PCLPointField;

/** \return PLY's name of the datatype; null for 64-bit integers, unknown to PLY */
const char*
typeName(std::uint8_t datatype)
{
  switch (datatype) {
  case PCLPointField::INT8:
    return "char";
  case PCLPointField::UINT8:
    return "uchar";
  case PCLPointField::INT16:
    return "short";
  case PCLPointField::UINT16:
    return "ushort";
  case PCLPointField::INT32:
    return "int";
  case PCLPointField::UINT32:
    return "uint";
  case PCLPointField::FLOAT32:
    return "float";
  case PCLPointField::FLOAT64:
    return "double";
  default:
    return nullptr;
  }
}

/** \return the usual PLY name of a property that PCL names differently */
std::string
propertyName(const std::string& field)
{
  const bool normal = field == "normal_x" || field == "normal_y" || field == "normal_z";
  return normal ? std::string("n") + field.back() : field;
}

bool
isPackedColour(const PCLPointField& field)
{
  return (field.name == "rgb" || field.name == "rgba") && field.count <= 1 &&
         sizeOfType(field.datatype) == 4;
}

class PlyEncoder : public ScanEncoder {
public:
  PlyEncoder(const ScanShape& shape, bool ascii) : ascii_(ascii)
  {
    for (const auto& field : shape.fields)
      if (isPackedColour(field))
        addColour(field);
      else if (!isPadding(field))
        addField(field);
    header_ = std::string("ply\nformat ") + (ascii ? "ascii" : "binary_little_endian") +
              " 1.0\nelement vertex " + std::to_string(shape.width * shape.height) +
              '\n' + properties_ + "end_header\n";
    for (auto& loss : lossesOfShape(shape))
      losses_.push_back(std::move(loss));
  }

  std::string
  header() const override
  {
    return header_;
  }

  void
  encode(const pcl::PCLPointCloud2& block,
         std::size_t begin,
         std::size_t end,
         std::string& content) override
  {
    ascii_ ? appendText(block, begin, end, columns_, content)
           : appendBytes(block, begin, end, columns_, content);
  }

private:
  void
  addProperty(const std::string& name, std::uint8_t datatype, std::size_t offset)
  {
    properties_ += std::string("property ") + typeName(datatype) + ' ' + name + '\n';
    columns_.push_back({datatype, offset});
  }

  /** Packed colours are blue, green, red, alpha in memory. */
  void
  addColour(const PCLPointField& field)
  {
    const std::array<const char*, 4> names = {"blue", "green", "red", "alpha"};
    for (const std::size_t byte : {2, 1, 0})
      addProperty(names[byte], PCLPointField::UINT8, field.offset + byte);
    if (field.name == "rgba")
      addProperty(names[3], PCLPointField::UINT8, field.offset + 3);
  }

  void
  addField(const PCLPointField& field)
  {
    if (!typeName(field.datatype)) {
      losses_.push_back("dropped field '" + field.name + "', a 64-bit integer");
      return;
    }
    const std::size_t count = std::max<std::size_t>(field.count, 1);
    for (std::size_t i = 0; i < count; ++i)
      addProperty(propertyName(field.name) +
                      (count > 1 ? '_' + std::to_string(i) : std::string()),
                  field.datatype,
                  field.offset + i * sizeOfType(field.datatype));
    if (count > 1)
      losses_.push_back("split field '" + field.name + "' of " + std::to_string(count) +
                        " values into " + field.name + "_0, ...");
  }

  bool ascii_;
  std::string header_;
  std::string properties_;
  std::vector<Column> columns_;
};

} // namespace

std::unique_ptr<ScanEncoder>
makePlyEncoder(const ScanShape& shape, bool ascii)
{
  return std::make_unique<PlyEncoder>(shape, ascii);
}

} // namespace pcl6d::io
