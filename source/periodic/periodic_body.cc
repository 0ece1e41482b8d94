#include <vibrocontact/periodic/periodic_body.h>
#include <vibrocontact/reduction/point_reduction.h>

namespace vibrocontact
{
  PeriodicBody periodic_body(const PointReduction &points, const std::vector<double> &omega,
                             const std::vector<double> &damping_ratio, const unsigned int n_rows,
                             const unsigned int exciting)
  {
    const unsigned int m = omega.size();
    PeriodicBody body;
    body.omega = omega;
    body.damping_ratio = damping_ratio;
    body.trace.reinit(n_rows, m);
    body.residual.reinit(n_rows, n_rows);
    body.modal_load = points.load;
    body.residual_load.assign(points.residual_load.begin(), points.residual_load.begin() + n_rows);
    for (unsigned int k = 0; k < m; ++k)
    {
      body.modal_force.push_back(points.trace(exciting, k));
      for (unsigned int i = 0; i < n_rows; ++i)
        body.trace(i, k) = points.trace(i, k);
    }
    for (unsigned int j = 0; j < n_rows; ++j)
    {
      body.residual_force.push_back(points.residual(j, exciting));
      for (unsigned int i = 0; i < n_rows; ++i)
        body.residual(i, j) = points.residual(i, j);
    }
    return body;
  }
} // namespace vibrocontact
