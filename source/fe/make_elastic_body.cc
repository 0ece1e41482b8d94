#include <vibrocontact/fe/make_elastic_body.h>

namespace vibrocontact
{
  std::unique_ptr<ElasticBody<3>> make_elastic_body(const BodyParameters &parameters,
                                                    const double lateral_position,
                                                    const ContactGrid *const grid,
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
