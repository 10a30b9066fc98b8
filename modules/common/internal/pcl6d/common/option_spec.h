// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/parameter.h>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/** \file Description of an option: name, unit, range, help, and variable. Each field of an
 * options struct is described once; command lines, config files, summaries, man pages and
 * reference pages are generated from the description. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief The purpose of an option, which determines how files store and later runs reuse the
 * value. */
enum class OptionRole {
  kMethod,    ///< method of computing poses or processing points; changes the result
  kInput,     ///< selection and reading of scans; changes the result, set for each run
  kInputFile, ///< as kInput, a file or folder: two runs compare the content
  kOutput,    ///< further files; changes no pose
  kSpeed,     ///< changes the run time, never the result
  kSession,   ///< of a single program call; not stored in files
  kLibrary    ///< a field for callers of the library, not an option of a program
};

/** \return whether the summary of a run holds the option */
bool
isInSummary(OptionRole role);
/** \return whether the result follows from the option */
bool
changesResult(OptionRole role);
/** \return whether resuming an interrupted run requires an equal value. The content of files
 * (kInputFile) is compared elsewhere. */
bool
mustStayAlike(OptionRole role);
/** \return whether a continuation of a finished run inherits the value */
bool
isTakenOver(OptionRole role);

/** \brief The pipeline step of an option. */
enum class OptionStage {
  kRead,
  kPreprocess,
  kMatching,
  kRecovery,
  kLoops,
  kRelaxation,
  kControl, ///< adjustment to control points
  kDynamic,
  kDeskew,
  kVerification,
  kWrite,
  kRun ///< the whole run
};

/** \return "read", "preprocess", ..., "run" */
const char*
toString(OptionStage stage);

/** \brief The range of an option's value. */
struct OptionRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool with_low = true, with_high = true; ///< the ends are among the numbers
  bool whole = false;                     ///< whole numbers alone
  std::string words;                      ///< for messages: "finite and > 0"

  bool
  holds(double value) const;
};

/** \brief Ranges shared by several options. */
OptionRange
finiteAbove0();
OptionRange
finiteFrom0();
OptionRange
above0();
OptionRange
from0();
OptionRange
from1();

/** \brief A word parsed by a function. */
struct OptionWordReader {
  std::function<void(const std::string&)> take; ///< \throws BadArgument unknown word
};

/** \brief The variable set by an option. */
using OptionVariable = std::variant<OptionWordReader,
                                    bool*,
                                    int*,
                                    unsigned int*,
                                    std::uint64_t*,
                                    double*,
                                    std::string*,
                                    std::filesystem::path*,
                                    std::vector<std::string>*,
                                    std::optional<int>*,
                                    std::optional<double>*>;

/** \brief An option and its variable. The setters return the option: a row of a table reads as
 * one sentence. */
struct OptionSpec {
  /** \param[in] name "output,o OUT_DIR": with optional short name and placeholder of the value
   * \param[in] place address of the variable, the key of the option */
  OptionSpec(const std::string& name, OptionVariable variable, const void* place);

  std::string name;       ///< "output"; of kLibrary, the name of the field
  std::string short_name; ///< "o"; empty: none
  std::string operand;    ///< placeholder of the value in --help: "OUT_DIR"
  std::string group;      ///< caption in --help
  std::string unit;       ///< "m"; empty: none
  std::string help;       ///< a sentence
  std::string usual;      ///< the default in words; empty: the variable's value
  std::string otherwise;  ///< in a summary, if not given and without default
  std::string derived;    ///< how the default value is derived from the scans
  std::string
      implied; ///< the word if the option is given without a value; empty: not allowed
  std::string field; ///< name of the variable in the library's messages
  OptionStage stage = OptionStage::kRun;
  OptionRole role = OptionRole::kMethod;
  OptionRange range;
  bool repeatable = false;        ///< may be given several times
  std::function<bool()> is_used;  ///< whether the option has an effect; empty: always
  std::string condition;          ///< condition of is_used: "of --loop-closing"
  Parameter* parameter = nullptr; ///< stores the value used by a run
  OptionVariable variable;
  const void* place;

  OptionSpec&
  withHelp(const std::string& text);
  /** \brief Unit and default: a length is derived from the scans unless given. */
  OptionSpec&
  derivedAs(const std::string& text, Parameter& value);
  OptionSpec&
  inUnit(const std::string& text);
  OptionSpec&
  within(const OptionRange& numbers);
  OptionSpec&
  as(OptionRole purpose);
  OptionSpec&
  calledField(const std::string& text);
  OptionSpec&
  withDefault(const std::string& word);
  OptionSpec&
  ifNotGiven(const std::string& word);
  OptionSpec&
  impliedWord(const std::string& word);
  OptionSpec&
  mayRepeat();
  /** \param[in] used whether the option counts \param[in] when "of the metric point" */
  OptionSpec&
  countsIf(std::function<bool()> used, const std::string& when);
  /** \brief Parses the word by another function, where plug-ins add words. */
  OptionSpec&
  readBy(std::function<void(const std::string&)> take);

  /** \throws BadArgument "field = value, but must be range" the variable is out of range */
  void
  check() const;
};

/** \brief Options with their variables, in the order of --help. The variables must outlive the
 * list. */
class OptionList {
public:
  /** \brief Sets the pipeline step of the options that follow. */
  void
  stage(OptionStage step);
  /** \brief Sets the caption of the options that follow. */
  void
  group(const std::string& caption);

  template <typename T>
  OptionSpec&
  add(const std::string& name, T& variable)
  {
    return addRow(OptionSpec(name, &variable, &variable));
  }

  /** \brief A choice by the library's names, for example "point". */
  template <typename Enum>
  OptionSpec&
  addChoice(const std::string& name,
            Enum& variable,
            Enum (*from_name)(const std::string&))
  {
    return addWord(name,
                   variable,
                   [&variable, from_name](const std::string& word) {
                     variable = from_name(word);
                   })
        .withDefault(toString(variable));
  }

  /** \brief A word that a function parses into a variable. */
  template <typename T>
  OptionSpec&
  addWord(const std::string& name,
          const T& variable,
          std::function<void(const std::string&)> take)
  {
    return addRow(OptionSpec(name, OptionWordReader{std::move(take)}, &variable));
  }

  /** \brief A field of the library that is not an option of any program. */
  template <typename T>
  OptionSpec&
  addField(const std::string& field, T& variable)
  {
    return add(field, variable).as(OptionRole::kLibrary);
  }

  /** \brief Adds an option from another list, with stage and group. */
  OptionSpec&
  append(const OptionSpec& option);
  /** \brief Adds the options of another list that belong to a stage. */
  void
  append(const OptionList& options, OptionStage step);

  const std::deque<OptionSpec>&
  rows() const
  {
    return rows_;
  }

  /** \return the option of a variable \throws std::logic_error the variable has no option */
  OptionSpec&
  of(const void* variable);
  const OptionSpec&
  of(const void* variable) const;

  /** \throws BadArgument the first variable out of range */
  void
  check() const;

private:
  OptionSpec&
  addRow(OptionSpec row);

  OptionStage stage_ = OptionStage::kRun;
  std::string group_;
  std::deque<OptionSpec> rows_; ///< add() hands out references
};

} // namespace pcl6d
