#include <vibrocontact/base/csv_table.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/laws/law_parameter.h>

#include <cstdlib>
#include <sstream>

namespace vibrocontact
{
  LawParameter law_number(const std::string &name, const std::string &default_value, const std::string &help,
                          const double smallest, const double largest)
  {
    return {name, default_value,
            help, std::make_shared<const dealii::Patterns::Double>(smallest, largest),
            "",   ""};
  }

  LawParameter law_curve(const std::string &name, const std::string &abscissa, const std::string &ordinate,
                         const std::string &help)
  {
    return {name,
            "",
            help + " CSV: " + abscissa + ", " + ordinate + ". Units: those of its columns.",
            std::make_shared<const dealii::Patterns::FileName>(),
            abscissa,
            ordinate};
  }

  void check_numbers(const std::string &law, const std::vector<LawParameter> &parameters,
                     const std::size_t n_numbers)
  {
    std::size_t n_expected = parameters.size();
    bool has_curve = false;
    for (const LawParameter &parameter : parameters)
      if (parameter.is_curve())
      {
        has_curve = true;
        --n_expected;
      }
    if (has_curve ? n_numbers < n_expected || (n_numbers - n_expected) % 2 != 0 : n_numbers != n_expected)
      throw InputError("The contact law \"" + law + "\" is given " + std::to_string(n_numbers) +
                       " numbers, but takes " + std::to_string(n_expected) +
                       (has_curve ? " and pairs of a curve" : "") + ": write the contact problem anew.");
  }

  void LawValues::set(const std::string &name, const double value)
  {
    std::ostringstream text;
    text.precision(17);
    text << value;
    set(name, text.str());
  }

  double LawValues::number(const std::string &name) const
  {
    return std::strtod(texts.at(name).c_str(), nullptr);
  }

  std::string &LawValues::text(const LawParameter &parameter)
  {
    return texts.emplace(parameter.name, parameter.default_value).first->second;
  }

  void LawValues::read_curves(const std::vector<LawParameter> &parameters)
  {
    for (const LawParameter &parameter : parameters)
    {
      if (!parameter.is_curve() || texts.at(parameter.name).empty())
        continue;
      const CsvTable table = read_csv_file(texts.at(parameter.name), "Contact/" + parameter.name);
      const std::vector<double> &x = table.column(parameter.abscissa), &y = table.column(parameter.ordinate);
      std::vector<double> &points = curves[parameter.name];
      points.clear();
      for (std::size_t k = 0; k < x.size(); ++k)
        points.insert(points.end(), {x[k], y[k]});
    }
  }

  std::vector<double> LawValues::numbers(const std::vector<LawParameter> &parameters,
                                         const std::map<std::string, double> &given) const
  {
    std::vector<double> result;
    for (const LawParameter &parameter : parameters)
      if (given.count(parameter.name) > 0)
        result.push_back(given.at(parameter.name));
      else if (!parameter.is_curve())
        result.push_back(number(parameter.name));
      else if (curves.count(parameter.name) == 0)
        throw InputError("The law of the contact needs Contact/" + parameter.name +
                         ": give a CSV file with the columns " + parameter.abscissa + " and " +
                         parameter.ordinate + ".");
      else
        result.insert(result.end(), curves.at(parameter.name).begin(), curves.at(parameter.name).end());
    return result;
  }
} // namespace vibrocontact
