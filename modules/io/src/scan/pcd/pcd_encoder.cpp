// SPDX-License-Identifier: BSD-3-Clause
#include "scan/pcd/pcd_header.h"
#include "scan/point_field.h"
#include "scan/scan_encoder.h"

#include <pcl/io/lzf.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace pcl6d::io {

namespace {

using pcl::PCLPointField;

/** \return the header of a file without gaps between the fields */
PcdHeader
headerFor(const ScanShape& shape, PcdEncoding encoding)
{
  PcdHeader header;
  header.width = shape.width;
  header.height = shape.height;
  header.viewpoint = shape.T_world_scan;
  header.encoding = encoding;
  for (auto field : shape.fields) {
    if (isPadding(field))
      continue;
    field.count = std::max<pcl::uindex_t>(field.count, 1); // 0 in old clouds
    // Packed colours: many are nan if written as float.
    if (encoding == PcdEncoding::kAscii && field.datatype == PCLPointField::FLOAT32 &&
        (field.name == "rgb" || field.name == "rgba"))
      field.datatype = PCLPointField::UINT32;
    header.point_size += field.count * sizeOfType(field.datatype);
    header.fields.push_back(field);
  }
  return header;
}

/** \brief Points in sequence, as text or in memory layout. */
class RowEncoder : public ScanEncoder {
public:
  RowEncoder(const ScanShape& shape, PcdEncoding encoding)
  : header_(headerFor(shape, encoding)), columns_(columnsOf(header_.fields))
  {}

  std::string
  header() const override
  {
    return toString(header_);
  }

  void
  encode(const pcl::PCLPointCloud2& block,
         std::size_t begin,
         std::size_t end,
         std::string& content) override
  {
    header_.encoding == PcdEncoding::kAscii
        ? appendText(block, begin, end, columns_, content)
        : appendBytes(block, begin, end, columns_, content);
  }

private:
  PcdHeader header_;
  std::vector<Column> columns_;
};

/** \brief Field by field, compressed by LZF; needs all points before writing. */
class CompressedEncoder : public ScanEncoder {
public:
  CompressedEncoder(const std::filesystem::path& path, const ScanShape& shape)
  : path_(path), header_(headerFor(shape, PcdEncoding::kBinaryCompressed))
  {
    // LZF expands incompressible data by one byte in 32.
    const std::size_t size = header_.numPoints() * header_.point_size;
    if (size + roomFor(size) > std::numeric_limits<std::uint32_t>::max())
      text::fail(path, "too many points for a compressed file; write a binary file");
    values_.resize(size);
  }

  std::string
  header() const override
  {
    return toString(header_);
  }

  void
  encode(const pcl::PCLPointCloud2& block,
         std::size_t begin,
         std::size_t end,
         std::string&) override
  {
    std::size_t start = 0; // of the field's values
    for (const auto& field : header_.fields) {
      const std::size_t size = field.count * sizeOfType(field.datatype);
      copyValues(block.data.data() + begin * block.point_step + field.offset,
                 block.point_step,
                 values_.data() + start + num_encoded_ * size,
                 size,
                 size,
                 end - begin);
      start += header_.numPoints() * size;
    }
    num_encoded_ += end - begin;
  }

  void
  finish(std::string& content) override
  {
    std::uint32_t sizes[2] = {0, static_cast<std::uint32_t>(values_.size())};
    const std::size_t start = content.size();
    const std::size_t room = values_.size() + roomFor(values_.size());
    content.resize(start + sizeof sizes + room);
    if (!values_.empty())
      sizes[0] = pcl::lzfCompress(values_.data(),
                                  sizes[1],
                                  &content[start + sizeof sizes],
                                  static_cast<std::uint32_t>(room));
    std::memcpy(&content[start], sizes, sizeof sizes);
    content.resize(start + sizeof sizes + sizes[0]);
  }

private:
  /** \return how much longer the values may become */
  static std::size_t
  roomFor(std::size_t size)
  {
    return size / 16 + 64;
  }

  std::filesystem::path path_;
  PcdHeader header_;
  std::vector<std::uint8_t> values_;
  std::size_t num_encoded_ = 0; ///< points
};

} // namespace

std::unique_ptr<ScanEncoder>
makePcdEncoder(const std::filesystem::path& path,
               const ScanShape& shape,
               PcdEncoding encoding)
{
  if (encoding == PcdEncoding::kBinaryCompressed)
    return std::make_unique<CompressedEncoder>(path, shape);
  return std::make_unique<RowEncoder>(shape, encoding);
}

} // namespace pcl6d::io
