// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options.hpp>

#include <deque>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pcl6d::app {

constexpr double kNoBound = std::numeric_limits<double>::infinity();
constexpr double kFinite = std::numeric_limits<double>::max(); ///< the largest one

/** \brief A row of the table: an option and the variable that it sets. Rules count for what
 * the user gives, in the unit of the option; without one, any number will do, but nan. */
class Option {
public:
  /** \brief What --help says, with the unit: "[m] nearer points are dropped". */
  Option&
  help(const std::string& text);
  /** \brief Must be given; --help shows no default. */
  Option&
  required();
  /** \brief The values of the command line come on top of those of a config file. */
  Option&
  composing();
  /** \brief Several values may follow the name. */
  Option&
  multitoken();
  /** \brief The value must be in [low, high]. \param[in] rule in words: "0 to 1024" */
  Option&
  within(double low, double high, const std::string& rule);
  /** \brief The value must be in (low, high]. */
  Option&
  above(double low, const std::string& rule, double high = kNoBound);
  /** \brief The value of a word that is given without one: `--name`; another one stands behind
   * an equals sign: `--name=word`. */
  Option&
  implied(const std::string& word);
  /** \brief The word of the summary for an option without default that is not given. */
  Option&
  otherwise(const std::string& word);

private:
  friend class OptionTable;
  using Value = boost::any;

  std::string name_;    ///< for boost: "output,o"
  std::string operand_; ///< how --help calls the value; empty: arg
  std::string help_;
  std::string usual_;     ///< the default in words; empty: none
  std::string otherwise_; ///< see otherwise()
  std::string implied_;   ///< see implied()
  bool required_ = false, composing_ = false, multitoken_ = false;
  std::string rule_;
  std::function<bool(double)> obeys_; ///< the rule; empty: there is none
  std::function<boost::program_options::value_semantic*(const Option&)> semantic_;
  std::function<void(const Value&)> take_;        ///< sets the variable
  std::function<double(const Value&)> number_;    ///< for obeys_
  std::function<std::string(const Value&)> text_; ///< as in the summary
};

/** \brief An option as it goes into the summary. */
struct OptionWord {
  std::string name;
  std::string value; ///< as given, or as it is by default
  bool given;
};

/** \brief Options that do not come from the command line, with their values as text. */
struct BroughtOptions {
  std::string source;                                       ///< file, for messages
  std::vector<std::pair<std::string, std::string>> options; ///< names without dashes
};

/** \brief An option that counts only in some runs. */
struct ConditionalOption {
  std::string name;      ///< without dashes
  bool used;             ///< whether it counts in this run
  std::string condition; ///< when it counts, such as "of the metric point"
};

/** \brief A number, or the word "auto": no number. */
struct AutoNumber {
  std::optional<double> number;
};

std::istream&
operator>>(std::istream& stream, AutoNumber& value);
std::ostream&
operator<<(std::ostream& stream, const AutoNumber& value);

/** \brief The options of a program, each in a row that binds its name, its variable with
 * the default, its rule and its help:
 * \code
 * table.group("Range gate");
 * table.addAuto("max-range", &s.max_range).help("[m] farther points are dropped");
 * table.add("output,o DIR", &s.out).required().help("folder to write");
 * \endcode
 * Read from the command line and, with `--config FILE`, from a file of `name = value`
 * lines; the command line wins. The name may be followed by a comma and the short name, and
 * by a blank and what --help calls the value. The variable holds the default and keeps it
 * unless the option is given. */
class OptionTable {
public:
  /** \param[in] usage the lines above the options in --help */
  explicit OptionTable(const std::string& usage);

  /** \brief Begins a group of options, shown under its caption. */
  void
  group(const std::string& caption);

  /** \brief A number, text or anything else that streams read and write. */
  template <typename T>
  Option&
  add(const std::string& name, T* variable)
  {
    return addTyped<T>(
        name, textOf(*variable), [variable](const T& value) { *variable = value; });
  }

  /** \brief A switch, which turns the variable to the other value than it has. */
  Option&
  add(const std::string& name, bool* variable);

  Option&
  add(const std::string& name, std::filesystem::path* variable);

  /** \brief A value without default. */
  template <typename T>
  Option&
  add(const std::string& name, std::optional<T>* variable)
  {
    return addTyped<T>(name, "", [variable](const T& value) { *variable = value; });
  }

  /** \brief A choice by the names of the library, such as "point". */
  template <typename Enum>
  Option&
  add(const std::string& name, Enum* variable, Enum (*fromName)(const std::string&))
  {
    return add(name, variable, fromName, toString(*variable));
  }
  template <typename T>
  Option&
  add(const std::string& name,
      T* variable,
      T (*fromName)(const std::string&),
      const std::string& usual)
  {
    return addWord(
        name, usual, [=](const std::string& word) { *variable = fromName(word); });
  }

  /** \brief A choice among words. */
  template <typename T>
  Option&
  add(const std::string& name,
      T* variable,
      std::initializer_list<std::pair<const char*, T>> choices)
  {
    const std::vector<std::pair<const char*, T>> all = choices;
    std::string usual;
    std::vector<std::string> words;
    for (const auto& [word, value] : all) {
      words.emplace_back(word);
      if (value == *variable)
        usual = word;
    }
    return addWord(name, usual, [=](const std::string& word) {
      *variable = all[placeOf(word, words)].second;
    });
  }

  /** \brief A number that is kept in another type than it is typed in: unsigned ones must
   * not turn -1 into a large number. */
  template <typename Typed, typename T>
  Option&
  addAs(const std::string& name, T* variable)
  {
    return addTyped<Typed>(name, textOf(*variable), [variable](const Typed& value) {
      *variable = static_cast<T>(value);
    });
  }

  /** \brief A number, or auto. \param[in] unit of the option in that of the variable */
  Option&
  addAuto(const std::string& name, std::optional<double>* variable, double unit = 1);

  /** \brief A word that a function understands. Its BadArgument becomes a UsageError that
   * names the option. \param[in] usual the default, as shown */
  Option&
  addWord(const std::string& name,
          const std::string& usual,
          std::function<void(const std::string&)> take);

  /** \brief Declares the next positional argument; it is required.
   * \param[in] name as shown in errors, e.g. SCAN_DIR */
  void
  positional(const std::string& name, std::string* value);

  /** \brief Declares that all further positional arguments belong together; at least one
   * is required. */
  void
  positionals(const std::string& name, std::vector<std::string>* values);

  /** \brief Lets the value of an option bring others, which count where neither the
   * command line nor the config file gives them. Each value is read as one, whatever its
   * text holds, and obeys the rules of its option.
   * \param[in] options for a value of the option; what this throws goes through parse() */
  void
  bringOptions(const std::string& option,
               std::function<BroughtOptions(const std::string& value)> options);

  /** \brief Parses, checks the rules and sets the variables, in the order of the rows; on
   * --help or --version prints it to stdout.
   * \return false when the program has nothing more to do
   * \throws UsageError, boost::program_options::error the arguments break a rule; what came
   * from a config file is told with file and line
   * \throws IoFailed an option that was brought breaks its rule */
  bool
  parse(const std::vector<std::string>& arguments);

  /** \brief As app::checkOptions(), and the message names the file that the option came
   * from, if it was not the command line. */
  void
  check(const std::function<void()>& check,
        const std::map<std::string, std::string>& words = {}) const;

  /** \return whether the user gave the option (so it is no default) */
  bool
  given(const std::string& option) const;

  /** \return options as given, or as they are by default */
  std::vector<OptionWord>
  words(const std::vector<std::string>& options) const;

  /** \return one sentence about the options that the user gave though they are not used
   * in this run; empty if there are none */
  std::string
  withoutEffect(const std::vector<ConditionalOption>& options) const;

  /** \throws UsageError an option that needs a folder is given, but the input is none */
  void
  needFolder(const std::string& input, const std::vector<std::string>& options) const;

private:
  struct Group {
    std::string caption;
    std::deque<Option> rows; ///< add() hands out references
  };

  template <typename T>
  static std::string
  textOf(const T& value)
  {
    std::ostringstream text;
    text << value;
    return text.str();
  }
  template <typename T>
  static std::string
  textOf(const std::vector<T>& values)
  {
    std::string text;
    for (const T& value : values)
      text += (text.empty() ? "" : " ") + textOf(value);
    return text;
  }

  template <typename T>
  static boost::program_options::value_semantic*
  semanticOf(const Option& row)
  {
    auto* value = boost::program_options::value<T>();
    if (!row.operand_.empty())
      value->value_name(row.operand_);
    if (row.required_)
      value->required();
    else if (!row.usual_.empty())
      value->default_value(T(), row.usual_); // shown only, the variable has it
    if constexpr (std::is_same_v<T, std::string>)
      if (!row.implied_.empty())
        value->implicit_value(row.implied_);
    if (row.composing_)
      value->composing();
    if (row.multitoken_)
      value->multitoken();
    return value;
  }

  template <typename T>
  Option&
  addTyped(const std::string& name,
           const std::string& usual,
           std::function<void(const T&)> take)
  {
    Option& row = addRow(name, usual);
    row.semantic_ = semanticOf<T>;
    row.take_ = [take](const boost::any& v) { take(boost::any_cast<const T&>(v)); };
    row.text_ = [](const boost::any& v) {
      return textOf(boost::any_cast<const T&>(v));
    };
    if constexpr (std::is_arithmetic_v<T>)
      row.number_ = [](const boost::any& v) {
        return static_cast<double>(boost::any_cast<const T&>(v));
      };
    return row;
  }

  Option&
  addRow(const std::string& name, const std::string& usual);
  static std::size_t
  placeOf(const std::string& word, const std::vector<std::string>& words);
  static boost::program_options::options_description
  describe(const Group& group);
  const Option&
  row(const std::string& option) const;
  void
  readArguments(const std::vector<std::string>& arguments);
  boost::program_options::options_description
  describeAll() const;
  void
  readConfig(const std::string& file);
  void
  readBrought(const BroughtOptions& brought);

  /** Where an option that is not of the command line stands. */
  struct Place {
    std::string text; ///< "run.cfg: line 3"
    bool is_data;     ///< the user did not write it
  };
  /** Takes options that are not given yet. */
  void
  store(const boost::program_options::parsed_options& options, const Place& place);
  /** \throws UsageError, or IoFailed about data: the message, with the option's place */
  [[noreturn]] void
  blame(const std::string& option, const std::string& message) const;
  bool
  answerQuestions() const;
  /** \throws UsageError, or IoFailed about data: one of the values so far is an empty text */
  void
  refuseEmptyTexts() const;
  void
  takeValues() const;

  std::string usage_;
  std::deque<Group> groups_; ///< the last one is that of --help, in parse()
  boost::program_options::options_description hidden_;
  boost::program_options::positional_options_description positions_;
  std::vector<std::string> positional_names_;
  std::string bringing_option_; ///< see bringOptions()
  std::function<BroughtOptions(const std::string&)> brought_options_;
  std::map<std::string, Place> places_; ///< of options that are not of the command line
  boost::program_options::variables_map values_;
};

/** \return words with something between: "point|plane|gicp" */
std::string
joined(const std::vector<std::string>& words, const std::string& between = "|");

/** \throws UsageError the file of --output is an input, or one that pcl_slam6d wrote to a
 * run that is one; empty paths are none
 * \param[in] input what the message calls it */
void
refuseInputs(const std::string& output,
             const std::vector<std::string>& inputs,
             const std::string& input = "an input",
             const std::string& option = "--output");

/** \throws UsageError two options name one file; an empty path names none */
void
refuseSameOutput(const std::string& option,
                 const std::string& output,
                 const std::string& other_option,
                 const std::string& other);

} // namespace pcl6d::app
