// SPDX-License-Identifier: BSD-3-Clause
#include "las_samples.h"

#include <pcl6d/io/scan_reader.h>

#include <limits>

namespace fs = std::filesystem;
using namespace pcl6d;
using namespace pcl6d::test;

namespace {

/** Expects the message of a file with these bytes. */
void
expectRefused(const std::string& bytes, const std::string& message)
{
  const TempFolder folder;
  const fs::path file = folder / "a.las";
  writeText(file, bytes);
  expectIoFailed(file, message, [&] { readScan(file); });
}

/** \return the bytes with a number at a place */
template <typename T>
std::string
with(std::string bytes, std::size_t place, T value)
{
  put(bytes, place, value);
  return bytes;
}

} // namespace

TEST(LasErrors, HeadersThatMakeNoSenseAreRefused)
{
  const std::string good = lasBytes(lasSample(0, 10));
  expectRefused("", "is empty, but must begin with the header of a LAS file");
  expectRefused(good.substr(0, 100), "ends within the header, after 100 bytes");
  expectRefused(with(good, 0, 'l'), "is no LAS file: does not begin with LASF");
  expectRefused(with(good, 24, '\2'), "has LAS version 2.2, but must have 1.0 to 1.4");
  expectRefused(with(good, 94, std::uint16_t{200}),
                "has a header of 200 bytes, but must have 227 at least");
  expectRefused(with(good, 96, std::uint32_t{100}),
                "the points begin at byte 100, within its header of 227");
  expectRefused(with(good, 96, std::uint32_t{4'000'000'000}),
                "the points begin at byte 4000000000, but it ends at 427");
  expectRefused(with(good, 104, '\13'), "has point format 11, but must have 0 to 10");
  expectRefused(with(good, 105, std::uint16_t{19}),
                "has points of 19 bytes, but those of format 0 have 20 at least");
  expectRefused(with(good, 104, '\x80'),
                "the points are compressed, but the record 'laszip encoded' with the "
                "layout is missing");
}

TEST(LasErrors, ScalesAndOffsetsThatAreNoneAreRefused)
{
  const std::string good = lasBytes(lasSample(0, 10));
  const std::string rule = ", but must be neither 0 nor beyond 1e9";
  expectRefused(with(good, 131, 0.0), "scale of x = 0" + rule);
  expectRefused(with(good, 139, std::nan("")), "scale of y = nan" + rule);
  expectRefused(with(good, 147, 1e300), "scale of z = 1e+300" + rule);
  expectRefused(with(good, 155, std::numeric_limits<double>::infinity()),
                "offset of x = inf, but must be finite and within 1e12");
}

TEST(LasErrors, CountsBeyondTheFileAreTruncatedFiles)
{
  const std::string good = lasBytes(lasSample(0, 10));
  expectRefused(good.substr(0, good.size() - 1),
                "is truncated: it holds 9 of 10 points");
  expectRefused(with(good, 107, std::uint32_t{4'000'000'000}),
                "is truncated: it holds 10 of 4000000000 points");
  LasSample late = lasSample(6, 10);
  expectRefused(with(lasBytes(late), 247, ~std::uint64_t{0}),
                "is truncated: it holds 10 of 18446744073709551615 points");
}

TEST(LasErrors, MorePointsThanBytesCanHoldAreRefusedAtOnce)
{
  const std::string good = lazBytes(lasSample(0, 10));
  expectRefused(with(good, 107, std::uint32_t{4'000'000'000}),
                "tells of 4000000000 points in " + std::to_string(good.size() - 321) +
                    " bytes: less than any scan takes");
}

TEST(LasErrors, DescriptionsOfCompressionThatAreNotKnownAreRefused)
{
  const LasSample sample = lasSample(1, 100);
  const std::string good = lazBytes(sample);
  const std::size_t vlr = 227 + 54;
  expectRefused(with(good, vlr, std::uint16_t{4}),
                "is compressed by method 4.0 of LAZ: unknown (known: 1.0 to 3.0)");
  expectRefused(with(good, vlr + 12, std::uint32_t{0}), "its chunks hold 0 points");
  expectRefused(with(good, vlr + 32, std::uint16_t{900}),
                "the record 'laszip encoded' has only 46 bytes");
  expectRefused(with(good, vlr + 32, std::uint16_t{1}),
                "its compressed parts have 20 bytes a point, but the points have 28");
  expectRefused(with(good, vlr + 34 + 4, std::uint16_t{1}),
                "has a part of type 6, version 1 in points of format 1: cannot be read "
                "(LAZ: formats 0 to 3 and 6 to 8); decompress the file to LAS");
  expectRefused(with(good, vlr + 40, std::uint16_t{9}),
                "is a LAZ file with waveforms (point format 1): cannot be read; "
                "decompress the file to LAS");
}

TEST(LasErrors, TablesOfChunksThatPointOutsideAreRefused)
{
  const LasSample sample = lasSample(0, 100);
  const std::string good = lazBytes(sample, 30);
  const std::size_t begin = 227 + 54 + 40; // of the points
  const std::string size = std::to_string(good.size());
  expectRefused(with(good, begin, std::int64_t{1} << 40),
                "the table of chunks begins at byte 1099511627776, but must lie behind "
                "the points from byte " +
                    std::to_string(begin + 8) + ", and before the end at byte " + size);
  std::int64_t table = 0;
  std::memcpy(&table, &good[begin], 8);
  const auto at = static_cast<std::size_t>(table);
  const std::string bytes = std::to_string(at - begin - 8);
  expectRefused(with(good, at, std::uint32_t{1}),
                "the table of chunks has version 1, but must have 0");
  expectRefused(with(good, at + 4, std::uint32_t{4'000'000'000}),
                "its table tells of 4000000000 chunks, but there are only " + bytes +
                    " bytes of them");
  expectRefused(with(good, at + 4, std::uint32_t{3}),
                "the table of chunks tells of 90 points, but its header of 100");
}

// Whatever is cut off or flipped: an error of one line, or points; never anything else.
TEST(LasErrors, CompressedFilesCutAnywhereAreRefused)
{
  const TempFolder folder;
  const fs::path file = folder / "a.laz";
  for (const int format : {1, 3, 7})
    for (const auto table : {ChunkTable::kTold, ChunkTable::kMissing}) {
      const std::string good = lazBytes(lasSample(format, 300, 2), 100, table);
      for (std::size_t size = 0; size < good.size(); size += 1 + size / 40) {
        replaceText(file, good.substr(0, size));
        const std::string message = messageOf<IoFailed>([&] { readScan(file); });
        EXPECT_NE(message, "no error") << "of format " << format << " cut to " << size;
        EXPECT_EQ(message.find('\n'), std::string::npos);
      }
    }
}

TEST(LasErrors, FlippedBytesGiveAnErrorOrPoints)
{
  const TempFolder folder;
  const fs::path file = folder / "a.laz";
  Random random(5);
  for (int round = 0; round < 600; ++round) {
    std::string bytes = lazBytes(lasSample(round % 2 == 0 ? 3 : 8, 60, 1), 25);
    for (int flips = 0; flips < 3; ++flips) {
      const auto place = static_cast<std::size_t>(random.uniform() *
                                                  static_cast<double>(bytes.size()));
      bytes[place] = static_cast<char>(random.uniform() * 256);
    }
    replaceText(file, bytes);
    const std::string message =
        messageOf<IoFailed>([&] { EXPECT_LE(readScan(file).points.size(), 200000U); });
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}
