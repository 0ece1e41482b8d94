#include <vibrocontact/bodies/road_rows.h>

namespace vibrocontact
{
  BodyInContact road_rows(const ReducedBody &body, const bool with_friction, const double forward)
  {
    const unsigned int n = body.grid.n_points(), n_rows = with_friction ? 2 * n : n, m = body.omega.size();
    const auto sign = [&](const unsigned int row) { return row < n ? 1. : forward; };
    BodyInContact result;
    result.omega = body.omega;
    result.damping_ratio = body.damping_ratio;
    result.modal_load = body.modal_load;
    result.labels = body.labels;
    result.trace.reinit(n_rows, m);
    result.residual.reinit(n_rows, n_rows);
    for (unsigned int i = 0; i < n_rows; ++i)
    {
      for (unsigned int k = 0; k < m; ++k)
        result.trace(i, k) = sign(i) * body.modal_trace(i, k);
      for (unsigned int j = 0; j < n_rows; ++j)
        result.residual(i, j) = sign(i) * sign(j) * body.residual_flexibility(i, j);
    }
    return result;
  }
} // namespace vibrocontact
