#include <vibrocontact/reduction/flow_reduction.h>
#include <vibrocontact/reduction/projected_matrix.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    using Vector = dealii::PETScWrappers::MPI::Vector;

    DenseMatrix in_modes(const std::vector<TraceRow> &rows, const Modes &modes)
    {
      ContactTrace trace;
      trace.rows = rows;
      DenseMatrix result(rows.size(), modes.shapes.size());
      for (unsigned int k = 0; k < modes.shapes.size() && !rows.empty(); ++k)
      {
        const std::vector<double> column = contact_trace(trace, modes.shapes[k]);
        std::copy(column.begin(), column.end(), &result(0, k));
      }
      return result;
    }
  } // namespace

  FlowReduction reduce_flow(const SecondOrderSystem &system, Flexibility &flexibility, const Modes &modes)
  {
    const MaterialFlow &flow = *system.flow;
    FlowReduction result;
    result.omega = modes.omega;
    result.fixed = projected_antisymmetric_matrix(flow.fixed, modes.shapes);
    if (flow.turning.m() == 0)
      return result;
    result.turning = projected_antisymmetric_matrix(flow.turning, modes.shapes);
    result.stretch = in_modes(flow.stretch, modes);
    result.beyond = in_modes(flow.beyond, modes);
    result.beyond_compliance.reinit(flow.beyond.size(), system.trace.rows.size());
    Vector force(system.locally_owned, system.communicator), u(force);
    for (unsigned int row = 0; row < flow.beyond.size(); ++row)
    {
      // the flexibility is symmetric
      force = 0;
      for (const auto &[dof, weight] : flow.beyond[row])
        if (system.locally_owned.is_element(dof))
          force(dof) = weight;
      force.compress(dealii::VectorOperation::insert);
      flexibility.vmult(u, force);
      const std::vector<double> motion = contact_trace(system.trace, u);
      for (unsigned int j = 0; j < motion.size(); ++j)
        result.beyond_compliance(row, j) = motion[j];
    }
    return result;
  }
} // namespace vibrocontact
