// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/output/folder_job.h"
#include "evaluate/mcl/mcl_report.h"
#include "evaluate/verbs.h"

namespace pcl6d::app {

int
runMcl(const std::vector<std::string>& arguments)
{
  MclSettings s;
  if (!parseMclSettings(arguments, s))
    return kDone;
  FolderJob job(s.quiet, s.without_effect, mclFolderRules(s));
  const std::optional<MclEvaluation> e = evaluateMcl(s, job.bar, job.interrupt);
  if (!e) {
    job.bar.warn("interrupted; nothing written");
    return kInterrupted;
  }
  printMcl(s, *e);
  bool is_drawn = true;
  if (job.out) {
    writeMclFiles(*job.out, s, *e);
    job.publish();
    is_drawn = drawMcl(job, *e);
  }
  flushOutput();
  return is_drawn && e->drive.numTrusted() == e->scans.size() ? kDone : kDoubtful;
}

} // namespace pcl6d::app
