// SPDX-License-Identifier: BSD-3-Clause
#include "convert/joined_layout.h"

#include <pcl6d/io/vector_field.h>

#include <pcl/common/io.h>

#include <algorithm>
#include <cstring>

namespace pcl6d::app {

namespace {
using pcl::PCLPointField;

constexpr const char* kIndex = "scan";

std::size_t
sizeOf(const PCLPointField& field)
{
  return std::size_t{field.count} *
         static_cast<std::size_t>(pcl::getFieldSize(field.datatype));
}

/** \return the field of equal name and type, or null */
const PCLPointField*
findSame(const std::vector<PCLPointField>& fields, const PCLPointField& wanted)
{
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& field) {
    return field.name == wanted.name && field.datatype == wanted.datatype &&
           field.count == wanted.count;
  });
  return found == fields.end() ? nullptr : &*found;
}
} // namespace

void
JoinedLayout::addScan(const std::vector<PCLPointField>& fields)
{
  if (first_)
    fields_ = fields;
  first_ = false;
  const auto remember = [&](const PCLPointField& field) {
    if (std::find(incomplete_.begin(), incomplete_.end(), field.name) ==
        incomplete_.end())
      incomplete_.push_back(field.name);
  };
  for (const auto& field : fields)
    if (!findSame(fields_, field))
      remember(field);
  const auto missing =
      std::stable_partition(fields_.begin(), fields_.end(), [&](const auto& f) {
        return findSame(fields, f);
      });
  std::for_each(missing, fields_.end(), remember);
  fields_.erase(missing, fields_.end());
}

void
JoinedLayout::finish()
{
  const auto old = std::remove_if(
      fields_.begin(), fields_.end(), [](const auto& f) { return f.name == kIndex; });
  replaces_index_ = old != fields_.end();
  fields_.erase(old, fields_.end());
  PCLPointField index;
  index.name = kIndex;
  index.datatype = PCLPointField::UINT32;
  index.count = 1;
  fields_.push_back(index);
  for (auto& field : fields_) {
    field.offset = static_cast<pcl::uindex_t>(point_step_);
    point_step_ += sizeOf(field);
  }
  index_offset_ = fields_.back().offset;
}

std::vector<std::string>
JoinedLayout::losses() const
{
  std::vector<std::string> losses;
  for (const auto& name : incomplete_)
    losses.push_back("dropped field '" + name + "', missing or different in a scan");
  if (replaces_index_)
    losses.push_back(std::string("replaced field '") + kIndex +
                     "' by the index of the scan");
  return losses;
}

/** Copies the fields of the kept points from begin on until the block is full. */
void
JoinedLayout::gather(const pcl::PCLPointCloud2& scan,
                     const std::vector<bool>& kept,
                     std::size_t begin,
                     pcl::PCLPointCloud2& block) const
{
  for (const auto& field : fields_) {
    const PCLPointField* const source = findSame(scan.fields, field);
    if (!source)
      continue; // the index
    std::uint8_t* target = block.data.data() + field.offset;
    const std::uint8_t* const end = block.data.data() + block.data.size();
    for (std::size_t i = begin; target < end; ++i)
      if (kept[i]) {
        std::memcpy(
            target, &scan.data[i * scan.point_step + source->offset], sizeOf(field));
        target += point_step_;
      }
  }
}

pcl::PCLPointCloud2
JoinedLayout::joined(const pcl::PCLPointCloud2& scan,
                     const std::vector<bool>& kept,
                     std::size_t begin,
                     std::size_t end,
                     const Eigen::Isometry3d& T_world_scan,
                     std::uint32_t index) const
{
  pcl::PCLPointCloud2 block;
  block.fields = fields_;
  block.height = 1;
  block.width = static_cast<pcl::uindex_t>(
      std::count(kept.begin() + static_cast<std::ptrdiff_t>(begin),
                 kept.begin() + static_cast<std::ptrdiff_t>(end),
                 true));
  block.point_step = static_cast<pcl::uindex_t>(point_step_);
  block.row_step = block.width * block.point_step;
  block.data.resize(std::size_t{block.width} * point_step_);
  gather(scan, kept, begin, block);
  const VectorField place(fields_, {"x", "y", "z"});
  const VectorField normal(fields_, {"normal_x", "normal_y", "normal_z"});
  for (std::size_t i = 0; i < block.width; ++i) {
    std::uint8_t* const point = &block.data[i * point_step_];
    place.write(T_world_scan * place.read(point), point);
    if (normal)
      normal.write(T_world_scan.linear() * normal.read(point), point);
    std::memcpy(point + index_offset_, &index, sizeof index);
  }
  return block;
}

} // namespace pcl6d::app
