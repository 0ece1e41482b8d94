#include <vibrocontact/fe/attached_points.h>
#include <vibrocontact/fe/glued_faces.h>
#include <vibrocontact/fe/make_elastic_body.h>

#include <optional>

namespace vibrocontact
{
  std::vector<std::string> group_names(const BodyParameters &parameters)
  {
    std::vector<std::string> names;
    for (const auto &[group, material] : parameters.materials)
      names.push_back(group);
    return names;
  }

  ElasticModel<3> elastic_model(const BodyParameters &parameters)
  {
    ElasticModel<3> model;
    model.material = parameters.materials.empty() ? parameters.material : parameters.materials.front().second;
    for (unsigned int k = 0; k < parameters.materials.size(); ++k)
      model.zones[k] = parameters.materials[k].second;
    return model;
  }

  void glue_parts(ElasticBody<3> &body, const std::vector<GluedPair> &pairs)
  {
    std::vector<GluedBoundaries> boundaries;
    for (const GluedPair &pair : pairs)
      boundaries.push_back({body.mesh.boundary_id(pair.follower), body.mesh.boundary_id(pair.leader),
                            pair.follower, pair.leader});
    glue_faces(body.dof_handler, body.mapping, boundaries, body.mesh.name + "/Mesh/Glued",
               body.locally_relevant, body.constraints);
  }

  std::unique_ptr<ElasticBody<3>> make_elastic_body(const BodyParameters &parameters,
                                                    const double lateral_position,
                                                    const std::vector<ContactPlace> &places,
                                                    const MPI_Comm communicator,
                                                    const std::string &mesh_folder)
  {
    ElasticModel<3> model = elastic_model(parameters);
    const std::optional<ContactGrid> covered =
        places.empty() ? std::nullopt : std::make_optional(covering_grid(places));
    const SolidBody *const solid = parameters.description->solid();
    AssertThrow(solid, dealii::ExcMessage("Body " + parameters.name + " is no solid."));
    BodyMesh<3> mesh =
        solid->make_mesh({parameters.name, lateral_position, places, covered ? &*covered : nullptr,
                          group_names(parameters), communicator, mesh_folder});
    solid->hold(model, mesh);
    add_loads(model, parameters.loads, mesh);
    model.rotation = parameters.rotation.steady();
    auto body = std::make_unique<ElasticBody<3>>(std::move(mesh), model, solid->mesh_degree());
    glue_parts(*body, solid->glued(parameters.name));
    attach_masses(*body);
    return body;
  }
} // namespace vibrocontact
