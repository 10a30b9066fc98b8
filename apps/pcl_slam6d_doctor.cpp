// SPDX-License-Identifier: BSD-3-Clause
// Two clouds in, what registration makes of them out: options, diagnosis, reports.
#include "common/app.h"
#include "common/progress_bar.h"
#include "doctor/doctor_settings.h"
#include "doctor/report/report.h"

#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/json_numbers.h>

#include <cstdio>
#include <ostream>

namespace {
using namespace pcl6d;

int
run(const std::vector<std::string>& arguments)
{
  app::DoctorSettings s;
  if (!app::parseDoctorSettings(arguments, s))
    return app::kDone;
  const app::Interrupt interrupt;
  app::ProgressBar bar(s.quiet);
  try {
    const app::Diagnosis diagnosis = app::diagnose(s, bar, interrupt);
    if (!s.html.empty())
      writeFileAtomically(
          s.html, [&](std::ostream& file) { file << app::htmlReport(diagnosis); });
    if (!s.json.empty())
      writeJson(s.json, app::jsonReport(diagnosis));
    std::fputs(app::textReport(diagnosis).c_str(), stdout);
    app::flushOutput();
    return diagnosis.isVerified() ? app::kDone : app::kDoubtful;
  } catch (const app::Interrupted&) {
    bar.say("interrupted; nothing is written");
    return app::kInterrupted;
  }
}
} // namespace

int
main(int argc, char** argv)
{
  return app::runMain(app::kDoctor, argc, argv, run);
}
