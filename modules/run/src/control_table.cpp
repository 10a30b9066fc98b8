// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/control_table.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <set>
#include <sstream>

namespace pcl6d {

namespace {
std::string
csvText(const std::string& text)
{
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string
millimetres(double metres)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(metres < 0.1 ? 1 : 0) << 1000 * metres
       << " mm";
  return text.str();
}

std::size_t
countTargets(const ControlResult& control, ControlUse use)
{
  return static_cast<std::size_t>(
      std::count_if(control.residuals.begin(),
                    control.residuals.end(),
                    [&](const ControlResidual& one) { return one.use == use; }));
}

std::size_t
countPoints(const ControlResult& control, ControlUse use)
{
  std::set<std::string> names;
  for (const ControlResidual& one : control.residuals)
    if (one.use == use)
      names.insert(one.name);
  return names.size();
}

/** "5 control points (12 targets): rms 1.9 mm, largest 3.1 mm" */
void
describePoints(const ControlResult& control,
               ControlUse use,
               const std::string& noun,
               std::ostream& text)
{
  if (const auto rms = control.rms(use))
    text << '\n'
         << text::counted(countPoints(control, use), noun) << " ("
         << text::counted(countTargets(control, use), "target") << "): rms "
         << millimetres(*rms) << ", largest " << millimetres(*control.largest(use));
}

/** Lists each rejected point once, with its scan if further targets of the point are used. */
void
describeBlunders(const RunResult& run, std::ostream& text)
{
  const ControlResult& control = *run.control;
  for (const std::string& name : control.rejected()) {
    const ControlResidual* worst = nullptr;
    bool is_whole = true;
    for (const ControlResidual& one : control.residuals) {
      if (one.name != name)
        continue;
      is_whole = is_whole && one.use != ControlUse::kControl;
      if (one.use == ControlUse::kRejected &&
          (!worst || one.residual.norm() > worst->residual.norm()))
        worst = &one;
    }
    text << "\nblunder: " << (is_whole ? "control point " : "target ") << name;
    if (!is_whole)
      text << " in " << run.scans.at(worst->scan).file;
    text << " is " << millimetres(worst->residual.norm())
         << " off, and does not count (test value " << std::fixed
         << std::setprecision(1) << worst->standardised << ", limit 3.3)";
  }
}

void
describeNames(const std::vector<std::string>& names,
              const std::string& words,
              std::ostream& text)
{
  for (std::size_t i = 0; i < names.size(); ++i)
    text << (i == 0 ? "\nnote: " + words : ", ") << names[i];
}
} // namespace

void
writeControlTable(const std::filesystem::path& path, const RunResult& run)
{
  writeFileAtomically(path, [&](std::ostream& stream) {
    stream << "name,scan,use,dx,dy,dz,length,standardised,detectable\n";
    for (const ControlResidual& one : run.control->residuals) {
      stream << csvText(one.name) << ',' << run.scans.at(one.scan).index << ','
             << toString(one.use) << std::fixed << std::setprecision(6);
      for (const double value :
           {one.residual.x(), one.residual.y(), one.residual.z(), one.residual.norm()})
        stream << ',' << value;
      stream << ',' << std::setprecision(3) << one.standardised << ',';
      if (std::isfinite(one.detectable))
        stream << std::setprecision(6) << one.detectable;
      stream << '\n';
    }
  });
}

std::string
controlWords(const RunResult& run)
{
  if (!run.control)
    return "";
  const ControlResult& control = *run.control;
  std::ostringstream text;
  if (!control.adjusted) {
    text << "\nNOT TO BE TRUSTED: not adjusted to the control points: "
         << control.reason << "; poses are in the frame of the initial ones";
    return text.str();
  }
  describePoints(control, ControlUse::kControl, "control point", text);
  if (countPoints(control, ControlUse::kCheck) > 0)
    describePoints(control, ControlUse::kCheck, "check point", text);
  describeBlunders(run, text);
  if (!control.doubt.empty())
    text << "\nNOT TO BE TRUSTED: " << control.doubt;
  describeNames(control.without_target, "control points without a target: ", text);
  describeNames(control.without_control, "targets without a control point: ", text);
  return text.str();
}

} // namespace pcl6d
