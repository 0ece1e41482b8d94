#pragma once

#include <deal.II/base/patterns.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// An entry of section Contact that a law is made of.
  struct LawParameter
  {
    std::string name, default_value, help;
    std::shared_ptr<const dealii::Patterns::PatternBase> pattern;
    /// of a file with a curve: its columns; empty: the entry is a number
    std::string abscissa, ordinate;

    bool is_curve() const { return !abscissa.empty(); }
  };

  /// What a law is, and what makes the same law again: its name and the numbers of its parameters in their order,
  /// of a curve all its points (x_0, y_0, x_1, y_1, ...).
  struct LawDescription
  {
    std::string name;
    std::vector<double> numbers;
  };

  /// @throws InputError if a law of these parameters cannot be made of so many numbers
  void check_numbers(const std::string &law, const std::vector<LawParameter> &parameters,
                     std::size_t n_numbers);

  /// A number of Contact, or the file of a curve, as the entry stands.
  LawParameter law_number(const std::string &name, const std::string &default_value, const std::string &help,
                          double smallest, double largest);
  LawParameter law_curve(const std::string &name, const std::string &abscissa, const std::string &ordinate,
                         const std::string &help);

  /// Entries of laws by name, and the points of their curves once the files are read.
  class LawValues
  {
  public:
    void set(const std::string &name, const std::string &value) { texts[name] = value; }
    void set(const std::string &name, double value);
    double number(const std::string &name) const;
    /// Bound to an entry of the parameter file.
    std::string &text(const LawParameter &parameter);

    /// Reads the files of a law's curves. Collective. @throws InputError with entry, file and line
    void read_curves(const std::vector<LawParameter> &parameters);
    /// @param given numbers in place of entries
    /// @throws InputError if the law needs a curve that is not given
    std::vector<double> numbers(const std::vector<LawParameter> &parameters,
                                const std::map<std::string, double> &given = {}) const;

  private:
    std::map<std::string, std::string> texts;
    std::map<std::string, std::vector<double>> curves;
  };
} // namespace vibrocontact
