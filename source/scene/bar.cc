#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/scene/bar.h>

#include <nlohmann/json.hpp>

#include <cmath>

namespace vibrocontact
{
  void BarParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Length", length, "Length of the bar. Units: m.", Double(1e-9, 1e6));
    prm.add_parameter("Section", section, "Area of its cross-section. Units: m^2.", Double(1e-18, 1e6));
    prm.add_parameter("Divisions", divisions, "Elements along the bar. Units: none.", Integer(1, 100000));
    prm.add_parameter("Element degree", degree, "Polynomial degree of the elements. Units: none.",
                      Integer(1, 10));
    prm.add_parameter("Far end", far_end, "The end away from the contact. Units: none.",
                      Selection("held|free"));
    prm.add_parameter("Consistent mass", consistent_mass,
                      "Share s of the consistent mass, the rest is lumped. Fronts of waves stay sharp with s "
                      "= 1/2 + (c Time "
                      "step / element length)^2 for two-node elements and the theta method. Units: none.",
                      Double(0, 1.5));
    prm.add_parameter(
        "Massless contact node", massless_contact_node,
        "Give the mass of the contact element to its inner node: rigid contact of a node with mass needs "
        "an impact law. Units: none.");
  }

  void BarParameters::check(const std::string &path) const
  {
    if (double(divisions) * degree > 200000)
      throw InputError("Section '" + path +
                       "' asks for more than 200,000 dofs: lower Divisions or Element degree.");
    if (massless_contact_node && divisions < 2)
      throw InputError("Section '" + path +
                       "': Massless contact node leaves a bar of one element without mass: raise Divisions.");
  }

  bool BarParameters::add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const
  {
    entries.add(section, "Length, Section, Divisions, Element degree, Far end");
    entries.add_if(use.motion || use.heavy, "the body moves or has a Gravity", section,
                   "Consistent mass, Massless contact node");
    return true;
  }

  void BarParameters::print(Log &log) const
  {
    log.value("length", length, "m");
    log.value("section", this->section, "m^2");
    log.value("dofs", divisions * degree + 1);
  }

  nlohmann::ordered_json BarParameters::sizes() const
  {
    return {{"length_m", length}};
  }

  std::optional<ContactGrid> BarParameters::contact_points(double) const
  {
    return single_point(std::sqrt(section));
  }
} // namespace vibrocontact
