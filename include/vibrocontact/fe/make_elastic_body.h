#pragma once

#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/scene/body.h>
#include <vibrocontact/scene/contact_frame.h>

namespace vibrocontact
{
  /// Names of the groups of cells that have a material each, and a model of these materials by group.
  std::vector<std::string> group_names(const BodyParameters &parameters);
  ElasticModel<3> elastic_model(const BodyParameters &parameters);

  /// Glues the parts of a body whose meshes do not match, before it is assembled.
  void glue_parts(ElasticBody<3> &body, const std::vector<GluedPair> &pairs);

  /// Mesh, material, supports and loads of a meshed body as its parameters say, ready to be assembled.
  /// @param lateral_position of the contact on a wheel or, beside its offset, a block [m]
  /// @param places of its contacts, whose grids are refined for; empty: a body without contact
  /// @param mesh_folder where meshes of CAD parts are kept; empty: nowhere
  /// @throws InputError for anything that the mesh makers refuse
  std::unique_ptr<ElasticBody<3>> make_elastic_body(const BodyParameters &parameters, double lateral_position,
                                                    const std::vector<ContactPlace> &places,
                                                    MPI_Comm communicator,
                                                    const std::string &mesh_folder = "");
} // namespace vibrocontact
