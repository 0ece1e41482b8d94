#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/scene/block.h>
#include <vibrocontact/scene/held_part.h>
#include <vibrocontact/scene/mesh_quality.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// The face of a block that looks at its partner.
    std::string face_towards(const ContactPlace &place)
    {
      static const char *const faces[3][2] = {{"left", "right"}, {"front", "back"}, {"bottom", "top"}};
      const std::array<double, 3> &normal = place.frame.axes[0];
      unsigned int axis = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (std::abs(normal[d]) > std::abs(normal[axis]))
          axis = d;
      return faces[axis][(normal[axis] > 0) != place.above];
    }
  } // namespace

  void BlockParameters::declare_parameters(ParameterHandler &prm)
  {
    using Patterns::Double;
    using Patterns::Integer;
    prm.add_parameter("Length", length, "Size along x. Units: m.", Double(0));
    prm.add_parameter("Width", width, "Size along y. Units: m.", Double(0));
    prm.add_parameter("Height", height, "Size along z. Units: m.", Double(0));
    prm.add_parameter("Divisions x", divisions_x, "Cells along x. Units: none.", Integer(1, 1000));
    prm.add_parameter("Divisions y", divisions_y, "Cells along y. Units: none.", Integer(1, 1000));
    prm.add_parameter("Divisions z", divisions_z, "Cells along z. Units: none.", Integer(1, 1000));
    prm.add_parameter("Contact face", contact_face,
                      "Face that can come into contact; it lies in the plane z = 0. Units: none.",
                      Patterns::Selection("top|bottom"));
    prm.add_parameter(
        "Held", held,
        "Boundaries that are held, out of left, right, front, back, bottom, top; right: yz holds those "
        "directions alone; empty: a free body. Units: none.",
        Patterns::List(Patterns::Anything(), 0, 6, ","));
    prm.add_parameter("Offset x", offset_x, "Shift of the box along x. Units: m.", Double());
    prm.add_parameter("Offset y", offset_y, "Shift of the box along y. Units: m.", Double());
  }

  void BlockParameters::check(const std::string &section) const
  {
    for (const auto &[entry, size] : {std::make_pair("Length", length), {"Width", width}, {"Height", height}})
      if (!(size > 1e-6) || size > 100)
      {
        std::ostringstream text;
        text << section << "/" << entry << " is " << size << " m: give a size between 1e-6 and 100 m.";
        throw InputError(text.str());
      }
    static const std::vector<std::string> faces = {"left", "right", "front", "back", "bottom", "top"};
    for (const HeldPart &part : held_parts(held, section + "/Held"))
    {
      if (std::find(faces.begin(), faces.end(), part.boundary) == faces.end())
        throw InputError(section + "/Held: there is no boundary \"" + part.boundary + "\"; " +
                         name_suggestion(part.boundary, faces));
      if (part.boundary == contact_face)
        throw InputError(section + "/Held contains the contact face '" + contact_face +
                         "': a held face cannot deform in contact; hold another one.");
    }
  }

  FlatFace BlockParameters::contact_rectangle(const double lateral_position) const
  {
    return {offset_x - length / 2, offset_x + length / 2, offset_y - lateral_position - width / 2,
            offset_y - lateral_position + width / 2};
  }

  template <int dim>
  BodyMesh<dim> make_block(const BlockParameters &parameters, const std::string &name,
                           const MPI_Comm communicator)
  {
    check_number_of_cells<dim>(double(parameters.divisions_x) * (dim == 3 ? parameters.divisions_y : 1) *
                                   parameters.divisions_z,
                               2, name, "choose fewer Divisions");
    BodyMesh<dim> mesh;
    mesh.name = name;
    mesh.triangulation = std::make_unique<parallel::distributed::Triangulation<dim>>(
        communicator, Triangulation<dim>::limit_level_difference_at_vertices);
    mesh.geometry_degree = 1;

    const double z_bottom = parameters.contact_face == "top" ? -parameters.height : 0.;
    Point<dim> low, high;
    std::vector<unsigned int> divisions = {parameters.divisions_x};
    low[0] = parameters.offset_x - parameters.length / 2;
    high[0] = low[0] + parameters.length;
    if (dim == 3)
    {
      low[1] = parameters.offset_y - parameters.width / 2;
      high[1] = low[1] + parameters.width;
      divisions.push_back(parameters.divisions_y);
    }
    low[dim - 1] = z_bottom;
    high[dim - 1] = z_bottom + parameters.height;
    divisions.push_back(parameters.divisions_z);
    GridGenerator::subdivided_hyper_rectangle(*mesh.triangulation, divisions, low, high, true);

    mesh.boundaries = {{"left", 0}, {"right", 1}};
    if (dim == 3)
      mesh.boundaries.insert({{"front", 2}, {"back", 3}});
    mesh.boundaries["bottom"] = 2 * dim - 2;
    mesh.boundaries["top"] = 2 * dim - 1;
    mesh.contact_boundaries = {mesh.boundaries.at(parameters.contact_face)};
    return mesh;
  }

  template BodyMesh<2> make_block(const BlockParameters &, const std::string &, const MPI_Comm);
  template BodyMesh<3> make_block(const BlockParameters &, const std::string &, const MPI_Comm);

  bool BlockParameters::add_entries(EntriesRead &entries, const std::string &section, const BodyUse &) const
  {
    entries.add(section, "Length, Width, Height, Divisions x, Divisions y, Divisions z, Contact face, Held, "
                         "Offset x, Offset y");
    return true;
  }

  std::pair<std::string, std::string> BlockParameters::missing_support(const std::string &name) const
  {
    if (!held.empty())
      return {};
    return {name + "/Block/Held is empty", std::string("hold at least one boundary, for instance Held = ") +
                                               (contact_face == "top" ? "bottom" : "top")};
  }

  BodyMesh<3> BlockParameters::make_mesh(const MeshRequest &request) const
  {
    BlockParameters shifted = *this;
    shifted.offset_y -= request.lateral_position;
    BodyMesh<3> mesh = make_block<3>(shifted, request.name, request.communicator);
    for (const ContactPlace &place : request.places)
      if (!place.frame.is_usual())
        mesh.contact_boundaries.insert(mesh.boundary_id(face_towards(place)));
    return mesh;
  }

  void BlockParameters::hold(ElasticModel<3> &model, const BodyMesh<3> &mesh) const
  {
    for (const HeldPart &part : held_parts(held, "Held"))
      model.held.emplace_back(mesh.boundary_id(part.boundary), part.directions);
  }

  std::string BlockParameters::way_to_turn(const std::string &, const bool above) const
  {
    return std::string("set it to ") + (above ? "bottom" : "top");
  }
} // namespace vibrocontact
