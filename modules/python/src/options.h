// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>

#include <pybind11/pybind11.h>
#include <string>
#include <vector>

namespace pcl6d::python {

namespace py = pybind11;

/** \return a value of Python converted to a C++ type \throws BadArgument another type */
template <typename Value>
Value
valueOf(const py::handle& value, const std::string& name, const char* rule)
{
  try {
    if (!py::isinstance<py::bool_>(value) || std::is_same_v<Value, bool>)
      return py::cast<Value>(value);
  } catch (const py::cast_error&) {
  } catch (py::error_already_set& error) { // of a sequence without a length
    if (!error.matches(PyExc_TypeError))
      throw;
  }
  throw BadArgument(name + " = " + std::string(py::repr(value)) + ", but must be " +
                    rule);
}

/** \brief Keyword arguments of a function, taken in turn. */
class Options {
public:
  explicit Options(const py::dict& values) : values_(values) {}

  /** \brief Sets a variable if the option is given and not None.
   * \param[in] rule for messages: "a number" \throws BadArgument another type */
  template <typename Value, typename Variable>
  void
  take(const char* name, const char* rule, Variable& variable)
  {
    known_.emplace_back(name);
    if (values_.contains(name) && !values_[name].is_none())
      variable = valueOf<Value>(values_[name], name, rule);
  }
  template <typename Variable>
  void
  number(const char* name, Variable& variable)
  {
    take<double>(name, "a number", variable);
  }
  /** \brief take() for whole numbers from 0. */
  template <typename Variable>
  void
  count(const char* name, Variable& variable)
  {
    take<unsigned int>(name, "a whole number >= 0", variable);
  }
  /** \brief take() for a word parsed by a function of the library. */
  template <typename Variable>
  void
  word(const char* name, Variable& variable, Variable (*from_name)(const std::string&))
  {
    std::string text;
    take<std::string>(name, "a word", text);
    if (!text.empty())
      variable = from_name(text);
  }

  /** \throws BadArgument an option was given but never taken */
  void
  requireKnown() const;

private:
  py::dict values_;
  std::vector<std::string> known_;
};

} // namespace pcl6d::python
