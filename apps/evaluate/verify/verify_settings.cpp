// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "common/options/reduction_options.h"
#include "evaluate/verbs.h"
#include "evaluate/verify/verify_settings.h"

namespace pcl6d::app {

namespace {
std::string
usageOfVerify()
{
  return std::string("usage: ") + kEvaluate +
         R"( verify RUN|SCAN_DIR|SCAN_A SCAN_B [options]
Verifies a map (of a run, or of a folder with --poses FILE), or the pose of a scan
relative to another scan (--pose), by the points and the rays of the scans alone, for
poses of any program. Points in places that rays of another scan pass through contradict
the map, and so do surfaces that fit only after a shift.
Meaning of the words: share/doc/trust.md.
Exit code 0: good, or unverified with a warning; 3: doubtful, or too little overlap to
decide.
)";
}

void
addInput(OptionTable& table, VerifySettings& s)
{
  table.positionals("INPUT", &s.inputs);
  table.group("Input");
  table.add("poses FILE", &s.poses)
      .help("of a folder: poses in place of the given poses, KITTI or TUM rows, .g2o, "
            "or a folder of .frames or .pose files (3DTK); a pose for each scan, or "
            "for each selected scan");
  table.add("pose \"X Y Z R P Y\"|FILE", &s.pose)
      .help("of two scans: pose of B in the frame of A, [m] and roll pitch yaw [deg]; "
            "a file may hold a matrix (12 or 16 numbers, row by row) instead; by "
            "default from the poses of the files");
  table.add("format", &s.scans.format, scanFormatFromName)
      .help("auto|pcd|ply|uos|kitti|xyz|las|laz");
  table.add("first", &s.scans.first).help("index of the first scan of a folder");
  table.add("last", &s.scans.last).help("index of the last scan of a folder");
  table.add("every", &s.scans.every).help("take each n-th scan of a folder");
}

void
addRest(OptionTable& table, VerifySettings& s)
{
  table.group("Range gate and reduction; auto: values of the run, else of pcl_slam6d");
  addReductionOptions(table, s.parameters);
  table.group("Run");
  table.addAs<int>("rows", &s.rows)
      .within(0, kNoBound, ">= 0")
      .help("number of links listed, the most doubtful first");
  table.add("output,o OUT_DIR", &s.out)
      .help(
          "folder for verification.csv (a row per link), verification.json, "
          "contradictions.ply (the contradicted points; red: of contradicted patches) "
          "and contradictions.png; made if missing");
  table.addAs<int>("threads", &s.num_threads)
      .within(0, 1024, "in [0, 1024]")
      .help("0: a thread per core; never changes the result");
  table.add("force", &s.force).help("write into a folder that is not empty");
  table.add("quiet", &s.quiet).help("print the verdict, warnings and errors only");
}
} // namespace

bool
parseVerifySettings(const std::vector<std::string>& arguments, VerifySettings& s)
{
  OptionTable table(usageOfVerify());
  addInput(table, s);
  addRest(table, s);
  if (!table.parse(arguments))
    return false;
  if (s.inputs.size() > 2)
    throw UsageError(std::to_string(s.inputs.size()) +
                     " inputs, but must be a folder or two scans");
  for (const char* const option : {"poses", "first", "last", "every"})
    if (s.isPair() && table.given(option))
      throw UsageError(std::string("--") + option +
                       " is for a folder of scans, not for two scans");
  if (!s.isPair() && table.given("pose"))
    throw UsageError("--pose is for two scans; poses of a folder: --poses FILE");
  table.check([&] {
    s.scans.validate();
    s.parameters.validate();
  });
  s.without_effect = table.withoutEffect({{"force", !s.out.empty(), "with --output"}});
  return true;
}

} // namespace pcl6d::app
