// SPDX-License-Identifier: BSD-3-Clause
#include "scan/pcd/pcd_header.h"
#include "scan/point_field.h"
#include "scan/scan_encoder.h"

#include <algorithm>
#include <cstring>

namespace pcl6d::io {

namespace {

/** \brief Neighbouring bytes of a point. */
struct Span {
  std::size_t offset = 0;
  std::size_t size = 0;
};

/** \return the columns, joined where contiguous */
std::vector<Span>
spansOf(const std::vector<Column>& columns)
{
  std::vector<Span> spans;
  for (const auto& column : columns) {
    const std::size_t size = sizeOfType(column.datatype);
    if (!spans.empty() && spans.back().offset + spans.back().size == column.offset)
      spans.back().size += size;
    else
      spans.push_back({column.offset, size});
  }
  return spans;
}

} // namespace

void
ScanEncoder::finish(std::string&)
{}

std::vector<std::string>
lossesOfShape(const ScanShape& shape)
{
  std::vector<std::string> losses;
  if (shape.height > 1)
    losses.push_back("dropped the order in " + text::counted(shape.height, "row") +
                     " of " + text::counted(shape.width, "point"));
  if (!(shape.T_world_scan.matrix() == Eigen::Matrix4d::Identity()))
    losses.emplace_back("dropped the pose");
  return losses;
}

const pcl::PCLPointField*
findField(const std::vector<pcl::PCLPointField>& fields, const std::string& name)
{
  const auto found = std::find_if(
      fields.begin(), fields.end(), [&](const auto& f) { return f.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

void
appendText(const pcl::PCLPointCloud2& block,
           std::size_t begin,
           std::size_t end,
           const std::vector<Column>& columns,
           std::string& content)
{
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint8_t* const point = &block.data[i * block.point_step];
    for (const auto& column : columns)
      withTypeOf(column.datatype, [&](auto value) {
        std::memcpy(&value, point + column.offset, sizeof value);
        text::appendNumber(content, value);
        content += ' ';
      });
    content.back() = '\n';
  }
}

void
appendBytes(const pcl::PCLPointCloud2& block,
            std::size_t begin,
            std::size_t end,
            const std::vector<Column>& columns,
            std::string& content)
{
  const std::vector<Span> spans = spansOf(columns);
  std::size_t row = 0; // [byte]
  for (const auto& span : spans)
    row += span.size;
  const std::size_t start = content.size();
  content.resize(start + (end - begin) * row);
  auto* target = reinterpret_cast<std::uint8_t*>(&content[start]);
  for (const auto& span : spans) {
    copyValues(block.data.data() + begin * block.point_step + span.offset,
               block.point_step,
               target,
               row,
               span.size,
               end - begin);
    target += span.size;
  }
}

} // namespace pcl6d::io
