// SPDX-License-Identifier: BSD-3-Clause
#include "bag/files/decompression.h"

#include <algorithm>
#include <bzlib.h>
#include <limits>
#include <lz4frame.h>
#include <memory>
#include <optional>
#include <zstd.h>

namespace pcl6d::sources {

namespace {
/** Allocation step: a claimed size is trusted only as far as content arrives. */
constexpr std::size_t kStep = std::size_t{4} << 20; // [byte]

/** The recorders of ROS and MCAP close a chunk at 0.8 to 8 MB; a chunk is larger only for a
 * single large message. Clouds compress to a tenth at best, so larger contents are limited by
 * ratio: a small file cannot fill the memory. */
constexpr std::uint64_t kAnyContent = std::uint64_t{128} << 20; // [byte]
constexpr std::uint64_t kLargestRatio = 100;

std::uint64_t
largestContent(std::uint64_t stored)
{
  return std::max(kAnyContent, kLargestRatio * stored);
}

/** \brief Content that grows during decompression. */
class Content {
public:
  explicit Content(std::uint64_t limit) : limit_(limit) {}

  /** \return room for more; empty if the limit is reached */
  std::size_t
  room()
  {
    if (used_ == bytes_.size())
      bytes_.resize(static_cast<std::size_t>(
          std::min<std::uint64_t>(limit_, used_ + std::max(kStep, used_))));
    return bytes_.size() - used_;
  }
  std::uint8_t*
  end()
  {
    return bytes_.data() + used_;
  }
  void
  add(std::size_t count)
  {
    used_ += count;
  }
  std::size_t
  size() const
  {
    return used_;
  }
  std::vector<std::uint8_t>
  finish()
  {
    bytes_.resize(used_);
    return std::move(bytes_);
  }

private:
  std::uint64_t limit_;
  std::size_t used_ = 0;
  std::vector<std::uint8_t> bytes_;
};

/** \return whether the bytes are whole and their content is within the limit */
bool
undoLz4(Bytes bytes, Content& content)
{
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0)
    return false;
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      made, LZ4F_freeDecompressionContext);
  std::size_t more = 1; // 0: the frame has ended
  while (more != 0) {
    std::uint8_t nothing = 0; // for the bytes behind the content
    std::size_t room = content.room(), taken = bytes.size;
    const std::size_t had_room = room;
    more = LZ4F_decompress(context.get(),
                           had_room > 0 ? content.end() : &nothing,
                           &room,
                           bytes.data,
                           &taken,
                           nullptr);
    if (LZ4F_isError(more) != 0 || (room == 0 && taken == 0 && more != 0))
      return false;
    content.add(room);
    bytes.data += taken;
    bytes.size -= taken;
  }
  return true;
}

bool
undoBz2(Bytes bytes, Content& content)
{
  bz_stream stream{};
  if (bytes.size > std::numeric_limits<unsigned>::max() ||
      BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK)
    return false;
  const std::unique_ptr<bz_stream, decltype(&BZ2_bzDecompressEnd)> closing(
      &stream, BZ2_bzDecompressEnd);
  stream.next_in = reinterpret_cast<char*>(const_cast<std::uint8_t*>(bytes.data));
  stream.avail_in = static_cast<unsigned>(bytes.size);
  for (;;) {
    char nothing = 0;
    const std::size_t room = content.room();
    stream.next_out = room > 0 ? reinterpret_cast<char*>(content.end()) : &nothing;
    stream.avail_out = static_cast<unsigned>(room);
    const unsigned before = stream.avail_in;
    const int result = BZ2_bzDecompress(&stream);
    const std::size_t made = room - stream.avail_out;
    content.add(made);
    if (result == BZ_STREAM_END)
      return true;
    if (result != BZ_OK || (made == 0 && stream.avail_in == before))
      return false;
  }
}

bool
undoZstd(Bytes bytes, Content& content)
{
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(
      ZSTD_createDStream(), ZSTD_freeDStream);
  if (!stream)
    return false;
  ZSTD_inBuffer in = {bytes.data, bytes.size, 0};
  std::size_t more = 1;
  while (more != 0 || in.pos < in.size) {
    std::uint8_t nothing = 0;
    const std::size_t room = content.room(), before = in.pos;
    ZSTD_outBuffer out = {room > 0 ? content.end() : &nothing, room, 0};
    more = ZSTD_decompressStream(stream.get(), &out, &in);
    if (ZSTD_isError(more) != 0 || (out.pos == 0 && in.pos == before && more != 0))
      return false;
    content.add(out.pos);
  }
  return true;
}
} // namespace

std::vector<std::uint8_t>
decompressed(const std::filesystem::path& path,
             const std::string& what,
             const std::string& compression,
             std::vector<std::uint8_t> stored,
             std::uint64_t size)
{
  const Bytes bytes = {stored.data(), stored.size()};
  if (compression.empty() || compression == "none") {
    if (bytes.size != size)
      text::fail(path,
                 what + " has " + std::to_string(bytes.size) + " bytes, but says " +
                     std::to_string(size));
    return stored;
  }
  if (size > largestContent(bytes.size))
    text::fail(path,
               what + ": content of " + std::to_string(size) + " bytes in " +
                   std::to_string(bytes.size) + ", more than chunks of clouds hold");
  Content content(size);
  bool is_whole = false;
  if (compression == "lz4")
    is_whole = undoLz4(bytes, content);
  else if (compression == "bz2")
    is_whole = undoBz2(bytes, content);
  else if (compression == "zstd")
    is_whole = undoZstd(bytes, content);
  else
    text::fail(path,
               what + ": unknown compression " + text::quoted(compression) +
                   ", but must be none, lz4, bz2 or zstd: record the bag with a known "
                   "compression");
  if (!is_whole || content.size() != size)
    text::fail(path,
               what + ": its " + compression + " content is damaged (" +
                   std::to_string(content.size()) + " of " + std::to_string(size) +
                   " bytes could be read)");
  return content.finish();
}

std::vector<std::uint8_t>
decompressedZstd(const std::filesystem::path& path,
                 const std::string& what,
                 Bytes bytes)
{
  Content content(largestContent(bytes.size));
  if (!undoZstd(bytes, content))
    text::fail(path, what + ": the zstd content is damaged");
  return content.finish();
}

} // namespace pcl6d::sources
