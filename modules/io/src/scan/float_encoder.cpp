// SPDX-License-Identifier: BSD-3-Clause
#include "scan/pcd/pcd_header.h"
#include "scan/point_field.h"
#include "scan/scan_encoder.h"
#include "text/centimetres.h"

#include <pcl6d/common/error.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace pcl6d::io {

namespace {

using pcl::PCLPointField;

/** \return the field of a coordinate */
const PCLPointField&
coordinateOf(const ScanShape& shape, const std::string& name)
{
  const PCLPointField* const field = findField(shape.fields, name);
  if (!field || (field->datatype != PCLPointField::FLOAT32 &&
                 field->datatype != PCLPointField::FLOAT64))
    throw BadArgument("the cloud has no field '" + name + "' of floating point");
  return *field;
}

/** \return whether a float has room for every value of the datatype */
bool
fitsFloat(std::uint8_t datatype)
{
  return datatype == PCLPointField::FLOAT32 || sizeOfType(datatype) <= 2;
}

/** \return the value of a point in float, 0 without a field */
float
floatAt(const std::uint8_t* point, const PCLPointField* field)
{
  if (!field)
    return 0;
  return withTypeOf(field->datatype, [&](auto value) {
    std::memcpy(&value, point + field->offset, sizeof value);
    return static_cast<float>(value);
  });
}

/** \brief x y z, optionally with intensity: selection of the fields, and losses. */
class FloatEncoder : public ScanEncoder {
public:
  FloatEncoder(const ScanShape& shape, bool with_intensity)
  : with_intensity_(with_intensity)
  {
    for (std::size_t i = 0; i < fields_.size(); ++i)
      fields_[i] = coordinateOf(shape, std::string(1, "xyz"[i]));
    if (with_intensity)
      chooseIntensity(shape);
    for (const auto& field : shape.fields)
      if (!isPadding(field) && field.name != intensity_.name &&
          !findField({fields_.begin(), fields_.end()}, field.name))
        losses_.push_back("dropped field '" + field.name + "'");
    for (auto& loss : lossesOfShape(shape))
      losses_.push_back(std::move(loss));
  }

protected:
  const PCLPointField*
  intensity() const
  {
    return intensity_.name.empty() ? nullptr : &intensity_;
  }

  std::array<PCLPointField, 3> fields_; ///< x, y, z
  bool with_intensity_;

private:
  void
  chooseIntensity(const ScanShape& shape)
  {
    for (const char* const name : {"intensity", "reflectance", "reflectivity"})
      if (const PCLPointField* const field = findField(shape.fields, name)) {
        intensity_ = *field;
        if (!fitsFloat(field->datatype))
          losses_.push_back("rounded field '" + field->name + "' to float32");
        return;
      }
    losses_.emplace_back("wrote 0 for the missing field 'intensity'");
  }

  PCLPointField intensity_; ///< without a name if missing
};

/** \brief float32 x y z intensity. */
class KittiEncoder : public FloatEncoder {
public:
  explicit KittiEncoder(const ScanShape& shape) : FloatEncoder(shape, true)
  {
    for (const auto& field : fields_)
      if (!fitsFloat(field.datatype))
        losses_.push_back("rounded field '" + field.name + "' to float32");
    columns_ = columnsOf({fields_.begin(), fields_.end()});
    if (intensity())
      columns_.push_back({intensity()->datatype, intensity()->offset});
    else
      columns_.clear();
    const auto is_float = [](const auto& c) {
      return c.datatype == PCLPointField::FLOAT32;
    };
    if (!std::all_of(columns_.begin(), columns_.end(), is_float))
      columns_.clear();
  }

  void
  encode(const pcl::PCLPointCloud2& block,
         std::size_t begin,
         std::size_t end,
         std::string& content) override
  {
    if (!columns_.empty())
      return appendBytes(block, begin, end, columns_, content);
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint8_t* const point = &block.data[i * block.point_step];
      const float row[] = {floatAt(point, &fields_[0]),
                           floatAt(point, &fields_[1]),
                           floatAt(point, &fields_[2]),
                           floatAt(point, intensity())};
      content.append(reinterpret_cast<const char*>(row), sizeof row);
    }
  }

private:
  std::vector<Column> columns_; ///< if all four fields are float32 already
};

/** \brief x y z [m]. */
class XyzEncoder : public FloatEncoder {
public:
  explicit XyzEncoder(const ScanShape& shape)
  : FloatEncoder(shape, false), columns_(columnsOf({fields_.begin(), fields_.end()}))
  {}

  void
  encode(const pcl::PCLPointCloud2& block,
         std::size_t begin,
         std::size_t end,
         std::string& content) override
  {
    appendText(block, begin, end, columns_, content);
  }

private:
  std::vector<Column> columns_;
};

/** \brief 3DTK's frame: x right, y up, z forward [cm], then perhaps the intensity. */
class UosEncoder : public FloatEncoder {
public:
  using FloatEncoder::FloatEncoder;

  void
  encode(const pcl::PCLPointCloud2& block,
         std::size_t begin,
         std::size_t end,
         std::string& content) override
  {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint8_t* const point = &block.data[i * block.point_step];
      append(point, fields_[1], -1, content);
      append(point, fields_[2], 1, content);
      append(point, fields_[0], 1, content);
      if (with_intensity_) {
        text::appendNumber(content, floatAt(point, intensity()));
        content += ' ';
      }
      content.back() = '\n';
    }
  }

private:
  /** Appends the coordinate in centimetres and a blank. */
  static void
  append(const std::uint8_t* point,
         const PCLPointField& field,
         int sign,
         std::string& content)
  {
    if (field.datatype == PCLPointField::FLOAT32) {
      float value = 0;
      std::memcpy(&value, point + field.offset, sizeof value);
      appendCentimetres(content, static_cast<float>(sign) * value);
    }
    else {
      double value = 0;
      std::memcpy(&value, point + field.offset, sizeof value);
      appendCentimetres(content, sign * value);
    }
    content += ' ';
  }
};

} // namespace

std::unique_ptr<ScanEncoder>
makeFloatEncoder(const ScanShape& shape, ScanFormat format)
{
  if (format == ScanFormat::kKitti)
    return std::make_unique<KittiEncoder>(shape);
  if (format == ScanFormat::kXyz)
    return std::make_unique<XyzEncoder>(shape);
  return std::make_unique<UosEncoder>(shape, format == ScanFormat::kUosr);
}

} // namespace pcl6d::io
