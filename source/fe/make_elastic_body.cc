#include <vibrocontact/fe/make_elastic_body.h>

#include <cmath>
#include <optional>

namespace vibrocontact
{
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

  std::unique_ptr<ElasticBody<3>> make_elastic_body(const BodyParameters &parameters,
                                                    const double lateral_position,
                                                    const std::vector<ContactPlace> &places,
                                                    const MPI_Comm communicator)
  {
    ElasticModel<3> model;
    model.material = parameters.material;
    std::vector<std::string> materials;
    for (const auto &[group, material] : parameters.materials)
    {
      model.zones[materials.size()] = material;
      materials.push_back(group);
    }
    if (!materials.empty())
      model.material = model.zones.at(0);
    BodyMesh<3> mesh;
    unsigned int degree = 2;
    const std::optional<ContactGrid> covered =
        places.empty() ? std::nullopt : std::make_optional(covering_grid(places));
    const ContactGrid *const grid = covered ? &*covered : nullptr;
    if (parameters.type == "wheel")
    {
      mesh = make_wheel(parameters.wheel, lateral_position, grid, parameters.name, communicator, materials);
      model.held = {mesh.boundary_id("bore")};
      degree = parameters.wheel.section.element_degree;
    }
    else if (parameters.type == "rail")
    {
      mesh = make_rail(parameters.rail, grid, parameters.name, communicator, materials);
      add_supports(model, parameters.rail, mesh);
      degree = parameters.rail.section.element_degree;
    }
    else if (parameters.type == "block")
    {
      BlockParameters block = parameters.block;
      block.offset_y -= lateral_position;
      mesh = make_block<3>(block, parameters.name, communicator);
      for (const ContactPlace &place : places)
        if (!place.frame.is_usual())
          mesh.contact_boundaries.insert(mesh.boundary_id(face_towards(place)));
      for (const std::string &boundary : parameters.block.held)
        model.held.push_back(mesh.boundary_id(boundary));
    }
    else if (parameters.type == "blade")
    {
      mesh = make_blade(parameters.blade, parameters.name, communicator);
      model.held = {mesh.boundary_id("root")};
      degree = parameters.blade.element_degree;
    }
    else if (parameters.type == "mesh")
    {
      mesh = make_mesh_from_file(parameters.mesh, lateral_position, grid, parameters.name, communicator,
                                 materials);
      add_supports(model, parameters.mesh, mesh);
      degree = parameters.mesh.element_degree;
    }
    else
      AssertThrow(false, dealii::ExcMessage("Body " + parameters.name + " is not meshed."));
    add_loads(model, parameters.loads, mesh);
    return std::make_unique<ElasticBody<3>>(std::move(mesh), model, degree);
  }
} // namespace vibrocontact
