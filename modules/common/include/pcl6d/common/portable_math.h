// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

/** \file
 * Sine, cosine, arc tangent, arc cosine, logarithm and exponential from + - * / and sqrt
 * alone, which IEEE 754 fixes to the last bit. The C library's functions are as accurate but
 * not as constant: glibc takes other code on a CPU with FMA than on one without, and
 * the last bits of sin, cos, tan, acos, atan2, exp, log and pow differ. Whatever a
 * result depends on calls these instead; so it must not call Eigen::AngleAxis,
 * Quaternion::slerp, angularDistance, eulerAngles or
 * SelfAdjointEigenSolver::computeDirect either. Eigen's other decompositions, inverses
 * and conversions between quaternions and matrices need + - * / and sqrt only. Exact,
 * and free to use: std::sqrt, floor, round, frexp, ldexp, fmod, remainder.
 *
 * To check a program, run it a second time with
 * GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA (glibc 2.33 or later; older ones name them
 * AVX2_Usable and FMA_Usable) and compare the files. Few arguments differ, so this
 * shows little; the proof is that `nm -D --undefined-only` of each library lists none
 * of those functions. test/apps/test_same_bits.cpp does both. */
namespace PCL6D_EXPORTS pcl6d {

struct SinCos {
  double sin = 0;
  double cos = 1;
};

/** \param[in] x angle [rad], |x| <= 2^20; beyond, and for NaN, both results are NaN
 * \return sine and cosine, each within 1 ulp */
SinCos
portableSinCos(double x);

/** \return the angle of the point (x, y) [rad], in [-pi, pi], within 1.5 ulp; for
 * zeros, infinities and NaN what std::atan2 returns */
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
