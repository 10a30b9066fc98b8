// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/** \file How often a verdict on a map is false, counted over many runs whose truth is
 * known. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan of a map whose truth is known. */
struct TrustScan {
  std::string name; ///< its file
  /** [m] its position off the truth, relative to the first scan that is not named;
   * infinite if it has no true place in the map, as a scan of another scene */
  double error = 0;
  std::optional<double> bound; ///< [m] the error is stated to be below it with 95 %
  bool named = false;          ///< the run says that it is not to be trusted
  /** e' C^-1 e of the error e and its stated covariance C: 3 on average if C is right */
  std::optional<double> squared_error;
};

/** \brief What a run says of its map. */
enum class TrustCall {
  kGood,       ///< verified, and nothing is against it
  kUnverified, ///< nothing is against it, but it could not be verified
  kDoubted,    ///< doubtful or ambiguous
  kNone        ///< there is no map: the run failed, or took too long
};

/** \return "good", "unverified", "doubted" or "none" */
const char*
toString(TrustCall call);

/** \brief A run whose verdict is compared with the truth. \ingroup benchmarking */
struct TrustRun {
  std::string data;   ///< scene or recording
  std::string damage; ///< what was done to it; may be empty
  std::string method;
  std::string name; ///< of the run, such as its folder
  TrustCall call = TrustCall::kNone;
  /** doubted by how matching went, though verification is not against the map */
  bool doubted_by_matching = false;
  std::vector<TrustScan> scans; ///< empty: there is no truth, or no map
  std::string message;          ///< what the run says, or why it has no map
};

/** \return the error that is allowed [m]: 5 cm, or the bound of 99.9 % that belongs to that
 * of 95 % if this is more. Errors of a position are taken as normal, with three degrees of
 * freedom: the quantiles of chi square are 16.27 and 7.815 [m^2 per variance] */
double
allowedError(const TrustScan& scan);

/** \return whether a scan that is not named is off by more than is allowed */
bool
isWrong(const TrustRun& run);

/** \return whether all scans, named or not, are off by no more than is allowed */
bool
isRight(const TrustRun& run);

/** \return the largest error of the scans that are not named [m]; 0 if there are none */
double
largestUnnamedError(const TrustRun& run);

/** \brief How often something happened. */
struct TrustShare {
  std::size_t count = 0;
  std::size_t of = 0;

  /** \return count / of; 0 if it was never tried */
  double
  rate() const;

  /** \brief The largest probability that does not contradict the count: were it higher,
   * so few would be seen in less than 5 % of all trials.
   * \return in [0, 1]; 1 if it was never tried
   * \throws BadArgument there are more than were tried
   * \note Source: C. J. Clopper and E. S. Pearson, "The use of confidence or fiducial
   * limits illustrated in the case of the binomial", Biometrika 26(4), 1934; the bound is
   * one-sided. */
  double
  upperBound() const;
};

/** \brief Runs that belong together, counted. A run without scans counts in `runs` and in
 * one of `failed` and `without_truth` only. */
struct TrustCounts {
  std::string data;   ///< empty: all
  std::string damage; ///< empty: all
  std::string method; ///< empty: all
  std::size_t runs = 0;
  std::size_t failed = 0;        ///< no map
  std::size_t without_truth = 0; ///< a map, but nothing to compare it with
  std::size_t good = 0;          ///< called good
  std::size_t unverified = 0;    ///< called unverified
  std::size_t doubted = 0;
  std::size_t wrong = 0;       ///< isWrong()
  std::size_t right = 0;       ///< isRight(); the others name all scans that are off
  TrustShare false_goods;      ///< wrong maps called good, of those called good
  TrustShare missed;           ///< the same, of the wrong ones
  TrustShare false_unverified; ///< wrong maps called unverified, of those called so
  /** maps that verification has nothing against though a scan is off, of all it has nothing
   * against: those called good, and those that only matching doubts, where it is matching
   * that saves the verdict */
  TrustShare false_verifications;
  TrustShare false_doubts;     ///< right maps doubted, of the right ones
  std::size_t by_matching = 0; ///< of these: verification is not against them
};

/** \brief How stated bounds compare with errors, for bounds of about one size. */
struct BoundCounts {
  double above = 0;           ///< [m] bounds above this
  double up_to = 0;           ///< [m] and up to this; infinite for the last
  std::size_t scans = 0;      ///< that have such a bound
  std::size_t within = 0;     ///< off by no more than the bound of 95 %
  std::size_t within_999 = 0; ///< off by no more than that of 99.9 %
  double median_ratio = 0;    ///< median of error / bound; 0.55 if bounds are right
};

/** \brief Mean of e' C^-1 e / 3 over scans: 1 if covariances are right, more if they are
 * too small. */
struct SquaredErrors {
  std::size_t scans = 0;
  double mean = 0; ///< 0 without scans
};

/** \brief What many runs tell of the verdicts. \ingroup benchmarking */
struct TrustTable {
  TrustCounts all;
  std::vector<TrustCounts> by_damage; ///< in the order of their first runs
  std::vector<TrustCounts> by_data;
  std::vector<TrustCounts> by_method;
  std::vector<TrustCounts> cells; ///< data set by damage by method
  /** of the scans that maps called good do not name, but for those that have no true
   * place and the one that errors are relative to, which has none; empty sizes are left
   * out */
  std::vector<BoundCounts> bounds;
  /** of the same scans, but of maps that are not wrong: one that is would hide all others */
  SquaredErrors squared_errors;
};

/** \brief Counts runs. */
TrustTable
trustTable(const std::vector<TrustRun>& runs);

/** \brief For people: false goods, each with its run; totals; by damage, data set and
 * method; bounds; all cells. */
std::string
trustMarkdown(const std::vector<TrustRun>& runs);

/** \brief A line per run: what it was called, whether it was right or wrong, how far its
 * scans are off. Infinite errors are `inf`; texts are quoted as in RFC 4180. */
std::string
trustCsv(const std::vector<TrustRun>& runs);

/** \brief `{"schema_version": 1, "all": ..., "by_damage": [...], "by_data": [...],
 * "by_method": [...], "cells": [...], "bounds": [...], "squared_errors": ..., "runs":
 * [...]}`, the runs with their scans; null for what is missing or infinite. */
std::string
trustJson(const std::vector<TrustRun>& runs);

} // namespace pcl6d
