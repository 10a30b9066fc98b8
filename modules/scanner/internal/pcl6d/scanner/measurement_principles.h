// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <array>
#include <vector>

/** \file Principles of distance measurement (book 2.1, 2.2.4, 2.4), as closed formulas: time
 * of flight, phase shift, triangulation. Metres, radians, seconds, hertz; image coordinates
 * and focal lengths in pixels. A measurement without a solution is NaN, never zero: a zero
 * range would lie on the sensor. RangeErrorModel combines their errors for the simulator.
 * \ingroup scanner */
namespace PCL6D_EXPORTS pcl6d {

constexpr double kSpeedOfLight = 299792458;       ///< [m/s] in vacuum
constexpr double kRefractiveIndexOfAir = 1.00027; ///< at sea level, for near infrared

/** \name Time of flight (2.1.1) */
///@{

/** \return distance of a surface from the round-trip time [s] >= 0 of its echo; NaN
 * without echo (NaN or negative) */
double
rangeFromTime(double round_trip, double refractive_index = 1);

/** \return sigma of a distance from sigma of the time [s]: c sigma_t / 2 */
double
rangeSigmaFromTime(double time_sigma, double refractive_index = 1);

/** \return the largest unambiguous distance for pulse_frequency [Hz] > 0: c / (2 PRF) */
double
unambiguousRangeOfPulses(double pulse_frequency);

/** \return diameter of the beam's spot at a distance: D0 + 2 r tan(gamma / 2).
 * \param[in] exit_diameter D0 [m] \param[in] divergence gamma, full angle [rad] */
double
footprintDiameter(double range, double exit_diameter, double divergence);
///@}

/** \name Phase shift (2.1.2) */
///@{

/** \return the interval of unambiguous distances: c / (2 f) */
double
ambiguityInterval(double frequency);

/** \return distance of a phase lag, in [0, ambiguity interval); the true distance may
 * be larger by any number of intervals. \param[in] phase [rad], any turn */
double
rangeFromPhase(double phase, double frequency);

/** \return sigma of a distance from sigma of the phase: c sigma_phi / (4 pi f) */
double
rangeSigmaFromPhase(double phase_sigma, double frequency);

/** \return phase lag measured for a distance >= 0, in [0, 2 pi) */
double
phaseOfRange(double range, double frequency);

/** \brief Resolves the ambiguity by two close frequencies: the phase difference gives
 * the interval, the phase of the lower frequency the distance within the interval.
 * \param[in] phase1 at frequency1 \param[in] phase2 at frequency2 > frequency1 > 0
 * \return distance, unambiguous up to ambiguityInterval(frequency2 - frequency1), if
 * the error of the coarse distance is below half of ambiguityInterval(frequency1)
 * \throws BadArgument the frequencies are invalid */
double
rangeFromTwoPhases(double phase1, double frequency1, double phase2, double frequency2);
///@}

/** \name Triangulation (2.1.3) */
///@{

/** \return depth square to the baseline: b sin(alpha) sin(beta) / sin(alpha + beta); NaN
 * if the rays do not meet in front of the sensor.
 * \param[in] alpha, beta angles of the two rays against the baseline, both inwards */
double
depthFromAngles(double baseline, double alpha, double beta);

/** \brief Camera at the origin looking along z, laser at (baseline, 0, 0).
 * \param[in] beam_angle beta of the beam against the baseline, inwards, in (0, pi)
 * \param[in] x [px] image of the spot, from the principal point
 * \return depth z = b f / (x + f cot(beta)); NaN if the rays do not meet in front */
double
depthFromImage(double baseline, double focal_length, double beam_angle, double x);

/** \return sigma of a depth from triangulation: z^2 / (b f) sigma_x. \param[in] x_sigma [px] */
double
depthSigmaFromImage(double depth, double baseline, double focal_length, double x_sigma);
///@}

/** \name Samples of a modulated wave (2.2.4, 2.4) */
///@{

/** \brief A cosine wave recovered from its samples. */
struct WaveSamples {
  double phase = 0;     ///< [rad] in [0, 2 pi); NaN without modulation
  double amplitude = 0; ///< half the swing
  double offset = 0;    ///< mean of the samples
};

/** \brief Time-of-flight camera: A_k = O + A cos(phi + k pi / 2), k = 0..3. */
WaveSamples
waveFromFourSamples(const std::array<double, 4>& samples);

/** \brief Structured light: I_k = A + B cos(phi + 2 pi k / S), S >= 3 shifted patterns.
 * \throws BadArgument fewer than 3 samples */
WaveSamples
waveFromShiftedPatterns(const std::vector<double>& samples);
///@}

/** \name Gray code (2.2.4): neighbouring stripes differ in one pattern only */
///@{
constexpr unsigned
grayCode(unsigned stripe)
{
  return stripe ^ (stripe >> 1);
}

/** \return the stripe of a code: the inverse of grayCode() */
constexpr unsigned
stripeOfGrayCode(unsigned code)
{
  for (unsigned shift = 1; shift < 32; shift *= 2)
    code ^= code >> shift;
  return code;
}

/** \brief A projector's column from Gray code and shifted patterns. The period of the
 * shifted patterns is two stripes of the Gray code: a stripe mistaken for its
 * neighbour, at their border, does no harm.
 * \param[in] stripe decoded index \param[in] stripe_width [px] > 0
 * \param[in] phase of the shifted patterns [rad], 0 at the start of stripe 0
 * \return column from the start of stripe 0 [px] */
double
columnFromPatterns(unsigned stripe, double stripe_width, double phase);
///@}

} // namespace pcl6d
