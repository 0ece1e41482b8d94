#include <vibrocontact/reduction/point_reduction.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Vector = dealii::PETScWrappers::MPI::Vector;

  namespace
  {
    constexpr double rounding_of_loads = 1e-10;
  }

  BodyInContact reduce_to_points(const SecondOrderSystem &system, Flexibility &flexibility,
                                 const Modes &modes, const std::vector<double> &damping_ratio,
                                 const std::vector<TraceRow> &points)
  {
    const unsigned int n = modes.omega.size(), m = points.size();
    BodyInContact result;
    result.omega = modes.omega;
    result.damping_ratio = damping_ratio;
    ContactTrace trace;
    trace.rows = points;
    result.trace.reinit(m, n);
    result.modal_load.assign(n, 0.);
    for (unsigned int k = 0; k < n; ++k)
    {
      const auto motion = contact_trace(trace, modes.shapes[k]);
      std::copy(motion.begin(), motion.end(), &result.trace(0, k));
      if (system.has_load)
        result.modal_load[k] = modes.shapes[k] * system.load;
    }

    Vector force(system.locally_owned, system.communicator), u(force);
    result.residual.reinit(m, m);
    result.residual_load.assign(m, 0.);
    for (unsigned int j = 0; j < m; ++j)
    {
      force = 0;
      for (const auto &[dof, weight] : points[j])
        if (system.locally_owned.is_element(dof))
          force(dof) = weight;
      force.compress(dealii::VectorOperation::insert);
      flexibility.vmult(u, force);
      const auto motion = contact_trace(trace, u);
      std::copy(motion.begin(), motion.end(), &result.residual(0, j));
    }
    if (system.has_load)
    {
      flexibility.vmult(u, system.load);
      result.residual_load = contact_trace(trace, u);
    }
    double largest = 0, farthest = 0;
    for (unsigned int i = 0; i < m; ++i)
    {
      largest = std::max(largest, result.residual(i, i));
      farthest = std::max(farthest, std::abs(result.residual_load[i]));
    }
    for (unsigned int k = modes.n_rigid_modes; k < n; ++k)
      for (unsigned int j = 0; j < m; ++j)
      {
        const double answer = result.trace(j, k) / (modes.omega[k] * modes.omega[k]);
        result.residual_load[j] -= answer * result.modal_load[k];
        for (unsigned int i = 0; i < m; ++i)
          result.residual(i, j) -= result.trace(i, k) * answer;
      }
    for (unsigned int i = 0; i < m; ++i)
    {
      if (std::abs(result.residual_load[i]) < rounding_of_loads * farthest)
        result.residual_load[i] = 0;
      for (unsigned int j = 0; j <= i; ++j)
      {
        const double mean = (result.residual(i, j) + result.residual(j, i)) / 2;
        result.residual(i, j) = result.residual(j, i) =
            std::abs(mean) < rounding_of_loads * largest ? 0. : mean;
      }
    }
    return result;
  }
} // namespace vibrocontact
