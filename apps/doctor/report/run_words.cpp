// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/report/run_words.h"

namespace pcl6d::app {

std::string
endWords(const ClassOutcome& out)
{
  const std::string said = (out.stage.empty() ? "" : ", in " + out.stage) +
                           (out.said.empty() ? "" : ", after \"" + out.said + "\"");
  switch (out.end) {
  case RunEnd::kThrew:
    return "threw: " + out.words + said;
  case RunEnd::kCrashed:
    return "crashed: " + out.words + said;
  case RunEnd::kTimeOut:
    return "was ended at the time limit" + said;
  case RunEnd::kInterrupted:
    return "was interrupted";
  case RunEnd::kDone:
    break;
  }
  return "done";
}

std::string
briefWords(const ClassOutcome& out)
{
  if (out.end != RunEnd::kDone)
    return saidShortly(out);
  std::string words = out.converged ? "converged" : "not converged";
  if (!out.state.empty())
    words += " (" + out.state + ")";
  return out.is_rigid ? words : words + " without a rigid motion";
}

std::string
saidShortly(const ClassOutcome& out)
{
  switch (out.end) {
  case RunEnd::kThrew:
    return "threw";
  case RunEnd::kCrashed:
    return "crashed";
  case RunEnd::kTimeOut:
    return "time limit";
  case RunEnd::kInterrupted:
    return "interrupted";
  case RunEnd::kDone:
    break;
  }
  const std::string said = out.converged ? "converged" : "not converged";
  return out.is_rigid ? said : said + ", NaN";
}

} // namespace pcl6d::app
