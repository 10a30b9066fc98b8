// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/interrupt.h"
#include "evaluate/mcl_report.h"
#include "evaluate/verbs.h"

#include <pcl6d/common/error.h>

#include <cstdio>

namespace pcl6d::app {

namespace {
void
writeFiles(OutputFolder& out,
           const MclSettings& s,
           const MclEvaluation& e,
           ProgressBar& bar)
{
  writeMclFiles(out, s, e);
  drawMcl(out, e, bar);
  const auto written = out.publish();
  if (s.quiet)
    return;
  for (const auto& path : written)
    std::printf("  %s\n", path.c_str());
}
} // namespace

int
runMcl(const std::vector<std::string>& arguments)
{
  MclSettings s;
  if (!parseMclSettings(arguments, s))
    return kDone;
  const Interrupt interrupt;
  ProgressBar bar(s.quiet);
  if (!s.without_effect.empty())
    bar.warn(s.without_effect);
  std::optional<OutputFolder> out;
  if (!s.out.empty())
    out.emplace(mclFolderRules(s));
  const std::optional<MclEvaluation> e = evaluateMcl(s, bar, interrupt);
  if (!e) {
    bar.warn("interrupted; nothing written");
    return kInterrupted;
  }
  printMcl(s, *e);
  if (out)
    writeFiles(*out, s, *e, bar);
  if (std::fflush(stdout) != 0)
    throw IoFailed("cannot write to the standard output");
  return e->numTrusted() == e->scans.size() ? kDone : kDoubtful;
}

} // namespace pcl6d::app
