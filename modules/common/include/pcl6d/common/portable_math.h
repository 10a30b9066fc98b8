// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

/** \file Sine, cosine, arc tangent, arc cosine, logarithm and exponential from + - * / and sqrt
 * alone, which IEEE 754 fixes to the last bit. The C library's functions are equally accurate
 * but vary: glibc runs different code on CPUs with and without FMA, and the last bits of sin,
 * cos, tan, acos, atan2, exp, log and pow differ. Code that affects a result calls the
 * functions of this header instead, and must not call Eigen::AngleAxis, Quaternion::slerp,
 * angularDistance, eulerAngles or SelfAdjointEigenSolver::computeDirect either. Eigen's
 * remaining decompositions, inverses and conversions between quaternions and matrices use the
 * four basic operations and sqrt only. Exact, and free to use: std::sqrt, floor, round, frexp,
 * ldexp, fmod, remainder.
 *
 * To check a program, run twice, once with GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA (glibc
 * 2.33 or later; older versions name the flags AVX2_Usable and FMA_Usable), and compare the
 * files. Few arguments differ, so the comparison shows little. The proof is that `nm -D
 * --undefined-only` of each library lists none of the variable functions.
 * test/apps/test_same_bits.cpp does both. */
namespace PCL6D_EXPORTS pcl6d {

struct SinCos {
  double sin = 0;
  double cos = 1;
};

/** \param[in] x angle [rad], |x| <= 2^20; beyond, and for NaN, both results are NaN
 * \return sine and cosine, each within 1 ulp */
SinCos
portableSinCos(double x);

/** \return the angle of the point (x, y) [rad], in [-pi, pi], within 1.5 ulp; for zeros,
 * infinities and NaN the value of std::atan2 */
double
portableAtan2(double y, double x);

/** \return the arc cosine [rad], in [0, pi], within 3 ulp; NaN outside [-1, 1] */
double
portableAcos(double x);

/** \return the natural logarithm, within 1 ulp; -infinity of 0, NaN of a negative x */
double
portableLog(double x);

/** \return e^x, within 1 ulp; below 2^-1022 within 1.5 times the smallest number */
double
portableExp(double x);

} // namespace pcl6d
