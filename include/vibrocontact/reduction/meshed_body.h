#pragma once

#include <vibrocontact/base/declared_parameters.h>
#include <vibrocontact/fe/make_elastic_body.h>
#include <vibrocontact/reduction/reduction_cache.h>
#include <vibrocontact/reduction/reduction_parts.h>

#include <memory>
#include <optional>
#include <string>

namespace vibrocontact
{
  /// Everything that determines the reduction of a body, as text: its own entries (all but those of its
  /// modes), the contact grid and the contents of the files that it names. The key of the reduction cache.
  std::string body_key(const DeclaredParameters &parameters, const std::string &body, double lateral_position,
                       const ContactGrid *grid);

  /// One meshed body on its way from parameters to reduction; every step is taken when first asked for, at
  /// most once.
  ///
  ///   parameters -> ElasticBody -> SecondOrderSystem -> Flexibility -> StaticReduction, ModalReduction
  ///
  /// A reduction found in the cache takes none of the earlier steps; fields on the mesh do. All members are
  /// collective.
  class MeshedBody
  {
  public:
    /// @param grid contact grid, null if no analysis has contact; @param key see body_key()
    MeshedBody(const BodyParameters &parameters, const ModeParameters &modes, double lateral_position,
               const ContactGrid *grid, const std::string &key, const ReductionCache &cache,
               MPI_Comm communicator);

    /// Makes the mesh, so that everything that can be refused is refused before the expensive steps.
    void check_mesh() { elastic_body(); }
    const StaticReduction &statics();
    const ModalReduction &modes();

    const ElasticBody<3> &elastic_body();
    const SecondOrderSystem &system();
    Flexibility &flexibility();
    /// Elastic displacement of all dofs under contact forces R on this body (3 n, [N]) and its loads [m].
    dealii::PETScWrappers::MPI::Vector displacement(const std::vector<double> &R);

    const BodyParameters &parameters;

  private:
    const ModeParameters mode_parameters;
    const double lateral_position;
    const ContactGrid *const grid;
    const std::string key;
    const ReductionCache &cache;
    const MPI_Comm communicator;
    std::unique_ptr<ElasticBody<3>> body;
    std::unique_ptr<SecondOrderSystem> matrices;
    std::unique_ptr<Flexibility> inverse;
    std::optional<StaticReduction> static_part;
    std::optional<ModalReduction> modal_part;
  };
} // namespace vibrocontact
