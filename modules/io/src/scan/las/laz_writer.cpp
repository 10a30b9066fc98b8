// SPDX-License-Identifier: BSD-3-Clause
#include "scan/las/laz_writer.h"

#include <numeric>

namespace pcl6d::io {

namespace {
template <typename T>
void
appendLas(std::string& content, T value)
{
  content.append(reinterpret_cast<const char*>(&value), sizeof value);
}
} // namespace

LazWriter::LazWriter(const LazItems& items, std::uint32_t chunk_size)
: items_(items), chunk_size_(chunk_size), record_(items.size())
{}

void
LazWriter::add(const std::uint8_t* record, std::string& content)
{
  std::copy(record, record + record_.size(), record_.begin());
  if (num_points_ == 0) {
    first_.assign(reinterpret_cast<const char*>(record), record_.size());
    if (items_.is_layered) {
      layered_.emplace(items_, record);
      layers_.assign(items_.numLayers(), {});
      layers_[kLazXy].has_changed = true; // is always there
    }
    else
      pointwise_.emplace(items_, record);
  }
  else if (items_.is_layered)
    layered_->code(layers_.data(), record_.data());
  else
    pointwise_->code(encoder_, record_.data());
  if (++num_points_ == chunk_size_)
    endChunk(content);
}

void
LazWriter::endChunk(std::string& content)
{
  const std::size_t begin = content.size();
  content += first_;
  if (items_.is_layered)
    endLayers(content);
  else
    content += encoder_.finish();
  sizes_.push_back(static_cast<std::uint32_t>(content.size() - begin));
  num_points_ = 0;
}

void
LazWriter::endLayers(std::string& content)
{
  appendLas(content, num_points_);
  std::string layers;
  for (auto& layer : layers_) {
    const std::string bytes = layer.has_changed ? layer.coder.finish() : std::string();
    appendLas(content, static_cast<std::uint32_t>(bytes.size()));
    layers += bytes;
  }
  content += layers;
}

std::size_t
LazWriter::finish(std::string& content)
{
  if (num_points_ > 0)
    endChunk(content);
  appendLas(content, std::uint32_t{0}); // version
  appendLas(content, static_cast<std::uint32_t>(sizes_.size()));
  LazEncoder encoder;
  IntegerModel model(32, 2);
  std::uint32_t before = 0;
  for (const std::uint32_t size : sizes_) {
    model.code(
        encoder, static_cast<std::int32_t>(before), 1, static_cast<std::int32_t>(size));
    before = size;
  }
  content += encoder.finish();
  return std::accumulate(sizes_.begin(), sizes_.end(), std::size_t{0});
}

std::string
LazWriter::description() const
{
  struct Item {
    std::uint16_t type, size;
  };
  std::vector<Item> items;
  if (items_.is_layered)
    items.push_back({10, 30});
  else
    items.push_back({6, 20});
  if (items_.has_time)
    items.push_back({7, 8});
  if (items_.has_infrared)
    items.push_back({12, 8});
  else if (items_.has_colours)
    items.push_back({static_cast<std::uint16_t>(items_.is_layered ? 11 : 8), 6});
  if (items_.num_bytes > 0)
    items.push_back({static_cast<std::uint16_t>(items_.is_layered ? 14 : 0),
                     static_cast<std::uint16_t>(items_.num_bytes)});
  std::string text;
  appendLas<std::uint16_t>(text, items_.is_layered ? 3 : 2); // chunked
  appendLas<std::uint16_t>(text, 0);                         // arithmetic coder
  text += '\3'; // version 3.4.3 of LASzip, which knows all the parts
  text += '\4';
  appendLas<std::uint16_t>(text, 3);
  appendLas<std::uint32_t>(text, 0);
  appendLas(text, chunk_size_);
  appendLas<std::int64_t>(text, -1); // no special records
  appendLas<std::int64_t>(text, -1);
  appendLas(text, static_cast<std::uint16_t>(items.size()));
  for (const Item& item : items) {
    appendLas(text, item.type);
    appendLas(text, item.size);
    appendLas<std::uint16_t>(
        text, items_.is_layered ? (items_.has_right_channels ? 4 : 3) : 2);
  }
  return text;
}

} // namespace pcl6d::io
