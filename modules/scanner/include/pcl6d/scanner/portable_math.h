// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/random.h>

#include <cmath>

/** \file
 * Sine, cosine, logarithm and normal numbers from + - * / and sqrt alone, which IEEE
 * 754 fixes to the last bit. The C library's functions are as accurate but not as
 * constant: glibc takes other code on a CPU with FMA than on one without, and the last
 * bits of sin, cos, log and atan2 differ. */
namespace pcl6d {

struct SinCos {
  double sin = 0;
  double cos = 1;
};

/** \param[in] x angle [rad], |x| < 1e5 \return sine and cosine, within 2^-52 */
inline SinCos
portableSinCos(double x)
{
  // x = k pi/2 + r; pi/2 in two parts, so that k times the first one is exact.
  constexpr double kHalfPiHigh = 0x1.921fb544p+0;
  constexpr double kHalfPiLow = 0x1.0b4611a626331p-34;
  const double k = std::floor(x * (2 / M_PI) + 0.5);
  const double r = (x - k * kHalfPiHigh) - k * kHalfPiLow;
  // Taylor series on |r| <= pi/4, nested; the first term left out is below 1e-19.
  double s = 1;
  double c = 1;
  for (int n = 18; n >= 2; n -= 2) {
    s = 1 - r * r / (n * (n + 1)) * s;
    c = 1 - r * r / (n * (n - 1)) * c;
  }
  s *= r;
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

/** \param[in] x > 0 \return the natural logarithm, within 2^-51 relative */
inline double
portableLog(double x)
{
  int exponent = 0;
  double m = std::frexp(x, &exponent); // exact: x = m 2^exponent, m in [0.5, 1)
  if (m < M_SQRT1_2) {
    m *= 2;
    --exponent;
  }
  const double s = (m - 1) / (m + 1); // log m = 2 artanh s, |s| < 0.172
  double series = 0;
  for (int n = 23; n >= 1; n -= 2)
    series = series * s * s + 1.0 / n;
  return exponent * M_LN2 + 2 * s * series;
}

/** \return a standard normal number (polar method, Marsaglia and Bray 1964) */
inline double
portableNormal(Random& random)
{
  while (true) {
    const double u = random.uniform(-1, 1);
    const double v = random.uniform(-1, 1);
    const double q = u * u + v * v;
    if (q > 0 && q < 1)
      return u * std::sqrt(-2 * portableLog(q) / q);
  }
}

} // namespace pcl6d
