#pragma once

#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/fe/make_elastic_body.h>
#include <vibrocontact/reduction/body_reduction.h>
#include <vibrocontact/scene/revolved_mesh.h>

#include <memory>
#include <optional>
#include <string>

namespace vibrocontact
{
  /// Everything that determines the reduction of a body, as text: its own entries (all but those of its
  /// modes), the contact grid and the contents of the files that it names. The key of the reduction cache.
  std::string body_key(const DeclaredParameters &parameters, const std::string &body, double lateral_position,
                       const std::vector<ContactPlace> &places);

  /// Where the rim of a wheel begins, from its entry, or as far out as on the shipped wheel [m].
  double rim_radius(const BodyParameters &body, const ModeParameters &modes);

  /// One meshed body of a scene: its finite elements, made when first asked for, and its reduction.
  class MeshedBody
  {
  public:
    /// @param above whether this is body 1; @param key see body_key()
    /// @param places of its contacts; none if no analysis has contact
    MeshedBody(const BodyParameters &parameters, const ModeParameters &modes,
               const StiffnessSolverParameters &solver, bool above, double lateral_position,
               const std::vector<ContactPlace> &places, const std::string &key,
               const std::string &cache_directory, MPI_Comm communicator);

    /// Makes mesh and dofs of a solid. What is wrong with them is thrown here, before the expensive steps.
    /// Collective.
    const ElasticBody<3> &elastic_body();
    /// Lays the contact grids on the body, if there are any, and keeps the trace for the assembly. What is
    /// wrong with it is thrown here, before the expensive steps; also a contact surface that looks the wrong
    /// way: down for the first body of a contact, which is above, up for the second. Collective.
    void check_contact();
    /// Section of a body of revolution, made if need be. Collective.
    const RevolvedMesh &section();
    /// The body if this run has made it, null otherwise.
    const ElasticBody<3> *made() const { return body.get(); }

    const BodyParameters &parameters;

  private:
    const bool above;
    const double lateral_position;
    const std::vector<ContactPlace> places;
    const MPI_Comm communicator;
    std::unique_ptr<ElasticBody<3>> body;
    std::optional<ContactTrace> trace;
    std::optional<RevolvedMesh> revolved_mesh;

    std::unique_ptr<SecondOrderSystem> assemble();
    std::unique_ptr<RevolvedReduction> revolve();
    /// Traces of all places.
    ContactTrace contacts_of(const ElementBody &elements, const SecondOrderSystem &system) const;
    void check_side(bool above, bool faces_up) const;

  public:
    BodyReduction reduction;
  };
} // namespace vibrocontact
