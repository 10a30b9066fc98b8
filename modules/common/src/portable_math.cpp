// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

namespace pcl6d {

namespace {
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/** A number as the unevaluated sum of two; the second is below an ulp of the first. */
struct Double2 {
  double high;
  double low;
};

constexpr Double2 kPi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr Double2 kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr Double2 kQuarterPi{0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55};
// log 2 in two parts: an exponent times the first part is exact.
constexpr Double2 kLog2{0x1.62e42fefp-1, 0x1.473de6af278edp-34};
constexpr Double2 kAtanHalf{0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56};

/** \return a - b; the parts together are exact (Knuth's TwoSum) */
Double2
exactDifference(double a, double b)
{
  const double d = a - b;
  const double b_seen = a - d;
  return {d, (a - (d + b_seen)) + (b_seen - b)};
}

/** \return the sum of c[i] z^i */
template <std::size_t N>
double
polynomial(const double (&c)[N], double z)
{
  double sum = c[N - 1];
  for (std::size_t i = N - 1; i-- > 0;)
    sum = sum * z + c[i];
  return sum;
}

/** \return x - k pi/2 for a whole k, |k| < 2^20 */
Double2
reduced(double x, double k)
{
  // pi/2 in parts of 33 bits: k times each but the last is exact. The double nearest to a
  // multiple of pi/2 keeps 60 bits of distance; the parts together have 157 bits.
  constexpr double kRest[] = {
      0x1.0b4611a6p-34, 0x1.3198a2ep-69, 0x1.b839a252049c1p-104};
  double high = x - k * 0x1.921fb544p+0; // exact
  double low = 0;
  for (const double part : kRest) {
    const Double2 difference = exactDifference(high, k * part);
    high = difference.high;
    low += difference.low;
  }
  const double sum = high + low;
  return {sum, (high - sum) + low};
}

// All series are Taylor series, up to the last term that matters in double.

/** \return the sine of r, |r| <= pi/4 */
double
sineNearZero(const Double2& r)
{
  constexpr double kSine[] = {-1.0 / 6,
                              1.0 / 120,
                              -1.0 / 5040,
                              1.0 / 362880,
                              -1.0 / 39916800,
                              1.0 / 6227020800,
                              -1.0 / 1307674368000,
                              1.0 / 355687428096000};
  const double z = r.high * r.high;
  return r.high + (r.high * z * polynomial(kSine, z) + (r.low - 0.5 * z * r.low));
}

/** \return the cosine of r, |r| <= pi/4 */
double
cosineNearZero(const Double2& r)
{
  constexpr double kCosine[] = {1.0 / 24,
                                -1.0 / 720,
                                1.0 / 40320,
                                -1.0 / 3628800,
                                1.0 / 479001600,
                                -1.0 / 87178291200,
                                1.0 / 20922789888000};
  const double z = r.high * r.high;
  const double head = 1 - 0.5 * z;
  const double head_error = (1 - head) - 0.5 * z;
  return head + (head_error + (z * z * polynomial(kCosine, z) - r.high * r.low));
}

/** \return atan z - z, |z| <= 5/16 */
double
arcTangentTail(double z)
{
  constexpr double kArcTangent[] = {-1.0 / 3,
                                    1.0 / 5,
                                    -1.0 / 7,
                                    1.0 / 9,
                                    -1.0 / 11,
                                    1.0 / 13,
                                    -1.0 / 15,
                                    1.0 / 17,
                                    -1.0 / 19,
                                    1.0 / 21,
                                    -1.0 / 23,
                                    1.0 / 25,
                                    -1.0 / 27,
                                    1.0 / 29,
                                    -1.0 / 31,
                                    1.0 / 33};
  return z * z * z * polynomial(kArcTangent, z * z);
}
} // namespace

SinCos
portableSinCos(double x)
{
  if (!(std::abs(x) <= 0x1p20))
    return {kNan, kNan};
  if (std::abs(x) < 0x1p-27) // keeps -0
    return {x, 1};
  const double k = std::floor(x * (2 / M_PI) + 0.5);
  const Double2 r = reduced(x, k);
  const double s = sineNearZero(r);
  const double c = cosineNearZero(r);
  switch (static_cast<long>(k) & 3) {
  case 0:
    return {s, c};
  case 1:
    return {c, -s};
  case 2:
    return {-s, -c};
  default:
    return {-c, s};
  }
}

double
portableAtan2(double y, double x)
{
  if (std::isnan(x) || std::isnan(y))
    return kNan;
  // The angle a of the point in the first octant; then base + sign a in the half plane.
  double opposite = std::abs(y);
  double adjacent = std::abs(x);
  const bool is_steep = opposite > adjacent;
  if (is_steep)
    std::swap(opposite, adjacent);
  const bool is_left = std::signbit(x);
  const double sign = is_steep != is_left ? -1 : 1;
  const Double2 base = is_steep ? kHalfPi : is_left ? kPi : Double2{0, 0};

  if (adjacent == kInfinity) {
    opposite = opposite == kInfinity ? 1 : 0;
    adjacent = 1;
  }
  // a = atan c + atan z for c = 0, 1/2 or 1; these c keep the numerator exact.
  Double2 atan_c{0, 0};
  double z = adjacent > 0 ? opposite / adjacent : 0;
  if (z >= 5.0 / 16) {
    const double c = z < 0.75 ? 0.5 : 1;
    atan_c = z < 0.75 ? kAtanHalf : kQuarterPi;
    const double scale = adjacent > 1 ? 0x1p-500 : 0x1p+500; // no overflow
    opposite *= scale;
    adjacent *= scale;
    z = (opposite - c * adjacent) / (adjacent + c * opposite);
  }
  const double sum = base.high + sign * atan_c.high;
  const double sum_error = (base.high - sum) + sign * atan_c.high;
  const double low = base.low + sign * (atan_c.low + arcTangentTail(z));
  return std::copysign(sum + (sign * z + (sum_error + low)), y);
}

double
portableAcos(double x)
{
  return portableAtan2(std::sqrt((1 - x) * (1 + x)), x);
}

double
portableLog(double x)
{
  if (!(x > 0))
    return x == 0 ? -kInfinity : kNan;
  if (x == kInfinity)
    return x;
  int exponent = 0;
  double m = std::frexp(x, &exponent); // exact: x = m 2^exponent, m in [0.5, 1)
  if (m < M_SQRT1_2) {
    m *= 2;
    --exponent;
  }
  // log(1 + f) = 2 artanh s = 2 s + s tail with s = f / (2 + f), |s| < 0.172, and 2 s = f -
  // f^2/2 + s f^2/2: the first term is exact and the rest small.
  constexpr double kArtanh[] = {2.0 / 3,
                                2.0 / 5,
                                2.0 / 7,
                                2.0 / 9,
                                2.0 / 11,
                                2.0 / 13,
                                2.0 / 15,
                                2.0 / 17,
                                2.0 / 19,
                                2.0 / 21};
  const double f = m - 1; // exact
  const double s = f / (2 + f);
  const double tail = s * s * polynomial(kArtanh, s * s);
  const double half_sq = 0.5 * f * f;
  const double low = exponent * kLog2.low + s * (half_sq + tail);
  return exponent * kLog2.high + (f - (half_sq - low));
}

namespace {
/** std::floor() is a call where the CPU may lack the instruction. */
int
floorOf(double x)
{
  const int truncated = static_cast<int>(x);
  return truncated > x ? truncated - 1 : truncated;
}

constexpr int kLeastPower = -1020; ///< of two: value, double and half are normal

double
powerOfTwo(int power)
{
  const std::uint64_t bits = static_cast<std::uint64_t>(power + 1023) << 52;
  double value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}
} // namespace

double
portableExp(double x)
{
  if (std::isnan(x))
    return x;
  if (x > 710)
    return kInfinity;
  if (x < -746)
    return 0;
  // e^x = 2^k e^r with r = x - k log 2, |r| < 0.35
  const int power = floorOf(x * M_LOG2E + 0.5);
  const double k = power;
  const double high = x - k * kLog2.high; // exact
  const double low = k * kLog2.low;
  const double r = high - low;
  const double r_low = (high - r) - low;
  constexpr double kExponential[] = {1.0 / 2,
                                     1.0 / 6,
                                     1.0 / 24,
                                     1.0 / 120,
                                     1.0 / 720,
                                     1.0 / 5040,
                                     1.0 / 40320,
                                     1.0 / 362880,
                                     1.0 / 3628800,
                                     1.0 / 39916800,
                                     1.0 / 479001600,
                                     1.0 / 6227020800};
  const double tail = r_low + r * r * polynomial(kExponential, r);
  const double fraction = 1 + (r + tail);
  return power > kLeastPower && power < -kLeastPower ? fraction * powerOfTwo(power)
                                                     : std::ldexp(fraction, power);
}

} // namespace pcl6d
