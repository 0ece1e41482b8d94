#pragma once

#include <vibrocontact/contact/contact_solver.h>
#include <vibrocontact/contact/laws/contact_laws.h>
#include <vibrocontact/numerics/time_basis.h>
#include <vibrocontact/propagators/propagator_types.h>
#include <vibrocontact/scene/body.h>

namespace vibrocontact
{
  /// What entries of a parameter file choose from by name, beside analyses: by default what is shipped.
  struct EntryTables
  {
    ContactLaws laws;
    ContactSolvers contact_solvers = vibrocontact::contact_solvers();
    PropagatorTypes propagator_types = vibrocontact::propagator_types();
    TimeBases time_bases = vibrocontact::time_bases();
    BodyTypes body_types = vibrocontact::body_types();
  };
} // namespace vibrocontact
