// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "common/options/reduction_options.h"
#include "evaluate/changes/changes_settings.h"
#include "evaluate/result_file.h"
#include "evaluate/verbs.h"

#include <pcl6d/moving_objects/run_changes.h>

namespace pcl6d::app {

namespace {
std::string
usageOfChanges()
{
  return std::string("usage: ") + kEvaluate +
         R"( changes RUN_A RUN_B [options]
Objects that appeared, vanished or moved between two runs of pcl_slam6d over one site,
and surfaces that lie nearer or farther. RUN_B is brought into the world of RUN_A first:
by the given poses if points and rays confirm the poses, else by place recognition.
Places seen by only one run are not compared. Definition of a change and confidence:
share/doc/changes.md.
Exit code 0: compared, with or without changes; 1: the runs do not overlap; 3: the runs
overlap, but their relative pose is doubtful: no changes are reported.
)";
}

void
addOptions(OptionTable& table, ChangesSettings& s)
{
  table.positional("RUN_A", &s.run_a);
  table.positional("RUN_B", &s.run_b);
  table.group("World");
  table.add("given", &s.given)
      .help("the poses of both runs are exact and in one frame: keep the given poses");
  table.group("Range gate and reduction; auto: values of the runs, the coarser voxel");
  addReductionOptions(table, s.parameters);
  table.group("Changes");
  table.add("least-size", &s.least_size)
      .help("voxels: smaller objects are not reported; > 0");
  table.add("min-confidence", &s.min_confidence)
      .help("least confidence of a reported change; in [0, 1)");
  table.addAs<int>("rows", &s.rows)
      .within(0, kNoBound, ">= 0")
      .help("number of changes listed, the largest of each kind first");
  table.group("Run");
  table.add("output,o OUT_DIR", &s.out)
      .help("folder for changes.json, changes.ply (grey: unchanged; green: appeared; "
            "red: vanished; blue: moved; orange: surfaces) and changes.png; made if "
            "missing");
  table.add("json FILE", &s.json).help("write only changes.json, to FILE");
  table.addAs<int>("threads", &s.num_threads)
      .within(0, 1024, "in [0, 1024]")
      .help("0: a thread per core; never changes the result");
  table.add("force", &s.force).help("write into a folder that is not empty");
  table.add("quiet", &s.quiet).help("print the changes, warnings and errors only");
}
} // namespace

bool
parseChangesSettings(const std::vector<std::string>& arguments, ChangesSettings& s)
{
  OptionTable table(usageOfChanges());
  addOptions(table, s);
  if (!table.parse(arguments))
    return false;
  requireResultFile("--json", s.json, {".json"});
  refuseInputs(s.json, {s.run_a, s.run_b}, "an input", "--json");
  table.check([&] {
    s.parameters.validate();
    RunChangesOptions options;
    options.min_confidence = s.min_confidence;
    options.least_size = s.least_size;
    options.validate();
  });
  s.without_effect = table.withoutEffect({{"force", !s.out.empty(), "with --output"}});
  return true;
}

} // namespace pcl6d::app
