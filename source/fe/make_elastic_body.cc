#include <vibrocontact/fe/make_elastic_body.h>

#include <optional>

namespace vibrocontact
{
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
    const std::optional<ContactGrid> covered =
        places.empty() ? std::nullopt : std::make_optional(covering_grid(places));
    const SolidBody *const solid = parameters.description->solid();
    AssertThrow(solid, dealii::ExcMessage("Body " + parameters.name + " is no solid."));
    BodyMesh<3> mesh = solid->make_mesh(
        {parameters.name, lateral_position, places, covered ? &*covered : nullptr, materials, communicator});
    solid->hold(model, mesh);
    add_loads(model, parameters.loads, mesh);
    return std::make_unique<ElasticBody<3>>(std::move(mesh), model, solid->mesh_degree());
  }
} // namespace vibrocontact
