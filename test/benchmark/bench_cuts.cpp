// SPDX-License-Identifier: BSD-3-Clause
// Verdicts on finished runs of simulated data, and the constants of cuts fitted to all sensors except
// one (share/doc/trust.md). Poses and tests of single links stay as the runs recorded them.
// usage: bench_cuts SUITE_RESULTS ... [data=FOLDER RUN ...]
// SUITE_RESULTS: output folder of `pcl_slam6d_evaluate suite`. data: folder with the scans of the
// following runs of pcl_slam6d, in subfolders with the names of the runs.
#include "cut_fit.h"
#include "cut_runs.h"

#include <exception>
#include <iostream>
#include <iterator>

namespace pcl6d::bench {

namespace {
namespace fs = std::filesystem;

std::vector<CutRun>
readRuns(const std::vector<std::string>& arguments)
{
  const std::string knob = "data=";
  fs::path data;
  std::vector<CutRun> runs;
  for (const std::string& argument : arguments) {
    const fs::path folder = argument;
    if (argument.rfind(knob, 0) == 0)
      data = argument.substr(knob.size());
    else if (fs::exists(folder / "runs")) {
      std::vector<CutRun> of_suite = readSuiteRuns(folder);
      std::move(of_suite.begin(), of_suite.end(), std::back_inserter(runs));
    }
    else
      runs.push_back(readCutRun(folder, data / folder.filename()));
  }
  return runs;
}

/** Prints a false verdict with the scan that exceeds its allowed error by most. */
void
printFalse(const TrustRun& verdict)
{
  const TrustScan* worst = nullptr;
  const auto excess = [](const TrustScan& scan) {
    return scan.error / allowedError(scan);
  };
  for (const TrustScan& scan : verdict.scans)
    if (!scan.named && (!worst || excess(scan) > excess(*worst)))
      worst = &scan;
  std::cout << "- " << verdict.name << ": " << toString(verdict.call);
  if (worst)
    std::cout << ", " << worst->name << " off by " << worst->error << " m, allowed "
              << allowedError(*worst) << " m";
  std::cout << (verdict.message.empty() ? "" : ": ") << verdict.message << '\n';
}

/** Prints the verdicts of the runs that are false. */
void
printFalseVerdicts(const std::vector<CutRun>& runs)
{
  std::size_t differing = 0;
  for (const CutRun& run : runs) {
    const TrustRun verdict = recordedVerdict(run);
    const bool is_false_good = verdict.call == TrustCall::kGood && isWrong(verdict);
    if (is_false_good || (verdict.call == TrustCall::kDoubted && isRight(verdict)))
      printFalse(verdict);
    const CutVerdict again = verdictWith(verification::cutConstants(), run);
    if (again.is_missed)
      std::cout << "- " << run.name << ": a wrong place is connected\n";
    if (again.is_right_cut)
      std::cout << "- " << run.name << ": cut though right\n";
    if (again.map.call != verdict.call) {
      ++differing;
      std::cerr << run.name << ": recorded as " << toString(verdict.call)
                << ", the constants in use say otherwise\n";
    }
  }
  std::cout << runs.size() << " runs, " << differing
            << " recorded verdicts differ from the constants in use\n\n";
}

int
run(const std::vector<std::string>& arguments)
{
  const std::vector<CutRun> runs = readRuns(arguments);
  printFalseVerdicts(runs);
  CutFit fit(runs);
  printLeftOutSensors(fit, std::cout);
  std::cout << '\n';
  printLadders(fit, std::cout);
  return 0;
}
} // namespace

} // namespace pcl6d::bench

int
main(int argc, char** argv)
try {
  return pcl6d::bench::run({argv + 1, argv + argc});
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
