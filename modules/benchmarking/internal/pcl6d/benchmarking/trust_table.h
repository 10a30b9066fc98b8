// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/** \file Rates of false verdicts on maps, counted over many runs with ground truth. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan of a map with ground truth. */
struct TrustScan {
  std::string name; ///< its file
  /** [m] distance of its position from the truth, relative to the first scan that is
   * not named; infinite for a scan outside the map, such as a scan of another scene */
  double error = 0;
  std::optional<double> bound; ///< [m] stated upper bound of the error (95 %)
  bool named = false;          ///< the run reports the scan as unreliable
  /** e' C^-1 e of the error e and its stated covariance C: 3 on average if C is right */
  std::optional<double> squared_error;
};

/** \brief Verdict of a run on its map. */
enum class TrustCall {
  kGood,       ///< verified, without contradiction
  kUnverified, ///< without contradiction, but verification was not possible
  kDoubted,    ///< doubtful or ambiguous
  kNone        ///< no map: the run failed, or took too long
};

/** \return "good", "unverified", "doubted" or "none" */
const char*
toString(TrustCall call);

/** \brief A run with the verdict to compare with the truth. \ingroup benchmarking */
struct TrustRun {
  std::string data;   ///< scene or recording
  std::string damage; ///< kind of damage to the data; may be empty
  std::string method;
  std::string name; ///< of the run; the programs take its folder
  TrustCall call = TrustCall::kNone;
  /** doubted by how matching went, though verification is not against the map */
  bool doubted_by_matching = false;
  std::vector<TrustScan> scans; ///< empty: no truth, or no map
  std::string message;          ///< message of the run, or the reason for a missing map
};

/** \return the allowed error [m]: 5 cm, or the 99.9 % bound derived from the 95 % bound
 * if larger. Position errors are assumed normal, with three degrees of freedom: the
 * quantiles of chi square are 16.27 and 7.815 [m^2 per variance] */
double
allowedError(const TrustScan& scan);

/** \return whether a scan that is not named exceeds its allowed error */
bool
isWrong(const TrustRun& run);

/** \return whether every scan, named or not, is within its allowed error */
bool
isRight(const TrustRun& run);

/** \return the largest error of the scans that are not named [m]; 0 without scans */
double
largestUnnamedError(const TrustRun& run);

/** \brief Relative frequency of an event. */
struct TrustShare {
  std::size_t count = 0;
  std::size_t of = 0;

  /** \return count / of; 0 without trials */
  double
  rate() const;

  /** \brief Upper confidence limit (95 %) of the probability: above the limit, a count
   * as low as the given count has a probability below 5 %.
   * \return in [0, 1]; 1 without trials
   * \throws BadArgument count exceeds of
   * \note Source: C. J. Clopper and E. S. Pearson, "The use of confidence or fiducial
   * limits illustrated in the case of the binomial", Biometrika 26(4), 1934; the bound
   * is one-sided. */
  double
  upperBound() const;
};

/** \brief Counts over a group of runs. A run without scans counts only in `runs` and in
 * one of `failed` and `without_truth`. */
struct TrustCounts {
  std::string data;   ///< empty: all
  std::string damage; ///< empty: all
  std::string method; ///< empty: all
  std::size_t runs = 0;
  std::size_t failed = 0;        ///< no map
  std::size_t without_truth = 0; ///< a map, but no ground truth
  std::size_t good = 0;          ///< called good
  std::size_t unverified = 0;    ///< called unverified
  std::size_t doubted = 0;
  std::size_t wrong = 0;  ///< isWrong()
  std::size_t right = 0;  ///< isRight(); the remaining runs name each wrong scan
  TrustShare false_goods; ///< wrong maps called good, among maps called good
  TrustShare missed;      ///< wrong maps called good, among wrong maps
  /** wrong maps called unverified, among maps called unverified */
  TrustShare false_unverified;
  /** maps with a wrong scan, among maps not contradicted by verification: maps called
   * good, and maps doubted only by matching */
  TrustShare false_verifications;
  TrustShare false_doubts;     ///< right maps doubted, among right maps
  std::size_t by_matching = 0; ///< of false_doubts: not contradicted by verification
};

/** \brief Stated bounds compared with errors, for bounds of similar size. */
struct BoundCounts {
  double above = 0;           ///< [m] bounds above this
  double up_to = 0;           ///< [m] upper limit, inclusive; infinite for the last row
  std::size_t scans = 0;      ///< number of scans with a bound in the range
  std::size_t within = 0;     ///< off by no more than the bound of 95 %
  std::size_t within_999 = 0; ///< error within the 99.9 % bound
  double median_ratio = 0;    ///< median of error / bound; 0.55 if bounds are right
};

/** \brief Mean of e' C^-1 e / 3 over scans: 1 for correct covariances, larger if the
 * covariances are too small. */
struct SquaredErrors {
  std::size_t scans = 0;
  double mean = 0; ///< 0 without scans
};

/** \brief Reliability of the verdicts over many runs. \ingroup benchmarking */
struct TrustTable {
  TrustCounts all;
  std::vector<TrustCounts> by_damage; ///< in the order of their first runs
  std::vector<TrustCounts> by_data;
  std::vector<TrustCounts> by_method;
  std::vector<TrustCounts> cells; ///< data set by damage by method
  /** over scans not named by maps called good, without scans outside the map and
   * without the origin scan of the errors; empty ranges are left out */
  std::vector<BoundCounts> bounds;
  /** over the scans of `bounds`, but only of maps that are not wrong: a single wrong
   * map would dominate the mean */
  SquaredErrors squared_errors;
};

/** \brief Counts runs. */
TrustTable
trustTable(const std::vector<TrustRun>& runs);

/** \brief Markdown for readers: false goods, each with its run; totals; by damage, data
 * set and method; bounds; every cell. */
std::string
trustMarkdown(const std::vector<TrustRun>& runs);

/** \brief A line per run: verdict, whether right or wrong, errors of its scans.
 * Infinite errors are `inf`; texts are quoted as in RFC 4180. */
std::string
trustCsv(const std::vector<TrustRun>& runs);

/** \brief `{"schema_version": 1, "all": ..., "by_damage": [...], "by_data": [...],
 * "by_method": [...], "cells": [...], "bounds": [...], "squared_errors": ..., "runs":
 * [...]}`, the runs with their scans; null for missing or infinite values. */
std::string
trustJson(const std::vector<TrustRun>& runs);

} // namespace pcl6d
