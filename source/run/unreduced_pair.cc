#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/fe/dense_system.h>
#include <vibrocontact/reduction/all_modes.h>
#include <vibrocontact/reduction/reduction_parts.h>
#include <vibrocontact/run/unreduced_pair.h>

#include <deal.II/base/timer.h>

namespace vibrocontact
{
  void check_unreduced_size(const MeshedBodies &bodies)
  {
    unsigned int n = 0;
    for (unsigned int k = 0; k < bodies.size(); ++k)
      if (bodies[k])
        n += n_moving_dofs(bodies[k]->reduction.system());
    if (n > most_dense_dofs)
      throw InputError("Transient/Model is finite elements, but the bodies have " + std::to_string(n) +
                       " degrees of freedom, more than the " + std::to_string(most_dense_dofs) +
                       " that go to LAPACK: set it to reduced or make the meshes coarser.");
  }

  UnreducedPair prepare_unreduced_pair(const Parameters &parameters, const MeshedBodies &bodies)
  {
    auto pair = std::make_unique<PreparedPair>();
    pair->reduced.resize(bodies.size());
    UnreducedPair result;
    result.surfaces.resize(bodies.size());
    for (unsigned int k = 0; k < bodies.size(); ++k)
    {
      if (bodies[k])
      {
        BodyReduction &reduction = bodies[k]->reduction;
        const Modes &shapes = reduction.shapes();
        ReducedBody kept = reduction.reduced(true);
        dealii::Timer timer;
        const Modes all = all_modes(reduction.system(), shapes);
        pair->reduced[k] = with_all_modes(std::move(kept), reduction.system(), all);
        complete_reduction(pair->reduced[k], parameters.scene.bodies[k],
                           parameters.modes.at(parameters.scene.bodies[k].name));
        result.surfaces[k] = surface_shapes(reduction.system().surface, all);
        run_log().line(bodies[k]->parameters.name + ": all " + std::to_string(all.omega.size()) +
                       " modes: " + time_text(timer.wall_time()));
      }
      pair->bodies.push_back({&parameters.scene.bodies[k], bodies[k] ? &pair->reduced[k] : nullptr});
    }
    result.prepared = std::move(pair);
    return result;
  }

  ReducedBody with_all_modes(ReducedBody body, const SecondOrderSystem &system, const Modes &all)
  {
    const unsigned int n_kept = body.omega.size(), n = all.omega.size();
    const ModalReduction modal = modal_reduction(system, all);
    body.trace = modal.trace;
    body.loss = DenseMatrix();
    body.modal_load = modal.load;
    body.participation = modal.participation;
    for (unsigned int k = n_kept; k < n; ++k)
    {
      body.omega.push_back(all.omega[k]);
      body.damping_ratio.push_back(0);
      body.labels.push_back("mode " + std::to_string(k + 1 - body.n_rigid_modes));
    }
    if (n == n_moving_dofs(system))
    {
      body.residual = 0;
      std::fill(body.residual_load.begin(), body.residual_load.end(), 0.);
    }
    else // massless dofs have no mode: what the modes found leave of the flexibility is theirs
      for (unsigned int k = n_kept; k < n; ++k)
        for (unsigned int j = 0; j < body.trace.m(); ++j)
        {
          const double answer = body.trace(j, k) / (body.omega[k] * body.omega[k]);
          body.residual_load[j] -= answer * body.modal_load[k];
          for (unsigned int i = 0; i < body.trace.m(); ++i)
            body.residual(i, j) -= body.trace(i, k) * answer;
        }
    return body;
  }
} // namespace vibrocontact
