#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/scene/identified.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace vibrocontact
{
  void IdentifiedParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Poles file", poles_file,
                      "Poles and residues, a table as identification_poles_0.csv of the analysis "
                      "identification, in place of section Identification. Units: none.",
                      FileName());
    prm.add_parameter(
        "Inverse transform", inverse_transform,
        "For comparison: no poles are fitted, the Green's functions are the inverse Fourier transform of the "
        "data of section Identification; for direct or block convolution. Units: none.");
    prm.add_parameter(
        "Positions", positions,
        "Places of the data's points along the road (along the circle if there is a Radius), in the order "
        "in which the file names them first, ascending; empty: one point at 0. Units: m.",
        List(Double(-100, 100), 0, 10000, ","));
    prm.add_parameter("Radius", radius,
                      "Of the circle on which the points lie, its lowest point at 0; 0: all level. Units: m.",
                      Double(0, 1e6));
    prm.add_parameter("Tread stiffness", tread_stiffness,
                      "Of the tread under each point, which the data do not hold; 0: rigid. Units: N/m.",
                      Double(0, 1e15));
  }

  void IdentifiedParameters::check(const std::string &section) const
  {
    if (!poles_file.empty() && inverse_transform)
      throw InputError(section + "/Poles file and Inverse transform are both given: leave one of them out.");
    if (std::adjacent_find(positions.begin(), positions.end(), std::greater_equal<double>()) !=
        positions.end())
      throw InputError(section + "/Positions must ascend and hold no place twice.");
  }

  std::vector<double> IdentifiedParameters::heights() const
  {
    std::vector<double> result;
    for (const double x : places())
      result.push_back(radius > 0 ? radius * (1 - std::cos(x / radius)) : 0);
    return result;
  }

  bool IdentifiedParameters::is_even() const
  {
    for (std::size_t i = 0; i + 2 < positions.size(); ++i)
      if (std::abs(positions[i] - 2 * positions[i + 1] + positions[i + 2]) >
          1e-6 * (positions.back() - positions.front()))
        return false;
    return true;
  }

  ContactGrid IdentifiedParameters::grid(const double width) const
  {
    ContactGrid grid;
    grid.n_x = positions.size();
    grid.n_y = 1;
    grid.spacing_x = (positions.back() - positions.front()) / (positions.size() - 1);
    grid.spacing_y = width;
    grid.x_first = -positions.back();
    grid.of_body = grid.whole_surface = true;
    return grid;
  }

  bool IdentifiedParameters::add_entries(EntriesRead &entries, const std::string &section,
                                         const BodyUse &use) const
  {
    entries.add(section, "Poles file, Inverse transform");
    entries.add_if(use.contact, "the body is in contact", section, "Positions, Tread stiffness");
    entries.add_if(use.contact && !positions.empty(), "there are Positions", section, "Radius");
    return true;
  }

  void IdentifiedParameters::print(Log &log) const
  {
    log.value("points", static_cast<unsigned int>(places().size()));
  }

  std::optional<ContactGrid> IdentifiedParameters::contact_points(const double cell) const
  {
    return positions.size() > 1 ? grid(cell) : single_point(cell);
  }

  std::vector<double> IdentifiedParameters::places() const
  {
    return positions.empty() ? std::vector<double>{0.} : positions;
  }

  double IdentifiedParameters::tread_compliance(const bool tangential) const
  {
    return !tangential && tread_stiffness > 0 ? 1 / tread_stiffness : 0;
  }
} // namespace vibrocontact
