// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/measurement_principles.h>

#include <cmath>
#include <limits>

namespace pcl6d {
namespace {
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kTurn = 2 * M_PI;

// The angle reduced to [0, 2 pi).
double
wrapped(double angle)
{
  const double rest = std::fmod(angle, kTurn);
  const double positive = rest < 0 ? rest + kTurn : rest;
  return positive == kTurn ? 0 : positive; // a tiny negative rest rounds up to a turn
}

WaveSamples
wave(double sine, double cosine, double scale, double offset)
{
  const double swing = std::sqrt(sine * sine + cosine * cosine);
  return {
      swing > 0 ? wrapped(portableAtan2(sine, cosine)) : kNaN, scale * swing, offset};
}
} // namespace

double
rangeFromTime(double round_trip, double refractive_index)
{
  return round_trip >= 0 ? kSpeedOfLight / refractive_index * round_trip / 2 : kNaN;
}

double
rangeSigmaFromTime(double time_sigma, double refractive_index)
{
  return kSpeedOfLight / refractive_index * time_sigma / 2;
}

double
unambiguousRangeOfPulses(double pulse_frequency)
{
  return kSpeedOfLight / (2 * pulse_frequency);
}

double
footprintDiameter(double range, double exit_diameter, double divergence)
{
  const SinCos half = portableSinCos(divergence / 2);
  return exit_diameter + 2 * range * half.sin / half.cos;
}

double
ambiguityInterval(double frequency)
{
  return kSpeedOfLight / (2 * frequency);
}

double
rangeFromPhase(double phase, double frequency)
{
  return ambiguityInterval(frequency) * wrapped(phase) / kTurn;
}

double
rangeSigmaFromPhase(double phase_sigma, double frequency)
{
  return ambiguityInterval(frequency) * phase_sigma / kTurn;
}

double
phaseOfRange(double range, double frequency)
{
  const double interval = ambiguityInterval(frequency);
  return wrapped(std::fmod(range, interval) / interval * kTurn);
}

double
rangeFromTwoPhases(double phase1, double frequency1, double phase2, double frequency2)
{
  require(frequency1 > 0 && std::isfinite(frequency1), "frequency1", frequency1, "> 0");
  require(frequency2 > frequency1 && std::isfinite(frequency2),
          "frequency2",
          frequency2,
          "> frequency1");
  const double coarse = rangeFromPhase(phase2 - phase1, frequency2 - frequency1);
  const double fine = rangeFromPhase(phase1, frequency1);
  const double interval = ambiguityInterval(frequency1);
  return fine + std::round((coarse - fine) / interval) * interval;
}

double
depthFromAngles(double baseline, double alpha, double beta)
{
  const SinCos a = portableSinCos(alpha);
  const SinCos b = portableSinCos(beta);
  const double sine_of_sum = a.sin * b.cos + a.cos * b.sin;
  if (!(a.sin > 0 && b.sin > 0 && sine_of_sum > 0))
    return kNaN;
  return baseline * a.sin * b.sin / sine_of_sum;
}

double
depthFromImage(double baseline, double focal_length, double beam_angle, double x)
{
  const SinCos beta = portableSinCos(beam_angle);
  const double denominator = x + focal_length * beta.cos / beta.sin;
  return beta.sin > 0 && denominator > 0 ? baseline * focal_length / denominator : kNaN;
}

double
depthSigmaFromImage(double depth, double baseline, double focal_length, double x_sigma)
{
  return depth * depth / (baseline * focal_length) * x_sigma;
}

WaveSamples
waveFromFourSamples(const std::array<double, 4>& samples)
{
  const auto [s0, s1, s2, s3] = samples;
  return wave(s3 - s1, s0 - s2, 0.5, (s0 + s1 + s2 + s3) / 4);
}

WaveSamples
waveFromShiftedPatterns(const std::vector<double>& samples)
{
  require(samples.size() >= 3, "patterns", samples.size(), ">= 3");
  const auto count = static_cast<double>(samples.size());
  double sine = 0;
  double cosine = 0;
  double sum = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const SinCos shift = portableSinCos(kTurn * static_cast<double>(k) / count);
    sine -= samples[k] * shift.sin;
    cosine += samples[k] * shift.cos;
    sum += samples[k];
  }
  return wave(sine, cosine, 2 / count, sum / count);
}

double
columnFromPatterns(unsigned stripe, double stripe_width, double phase)
{
  const double period = 2 * stripe_width;
  const double coarse = (stripe + 0.5) * stripe_width;
  const double fine = wrapped(phase) / kTurn * period;
  return fine + std::round((coarse - fine) / period) * period;
}

} // namespace pcl6d
