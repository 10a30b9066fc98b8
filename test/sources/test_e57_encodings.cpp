// SPDX-License-Identifier: BSD-3-Clause
// Values of every width and kind come back to the last bit, however packets cut them.
#include "e57/crc32c.h"
#include "e57/record_reader.h"
#include "sources/made_e57.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace {

using namespace pcl6d::test;
using namespace pcl6d::sources;

/** \return the values of all fields of the first scan */
std::vector<E57Column>
readBack(const std::filesystem::path& path)
{
  PageReader file(path);
  const auto scans = readE57Layout(file);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < scans.at(0).fields.size(); ++i)
    wanted.push_back(i);
  std::vector<E57Column> all(wanted.size());
  readRecords(
      file, scans[0], "scan 0", wanted, [&](const auto& columns, std::size_t count) {
        for (std::size_t f = 0; f < columns.size(); ++f)
          for (std::size_t i = 0; i < count; ++i)
            if (scans[0].fields[f].isInteger())
              all[f].addIntegers(columns[f]->integer(i));
            else
              all[f].addReal(columns[f]->real(i));
      });
  return all;
}

std::uint64_t
bitsOf(double value)
{
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

void
expectSame(const MadeScan& scan, const std::vector<E57Column>& found)
{
  ASSERT_EQ(found.size(), scan.fields.size());
  for (std::size_t f = 0; f < found.size(); ++f) {
    const MadeField& made = scan.fields[f];
    ASSERT_EQ(found[f].size(), std::max(made.integers.size(), made.reals.size()))
        << made.field.name;
    for (std::size_t i = 0; i < made.integers.size(); ++i)
      ASSERT_EQ(found[f].integer(i), made.integers[i]) << made.field.name << ' ' << i;
    for (std::size_t i = 0; i < made.reals.size(); ++i)
      ASSERT_EQ(bitsOf(found[f].real(i)), bitsOf(made.reals[i]))
          << made.field.name << ' ' << i;
  }
}

/** \return a field of integers of that many bits, with random values and both limits */
MadeField
randomField(unsigned bits, std::size_t count, std::mt19937_64& random)
{
  const std::uint64_t range = bits == 64 ? ~0ULL : (1ULL << bits) - 1;
  const auto minimum = bits == 64 ? std::numeric_limits<std::int64_t>::min()
                                  : -static_cast<std::int64_t>(range / 3);
  const auto at = [&](std::uint64_t above) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(minimum) + above);
  };
  std::vector<std::int64_t> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(at(i == 0 ? 0 : i + 1 == count ? range : random() & range));
  return integersOf("ext:w" + std::to_string(bits), minimum, at(range), values);
}

TEST(E57Encodings, IntegersOfEveryWidthComeBack)
{
  const TempFolder folder;
  std::mt19937_64 random(7);
  for (const std::size_t packet_points : {0, 1, 7, 64}) {
    SCOPED_TRACE("points in a packet: " + std::to_string(packet_points));
    MadeScan scan;
    scan.packet_points = packet_points;
    for (unsigned bits = 1; bits <= 64; ++bits)
      scan.fields.push_back(randomField(bits, 1003, random));
    for (unsigned bits = 1; bits <= 64; ++bits)
      ASSERT_EQ(scan.fields[bits - 1].field.bits(), bits);
    makeE57(folder / "a.e57", {scan});
    expectSame(scan, readBack(folder / "a.e57"));
  }
}

TEST(E57Encodings, AWidthIsThatOfTheWholeRangeNotAPowerOfTwo)
{
  const TempFolder folder;
  MadeScan scan;
  std::vector<std::int64_t> values;
  for (std::int64_t i = 0; i < 300; ++i)
    values.push_back(1000 + i % 6);
  scan.fields.push_back(integersOf("six", 1000, 1005, values));
  EXPECT_EQ(scan.fields[0].field.bits(), 3U);
  makeE57(folder / "a.e57", {scan});
  expectSame(scan, readBack(folder / "a.e57"));
}

TEST(E57Encodings, FloatingPointKeepsItsBits)
{
  using Limits = std::numeric_limits<double>;
  const TempFolder folder;
  MadeScan scan;
  scan.packet_points = 3;
  scan.fields.push_back(realsOf("d",
                                {0.0,
                                 -0.0,
                                 0.1,
                                 Limits::max(),
                                 Limits::denorm_min(),
                                 Limits::infinity(),
                                 Limits::quiet_NaN()}));
  scan.fields.push_back(
      realsOf("s",
              {0.0, -0.0, 0.5, 3.4028234663852886e38, 1.4e-45F, -1e10F, 1.F / 3},
              E57Kind::kSingle));
  makeE57(folder / "a.e57", {scan});
  expectSame(scan, readBack(folder / "a.e57"));
}

TEST(E57Encodings, ValuesThatAreAllTheMinimumTakeNoBits)
{
  const TempFolder folder;
  MadeScan scan;
  scan.fields.push_back(realsOf("cartesianX", std::vector<double>(200, 1.5)));
  scan.fields.push_back(integersOf("c", -42, -42, std::vector<std::int64_t>(200, -42)));
  scan.fields.push_back(
      scaledOf(integersOf("s", 7, 7, std::vector<std::int64_t>(200, 7)), 0.5, 1));
  EXPECT_EQ(scan.fields[1].field.bits(), 0U);
  EXPECT_EQ(scan.fields[2].field.valueOf(7), 4.5);
  makeE57(folder / "a.e57", {scan});
  expectSame(scan, readBack(folder / "a.e57"));
  scan.fields.erase(scan.fields.begin()); // and where no field has any
  makeE57(folder / "b.e57", {scan});
  expectSame(scan, readBack(folder / "b.e57"));
}

TEST(E57Encodings, ScaleAndOffsetComeBackExactly)
{
  const TempFolder folder;
  MadeScan scan;
  scan.fields.push_back(scaledOf(integersOf("s", -5, 9, {-5, 9, 0}), 1e-6, 0.1));
  makeE57(folder / "a.e57", {scan});
  PageReader file(folder / "a.e57");
  const E57Field field = readE57Layout(file).at(0).fields.at(0);
  EXPECT_EQ(field.valueOf(9), 9 * 1e-6 + 0.1);
  EXPECT_EQ(field.valueOf(-5), -5 * 1e-6 + 0.1);
}

TEST(E57Encodings, TheChecksumIsCastagnolis)
{
  const std::string digits =
      "123456789"; // check value of CRC-32C in all its descriptions
  EXPECT_EQ(crc32c(reinterpret_cast<const std::uint8_t*>(digits.data()), digits.size()),
            0xE3069283U);
  const std::vector<std::uint8_t> zeros(32); // RFC 3720, B.4
  EXPECT_EQ(crc32c(zeros.data(), zeros.size()), 0x8A9136AAU);
  EXPECT_EQ(crc32c(zeros.data(), 0), 0U);
}

} // namespace
