// SPDX-License-Identifier: BSD-3-Clause
#include "scan/pcd/pcd_header.h"
#include "scan/point_field.h"
#include "scan/scan_encoder.h"

#include <pcl6d/common/error.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl6d::io {

namespace {
using pcl::PCLPointField;

/** \brief A scan with its pose as PTX; non-finite points become missing returns. */
class PtxEncoder : public ScanEncoder {
public:
  explicit PtxEncoder(const ScanShape& shape) : shape_(shape)
  {
    for (std::size_t i = 0; i < coordinates_.size(); ++i) {
      coordinates_[i] = findField(shape_.fields, std::string(1, "xyz"[i]));
      if (!coordinates_[i] || (coordinates_[i]->datatype != PCLPointField::FLOAT32 &&
                               coordinates_[i]->datatype != PCLPointField::FLOAT64))
        throw BadArgument("the cloud has no field '" + std::string(1, "xyz"[i]) +
                          "' of floating point");
    }
    for (const char* const name : {"intensity", "reflectance", "reflectivity"})
      intensity_ = intensity_ ? intensity_ : findField(shape_.fields, name);
    rgb_ = findField(shape_.fields, "rgb");
    if (rgb_ && sizeOfType(rgb_->datatype) != sizeof(std::uint32_t))
      rgb_ = nullptr;
    if (!intensity_)
      losses_.emplace_back("wrote 0.5 for the missing field 'intensity'");
    for (const auto& field : shape_.fields)
      if (!isPadding(field) && &field != intensity_ && &field != rgb_ &&
          field.name != "x" && field.name != "y" && field.name != "z")
        losses_.push_back("dropped field '" + field.name + "'");
  }

  std::string
  header() const override
  {
    // An unorganized cloud becomes a row with a column for each point.
    const bool is_grid = shape_.height > 1;
    std::string text = std::to_string(is_grid ? shape_.height : shape_.width) + '\n' +
                       std::to_string(is_grid ? shape_.width : 1) + '\n';
    const Eigen::Matrix4d transposed = shape_.T_world_scan.matrix().transpose();
    appendRow(transposed.row(3).head<3>(), text);
    for (Eigen::Index i = 0; i < 3; ++i)
      appendRow(transposed.row(i).head<3>(), text);
    for (Eigen::Index i = 0; i < 4; ++i)
      appendRow(transposed.row(i), text);
    return text;
  }

  void
  encode(const pcl::PCLPointCloud2& block,
         std::size_t begin,
         std::size_t end,
         std::string& content) override
  {
    for (std::size_t i = begin; i < end; ++i)
      append(&block.data[i * block.point_step], content);
  }

private:
  template <typename Row>
  static void
  appendRow(const Row& row, std::string& text)
  {
    for (Eigen::Index i = 0; i < row.size(); ++i) {
      text::appendNumber(text, row(i) + 0.0); // no -0
      text += i + 1 < row.size() ? ' ' : '\n';
    }
  }

  static double
  valueAt(const std::uint8_t* point, const PCLPointField& field)
  {
    return withTypeOf(field.datatype, [&](auto value) {
      std::memcpy(&value, point + field.offset, sizeof value);
      return static_cast<double>(value);
    });
  }

  static void
  appendValue(const std::uint8_t* point, const PCLPointField& field, std::string& text)
  {
    withTypeOf(field.datatype, [&](auto value) {
      std::memcpy(&value, point + field.offset, sizeof value);
      text::appendNumber(text, value);
    });
    text += ' ';
  }

  void
  append(const std::uint8_t* point, std::string& text) const
  {
    bool is_finite = true;
    for (const auto* const field : coordinates_)
      is_finite = is_finite && std::isfinite(valueAt(point, *field));
    if (is_finite)
      for (const auto* const field : coordinates_)
        appendValue(point, *field, text);
    else
      text += "0 0 0 ";
    if (intensity_ && std::isfinite(valueAt(point, *intensity_)))
      appendValue(point, *intensity_, text);
    else
      text += "0.5 ";
    if (rgb_) {
      std::uint32_t rgb = 0;
      std::memcpy(&rgb, point + rgb_->offset, sizeof rgb);
      for (const int shift : {16, 8, 0}) {
        text::appendNumber(text, rgb >> shift & 0xff);
        text += ' ';
      }
    }
    text.back() = '\n';
  }

  ScanShape shape_;
  std::array<const PCLPointField*, 3> coordinates_{}; ///< x, y, z in the shape
  const PCLPointField* intensity_ = nullptr;
  const PCLPointField* rgb_ = nullptr;
};
} // namespace

std::unique_ptr<ScanEncoder>
makePtxEncoder(const ScanShape& shape)
{
  return std::make_unique<PtxEncoder>(shape);
}

} // namespace pcl6d::io
