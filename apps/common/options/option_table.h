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

/** \brief Row of the option table: an option and its variable. Rules apply to the given
 * value, in the unit of the option; without a rule, any number but nan is accepted. */
class Option {
public:
  /** \brief Text of --help, with the unit: "[m] nearer points are dropped". */
  Option&
  help(const std::string& text);
  /** \brief Must be given; --help shows no default. */
  Option&
  required();
  /** \brief Values of the command line are added to the values of a config file. */
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
  /** \brief Value of an option given by its name alone: `--name`; another value stands
   * behind an equals sign: `--name=word`. */
  Option&
  implied(const std::string& word);
  /** \brief Word in the summary for an option without default if it is not given. */
  Option&
  otherwise(const std::string& word);

private:
  friend class OptionTable;
  using Value = boost::any;

  std::string name_;    ///< for boost: "output,o"
  std::string operand_; ///< how --help calls the value; empty: arg
  std::string help_;
  std::string usual_;     ///< the default in words; may be empty
  std::string otherwise_; ///< see otherwise()
  std::string implied_;   ///< see implied()
  bool required_ = false, composing_ = false, multitoken_ = false;
  std::string rule_;
  std::function<bool(double)> obeys_; ///< the rule; empty: any number
  std::function<boost::program_options::value_semantic*(const Option&)> semantic_;
  std::function<void(const Value&)> take_;        ///< sets the variable
  std::function<double(const Value&)> number_;    ///< for obeys_
  std::function<std::string(const Value&)> text_; ///< as in the summary
};

/** \brief An option as shown in the summary. */
struct OptionWord {
  std::string name;
  std::string value; ///< as given, or the default
  bool given;
};

/** \brief Options from a source beside the command line, with their values as text. */
struct BroughtOptions {
  std::string source;                                       ///< file, for messages
  std::vector<std::pair<std::string, std::string>> options; ///< names without dashes
};

/** \brief An option that has an effect only in some runs. */
struct ConditionalOption {
  std::string name;      ///< without dashes
  bool used;             ///< whether the option has an effect in this run
  std::string condition; ///< condition of the effect, such as "of the metric point"
};

/** \brief A number, or the word "auto": no number. */
struct AutoNumber {
  std::optional<double> number;
};

std::istream&
operator>>(std::istream& stream, AutoNumber& value);
std::ostream&
operator<<(std::ostream& stream, const AutoNumber& value);

/** \brief Options of a program; each row binds a name, a variable with the default, a
 * rule and a help text:
 * \code
 * table.group("Range gate");
 * table.addAuto("max-range", &s.max_range).help("[m] farther points are dropped");
 * table.add("output,o DIR", &s.out).required().help("folder to write");
 * \endcode
 * Read from the command line and, with `--config FILE`, from a file of `name = value`
 * lines; the command line wins. The name may be followed by a comma and the short name,
 * and by a blank and the operand shown in --help. A variable keeps its value, the
 * default, unless the option is given. */
class OptionTable {
public:
  /** \param[in] usage the lines above the options in --help */
  explicit OptionTable(const std::string& usage);

  /** \brief Begins a group of options, shown under its caption. */
  void
  group(const std::string& caption);

  /** \brief Adds a number, a text, or another type with stream operators. */
  template <typename T>
  Option&
  add(const std::string& name, T* variable)
  {
    return addTyped<T>(
        name, textOf(*variable), [variable](const T& value) { *variable = value; });
  }

  /** \brief Adds a switch, which inverts the variable. */
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

  /** \brief Adds a number that is parsed as another type than stored: -1 must not
   * become a large unsigned number. */
  template <typename Typed, typename T>
  Option&
  addAs(const std::string& name, T* variable)
  {
    return addTyped<Typed>(name, textOf(*variable), [variable](const Typed& value) {
      *variable = static_cast<T>(value);
    });
  }

  /** \brief A number, or auto. \param[in] unit of the option, in units of the variable */
  Option&
  addAuto(const std::string& name, std::optional<double>* variable, double unit = 1);

  /** \brief Adds a word parsed by a function. Its BadArgument becomes a UsageError that
   * names the option. \param[in] usual text of the default */
  Option&
  addWord(const std::string& name,
          const std::string& usual,
          std::function<void(const std::string&)> take);

  /** \brief Declares the next positional argument; it is required.
   * \param[in] name shown in errors, e.g. SCAN_DIR */
  void
  positional(const std::string& name, std::string* value);

  /** \brief Declares a list for the remaining positional arguments; at least one is
   * required. */
  void
  positionals(const std::string& name, std::vector<std::string>* values);

  /** \brief Lets the value of an option set further options, unless the command line or
   * the config file sets them. Each text is read as a single value and must obey the
   * rules of its option.
   * \param[in] options returns the further options for a value; its exceptions pass
   * through parse() */
  void
  bringOptions(const std::string& option,
               std::function<BroughtOptions(const std::string& value)> options);

  /** \brief Parses, checks the rules and sets the variables, in the order of the rows;
   * --help and --version print to stdout.
   * \return false: --help or --version was given, and the program is to end
   * \throws UsageError, boost::program_options::error the arguments break a rule; for a
   * config file the message tells file and line
   * \throws IoFailed an option set by bringOptions() breaks its rule */
  bool
  parse(const std::vector<std::string>& arguments);

  /** \brief As app::checkOptions(); the message also names the source of the option,
   * unless given on the command line. */
  void
  check(const std::function<void()>& check,
        const std::map<std::string, std::string>& words = {}) const;

  /** \return whether the user gave the option */
  bool
  given(const std::string& option) const;

  /** \return options with their given or default values */
  std::vector<OptionWord>
  words(const std::vector<std::string>& options) const;

  /** \return one sentence about given options without effect in this run; empty: every
   * given option counts */
  std::string
  withoutEffect(const std::vector<ConditionalOption>& options) const;

  /** \throws UsageError an option for folders is given, but the input is no folder */
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
      // for display; the variable has the default already
      value->default_value(T(), row.usual_);
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

  /** Source of an option that is not from the command line. */
  struct Place {
    std::string text; ///< "run.cfg: line 3"
    bool is_data;     ///< from data, not written by the user
  };
  /** Adds options not given so far. */
  void
  store(const boost::program_options::parsed_options& options, const Place& place);
  /** \throws UsageError, or IoFailed about data: the message, with the source of the option */
  [[noreturn]] void
  blame(const std::string& option, const std::string& message) const;
  bool
  answerQuestions() const;
  /** \throws UsageError a value is an empty text; IoFailed if it comes from data */
  void
  refuseEmptyTexts() const;
  void
  takeValues() const;

  std::string usage_;
  /** the last group is the general one, with --help, in parse() */
  std::deque<Group> groups_;
  boost::program_options::options_description hidden_;
  boost::program_options::positional_options_description positions_;
  std::vector<std::string> positional_names_;
  std::string bringing_option_; ///< see bringOptions()
  std::function<BroughtOptions(const std::string&)> brought_options_;
  /** source of each option not given on the command line */
  std::map<std::string, Place> places_;
  boost::program_options::variables_map values_;
};

/** \return the words with a separator between: "point|plane|gicp" */
std::string
joined(const std::vector<std::string>& words, const std::string& between = "|");

/** \throws UsageError the file of --output is an input, or was written by pcl_slam6d to
 * an input run; empty paths are ignored
 * \param[in] input name of the input in the message */
void
refuseInputs(const std::string& output,
             const std::vector<std::string>& inputs,
             const std::string& input = "an input",
             const std::string& option = "--output");

/** \throws UsageError two options name one file; empty paths are ignored */
void
refuseSameOutput(const std::string& option,
                 const std::string& output,
                 const std::string& other_option,
                 const std::string& other);

} // namespace pcl6d::app
