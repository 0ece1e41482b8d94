#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/scene/layer.h>

#include <nlohmann/json.hpp>

namespace vibrocontact
{
  void LayerParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Length", length, "Size along x. Units: m.", Double(1e-6, 100));
    prm.add_parameter("Height", height, "Size along z. Units: m.", Double(1e-6, 100));
    prm.add_parameter("Width", width,
                      "Size along y; 0: plane strain, all forces per metre of width. Units: m.",
                      Double(0, 100));
    prm.add_parameter("Divisions x", divisions_x, "Elements along x. Units: none.", Integer(1, 1000));
    prm.add_parameter("Divisions z", divisions_z, "Elements along z. Units: none.", Integer(1, 1000));
    prm.add_parameter("Divisions y", divisions_y, "Elements along y, not in plane strain. Units: none.",
                      Integer(1, 1000));
    prm.add_parameter("Element degree", degree, "Polynomial degree of the elements. Units: none.",
                      Integer(1, 2));
  }

  void LayerParameters::check(const std::string &section) const
  {
    const double n_dofs = plane_strain() ? 2. * (divisions_x * degree + 1) * (divisions_z * degree + 1)
                                         : 3. * (divisions_x * degree + 1) * (divisions_y * degree + 1) *
                                               (divisions_z * degree + 1);
    if (n_dofs > 1e6)
      throw InputError("Section '" + section +
                       "' asks for more than 1,000,000 dofs: lower its Divisions or Element degree.");
  }

  ContactGrid LayerParameters::grid() const
  {
    ContactGrid grid;
    grid.n_x = divisions_x * degree + 1;
    grid.spacing_x = length / (divisions_x * degree);
    grid.x_first = -length / 2;
    grid.n_y = 1;
    grid.spacing_y = 1;
    if (!plane_strain())
    {
      grid.n_y = divisions_y * degree + 1;
      grid.spacing_y = width / (divisions_y * degree);
      grid.y_first = -width / 2;
    }
    grid.of_body = grid.whole_surface = true;
    return grid;
  }

  BlockParameters LayerParameters::block() const
  {
    BlockParameters block;
    block.length = length;
    block.width = width;
    block.height = height;
    block.divisions_x = divisions_x;
    block.divisions_y = divisions_y;
    block.divisions_z = divisions_z;
    block.contact_face = "bottom";
    block.held = {"top"};
    return block;
  }

  bool LayerParameters::add_entries(EntriesRead &entries, const std::string &section, const BodyUse &) const
  {
    entries.add(section, "Length, Height, Width, Divisions x, Divisions z, Element degree");
    entries.add_if(!plane_strain(), "Width is given", section, "Divisions y");
    return true;
  }

  void LayerParameters::print(Log &log) const
  {
    log.value("length", length, "m");
    log.value("height", height, "m");
    log.value("width", plane_strain() ? "plane strain, per metre" : number_text(width) + " m");
    log.value("contact points", grid().n_points());
  }

  nlohmann::ordered_json LayerParameters::sizes() const
  {
    return {{"length_m", length}, {"height_m", height}};
  }

  std::optional<ContactGrid> LayerParameters::contact_points(double) const
  {
    return grid();
  }
} // namespace vibrocontact
