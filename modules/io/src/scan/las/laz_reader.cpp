// SPDX-License-Identifier: BSD-3-Clause
#include "scan/las/laz_reader.h"

namespace pcl6d::io {

namespace {
constexpr std::size_t kPlaceSize = 8;   // [byte] of where the table of chunks begins
constexpr std::uint32_t kAnySize = ~0U; // of chunks: each stores a point count
// A measured point takes several bytes, because noise is not compressible; even constant points
// take at least 1/1300 byte. The limit keeps a small file from filling the memory.
constexpr std::uint64_t kMostPerByte = 64;
constexpr std::uint64_t kFreePoints = 1'000'000; // allowed in any file
} // namespace

LazReader::LazReader(const std::filesystem::path& path,
                     const LasHeader& header,
                     const std::vector<std::uint8_t>& data)
: path_(path)
, laz_(*header.laz)
, count_(header.count)
, first_(header.points_begin)
, data_(data.data())
, end_(data.data() + data.size())
, place_(data.data())
{
  if (count_ > kFreePoints && (count_ - kFreePoints) / kMostPerByte > data.size())
    fail("tells of " + text::counted(count_, "point") + " in " +
         text::counted(data.size(), "byte") + ": less than any scan takes");
  if (laz_.is_chunked && count_ > 0)
    readTable();
}

void
LazReader::fail(const std::string& message) const
{
  text::fail(path_, message);
}

/** \return the offset of the table in the data; 0: no table */
std::size_t
LazReader::placeOfTable() const
{
  const auto size = static_cast<std::size_t>(end_ - data_);
  if (size < kPlaceSize)
    fail("ends before its points");
  std::int64_t place = lasNumber<std::int64_t>(data_);
  if (place == -1 &&
      size >= 2 * kPlaceSize) { // written to a pipe: the position is at the end
    place = lasNumber<std::int64_t>(end_ - kPlaceSize);
    const auto least = static_cast<std::int64_t>(first_ + kPlaceSize);
    const auto most = static_cast<std::int64_t>(first_ + size - kPlaceSize);
    return place >= least && place < most &&
                   lasNumber<std::uint32_t>(data_ + (place - least) + kPlaceSize) == 0
               ? static_cast<std::size_t>(place) - first_
               : 0;
  }
  if (place == -1 || place == 0) // the writer was interrupted
    return 0;
  if (place < static_cast<std::int64_t>(first_ + kPlaceSize) ||
      place > static_cast<std::int64_t>(first_ + size - kPlaceSize))
    fail("the table of chunks begins at byte " + std::to_string(place) +
         ", but must lie behind the points from byte " +
         std::to_string(first_ + kPlaceSize) + ", and before the end at byte " +
         std::to_string(first_ + size));
  return static_cast<std::size_t>(place) - first_;
}

void
LazReader::readTable()
{
  const std::size_t place = placeOfTable();
  place_ += kPlaceSize;
  if (place > 0)
    readSizes(place);
  else if (laz_.chunk_size == kAnySize && !laz_.items.is_layered)
    fail("has chunks of varying size, but no table of chunks: the file was not written "
         "to the end");
}

void
LazReader::readSizes(std::size_t place)
{
  const std::uint32_t version = lasNumber<std::uint32_t>(data_ + place);
  const std::size_t count = lasNumber<std::uint32_t>(data_ + place + 4);
  const std::size_t available = place - kPlaceSize; // [byte] of the chunks
  if (version != 0)
    fail("the table of chunks has version " + std::to_string(version) +
         ", but must have 0");
  if (count > available / laz_.items.size())
    fail("its table tells of " + text::counted(count, "chunk") +
         ", but there are only " + text::counted(available, "byte") + " of them");
  LazDecoder decoder(data_ + place + kPlaceSize, end_);
  IntegerModel model(32, 2);
  std::int32_t points = 0, size = 0;
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (laz_.chunk_size == kAnySize)
      points = model.code(decoder, points, 0, 0);
    size = model.code(decoder, size, 1, 0);
    total += static_cast<std::uint32_t>(size);
    if (decoder.isBroken() || total > available)
      fail("the table of chunks points outside: chunk " + std::to_string(i) + " ends " +
           std::to_string(total) +
           " bytes behind the first chunk, the table begins after " +
           std::to_string(available));
    table_.emplace_back(laz_.chunk_size == kAnySize ? static_cast<std::uint32_t>(points)
                                                    : laz_.chunk_size,
                        static_cast<std::uint32_t>(size));
  }
  end_ = data_ + place;
}

void
LazReader::beginLayers()
{
  if (static_cast<std::size_t>(chunk_end_ - place_) < 4 + 4 * layers_.size())
    return decoder_.setBroken();
  left_ = lasNumber<std::uint32_t>(place_);
  const std::uint8_t* const sizes = place_ + 4;
  place_ = sizes + 4 * layers_.size();
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const std::size_t size = lasNumber<std::uint32_t>(sizes + 4 * i);
    if (size > static_cast<std::size_t>(chunk_end_ - place_))
      return decoder_.setBroken();
    layers_[i].is_there = size > 0;
    layers_[i].coder = size > 0 ? LazDecoder(place_, place_ + size) : LazDecoder();
    place_ += size;
  }
}

void
LazReader::beginChunk(std::uint8_t* record)
{
  const std::size_t size = laz_.items.size();
  left_ = laz_.is_chunked ? laz_.chunk_size : count_;
  chunk_end_ = end_;
  if (!table_.empty()) {
    if (num_chunks_ == table_.size())
      fail("the table of chunks tells of " + text::counted(num_points_, "point") +
           ", but its header of " + std::to_string(count_));
    left_ = table_[num_chunks_].first;
    chunk_end_ = place_ + table_[num_chunks_].second;
  }
  ++num_chunks_;
  decoder_ = LazDecoder();
  if (static_cast<std::size_t>(chunk_end_ - place_) < size)
    return decoder_.setBroken();
  std::memcpy(record, place_, size);
  place_ += size;
  if (laz_.items.is_layered) {
    layered_.emplace(laz_.items, record);
    layers_.assign(laz_.items.numLayers(), {});
    beginLayers();
  }
  else {
    pointwise_.emplace(laz_.items, record);
    decoder_ = LazDecoder(place_, chunk_end_);
  }
  if (left_ == 0)
    decoder_.setBroken();
  if (!table_.empty())
    place_ = chunk_end_;
}

void
LazReader::next(std::uint8_t* record)
{
  bool broken = false;
  if (left_ == 0) {
    if (pointwise_ && table_.empty())
      place_ = decoder_.place(); // the coder ends where the next chunk begins
    beginChunk(record);
  }
  else if (pointwise_)
    pointwise_->code(decoder_, record);
  else {
    layered_->code(layers_.data(), record);
    for (const auto& layer : layers_)
      broken = broken || layer.coder.isBroken();
  }
  if (broken || decoder_.isBroken())
    fail("the compressed points end, or make no sense, after " +
         text::counted(num_points_, "point") + " of " + std::to_string(count_));
  --left_;
  ++num_points_;
}

} // namespace pcl6d::io
