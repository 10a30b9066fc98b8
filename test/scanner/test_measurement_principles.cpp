// SPDX-License-Identifier: BSD-3-Clause
#include "support/constants.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/random.h>
#include <pcl6d/scanner/measurement_principles.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::test::kDegree;

namespace {
using namespace pcl6d;

// The instrument's side of triangulation: the image of a spot at (x, z).
double
imageOf(double x, double z, double focal_length)
{
  return focal_length * x / z;
}

std::vector<double>
samplesOf(double offset, double amplitude, double phase, int count)
{
  std::vector<double> samples;
  for (int k = 0; k < count; ++k)
    samples.push_back(offset + amplitude * std::cos(phase + 2 * M_PI * k / count));
  return samples;
}

double
angleBetween(double a, double b)
{
  return std::abs(std::remainder(a - b, 2 * M_PI));
}
} // namespace

TEST(TimeOfFlight, MeasuresHalfTheWayOfTheLight)
{
  EXPECT_DOUBLE_EQ(rangeFromTime(2.0), kSpeedOfLight);
  EXPECT_NEAR(rangeFromTime(1e-9), 0.15, 1e-3); // the book's figures
  EXPECT_NEAR(rangeSigmaFromTime(67e-12), 0.01, 1e-4);
  EXPECT_NEAR(rangeFromTime(1e-6) / rangeFromTime(1e-6, kRefractiveIndexOfAir),
              kRefractiveIndexOfAir,
              1e-12);
  EXPECT_NEAR(unambiguousRangeOfPulses(1e6), 149.896229, 1e-9);
  EXPECT_TRUE(std::isnan(rangeFromTime(-1e-9)));
  EXPECT_TRUE(std::isnan(rangeFromTime(std::nan(""))));
}

TEST(TimeOfFlight, SpotGrowsWithTheDistance)
{
  EXPECT_EQ(footprintDiameter(10, 0.02, 0), 0.02);
  EXPECT_NEAR(footprintDiameter(10, 0.02, 4.4e-3), 0.064, 1e-6);
  EXPECT_NEAR(footprintDiameter(1, 0, M_PI / 2), 2, 1e-12);
}

TEST(PhaseShift, RepeatsAfterTheAmbiguityInterval)
{
  const double f = 20e6;
  EXPECT_NEAR(ambiguityInterval(f), 7.4948, 1e-4);
  for (double range = 0; range < 40; range += 0.37) {
    const double phase = phaseOfRange(range, f);
    ASSERT_GE(phase, 0);
    ASSERT_LT(phase, 2 * M_PI);
    const double expected = std::fmod(range, ambiguityInterval(f));
    ASSERT_NEAR(rangeFromPhase(phase, f), expected, 1e-12);
    ASSERT_NEAR(rangeFromPhase(phase - 6 * M_PI, f), expected, 1e-12);
  }
  EXPECT_NEAR(rangeSigmaFromPhase(0.01, f),
              rangeFromPhase(1.01, f) - rangeFromPhase(1.0, f),
              1e-15);
  EXPECT_TRUE(std::isnan(rangeFromPhase(std::nan(""), f)));
}

TEST(PhaseShift, TwoFrequenciesResolveTheAmbiguity)
{
  const double f1 = 10e6;
  const double f2 = 11e6; // the difference tells 149.9 m apart, f1 alone 15 m
  const double reach = ambiguityInterval(f2 - f1);
  for (double range = 0.01; range < reach; range += 0.0417)
    ASSERT_NEAR(
        rangeFromTwoPhases(phaseOfRange(range, f1), f1, phaseOfRange(range, f2), f2),
        range,
        1e-9);
  EXPECT_THROW(rangeFromTwoPhases(0, f1, 0, f1), BadArgument);
  EXPECT_THROW(rangeFromTwoPhases(0, 0, 0, f1), BadArgument);
  EXPECT_THROW(rangeFromTwoPhases(0, std::nan(""), 0, f1), BadArgument);
}

TEST(PhaseShift, TwoFrequenciesKeepTheNoiseOfTheFineOne)
{
  const double f1 = 10e6;
  const double f2 = 11e6;
  // The coarse distance errs by sqrt(2) sigma c / (4 pi (f2 - f1)): 0.67 m rms of the
  // 7.5 m that it may.
  const double sigma = 0.02; // [rad]
  Random random(3);
  double sum_sq = 0;
  const int count = 10000;
  for (int i = 0; i < count; ++i) {
    const double range = random.uniform(5, 140);
    const double error =
        rangeFromTwoPhases(phaseOfRange(range, f1) + sigma * random.normal(),
                           f1,
                           phaseOfRange(range, f2) + sigma * random.normal(),
                           f2) -
        range;
    ASSERT_LT(std::abs(error), ambiguityInterval(f1) / 2) << range;
    sum_sq += error * error;
  }
  const double expected = rangeSigmaFromPhase(sigma, f1);
  EXPECT_NEAR(std::sqrt(sum_sq / count), expected, 5 * expected / std::sqrt(2 * count));
}

TEST(PhaseShift, TooMuchNoiseTakesTheWrongInterval)
{
  const double f1 = 10e6;
  const double f2 = 11e6;
  const double range = 70;
  // 0.4 rad are 9.5 m of the coarse distance: more than half an interval.
  const double found = rangeFromTwoPhases(
      phaseOfRange(range, f1), f1, phaseOfRange(range, f2) + 0.4, f2);
  EXPECT_NEAR(found, range + ambiguityInterval(f1), 1e-9);
}

TEST(Triangulation, FindsTheDepthFromTwoAngles)
{
  const double b = 0.3;
  for (double x = -0.5; x < 1; x += 0.13)
    for (double z = 0.1; z < 10; z *= 1.7) {
      const double alpha = std::atan2(z, x);
      const double beta = std::atan2(z, b - x);
      ASSERT_NEAR(depthFromAngles(b, alpha, beta), z, 1e-9 * z * z);
    }
  EXPECT_TRUE(std::isnan(depthFromAngles(b, 100 * kDegree, 80 * kDegree)) ||
              depthFromAngles(b, 100 * kDegree, 80 * kDegree) > 1e12);      // parallel
  EXPECT_TRUE(std::isnan(depthFromAngles(b, 100 * kDegree, 85 * kDegree))); // behind
  EXPECT_TRUE(std::isnan(depthFromAngles(b, -30 * kDegree, 85 * kDegree)));
}

TEST(Triangulation, FindsTheDepthFromAnImage)
{
  const double b = 0.2;
  const double f = 800;
  for (const double beta : {60 * kDegree, 90 * kDegree, 110 * kDegree})
    for (double z = 0.3; z < 8; z *= 1.3) {
      // The laser's beam: x = b - z cot(beta).
      const double x = b - z * std::cos(beta) / std::sin(beta);
      ASSERT_NEAR(depthFromImage(b, f, beta, imageOf(x, z, f)), z, 1e-9);
    }
  // Parallel rays: the cosine of 90 deg rounds to 6e-17.
  EXPECT_GT(depthFromImage(b, f, M_PI / 2, 0), 1e12);
  EXPECT_TRUE(std::isnan(depthFromImage(b, f, M_PI / 2, -5))); // behind
  EXPECT_TRUE(std::isnan(depthFromImage(b, f, 0, 5)));         // along the baseline
}

TEST(Triangulation, SigmaIsThatOfTheFormulaItself)
{
  const double b = 0.2;
  const double f = 800;
  const double beta = 70 * kDegree;
  const double step = 1e-4; // [px]
  for (double z = 0.5; z < 6; z += 0.5) {
    const double x = imageOf(b - z * std::cos(beta) / std::sin(beta), z, f);
    const double slope =
        (depthFromImage(b, f, beta, x - step) - depthFromImage(b, f, beta, x + step)) /
        (2 * step);
    EXPECT_NEAR(depthSigmaFromImage(z, b, f, 1), slope, 1e-6 * slope);
  }
}

TEST(Waves, FourSamplesGivePhaseAmplitudeAndOffset)
{
  for (double phase = 0; phase < 2 * M_PI; phase += 0.1) {
    const auto samples = samplesOf(5, 0.7, phase, 4);
    const WaveSamples found =
        waveFromFourSamples({samples[0], samples[1], samples[2], samples[3]});
    ASSERT_LT(angleBetween(found.phase, phase), 1e-12);
    ASSERT_GE(found.phase, 0);
    ASSERT_LT(found.phase, 2 * M_PI);
    ASSERT_NEAR(found.amplitude, 0.7, 1e-12);
    ASSERT_NEAR(found.offset, 5, 1e-12);
  }
  const WaveSamples dark = waveFromFourSamples({3, 3, 3, 3});
  EXPECT_TRUE(std::isnan(dark.phase));
  EXPECT_EQ(dark.amplitude, 0);
  EXPECT_EQ(dark.offset, 3);
}

TEST(Waves, ShiftedPatternsGivePhaseAmplitudeAndOffset)
{
  for (const int count : {3, 4, 5, 8})
    for (double phase = 0; phase < 2 * M_PI; phase += 0.1) {
      const WaveSamples found =
          waveFromShiftedPatterns(samplesOf(2, 0.3, phase, count));
      ASSERT_LT(angleBetween(found.phase, phase), 1e-12) << count;
      ASSERT_NEAR(found.amplitude, 0.3, 1e-12);
      ASSERT_NEAR(found.offset, 2, 1e-12);
    }
  EXPECT_THROW(waveFromShiftedPatterns({1, 2}), BadArgument);
}

TEST(GrayCode, ChangesOneBitFromStripeToStripe)
{
  for (unsigned stripe = 0; stripe < 1024; ++stripe) {
    ASSERT_EQ(stripeOfGrayCode(grayCode(stripe)), stripe);
    const unsigned changed = grayCode(stripe) ^ grayCode(stripe + 1);
    ASSERT_EQ(changed & (changed - 1), 0u); // a power of two
    ASSERT_NE(changed, 0u);
  }
  EXPECT_EQ(stripeOfGrayCode(grayCode(0xffffffffu)), 0xffffffffu);
}

TEST(GrayCode, ShiftedPatternsRefineTheStripe)
{
  const double width = 8; // [px]
  for (double column = 0.01; column < 1024; column += 0.37) {
    const double phase = M_PI * column / width;
    const auto stripe = static_cast<unsigned>(column / width);
    ASSERT_NEAR(columnFromPatterns(stripe, width, phase), column, 1e-10);
    // At the border of two stripes either may be read.
    const double in_stripe = column - stripe * width;
    if (in_stripe < 0.4 * width && stripe > 0) {
      ASSERT_NEAR(columnFromPatterns(stripe - 1, width, phase), column, 1e-10);
    }
    if (in_stripe > 0.6 * width) {
      ASSERT_NEAR(columnFromPatterns(stripe + 1, width, phase), column, 1e-10);
    }
  }
}
