#include <vibrocontact/analyses/periodic/balance.h>

#include <vibrocontact/numerics/lu_factors.h>

#include <cmath>

// What small motions about a periodic one see of its balance.

namespace vibrocontact
{
  std::function<std::pair<double, int>(double)> PeriodicBalance::growth_determinant() const
  {
    auto by_force = std::make_shared<DenseMatrix>(), by_motion = std::make_shared<DenseMatrix>();
    if (!massless)
      assemble_law(*by_force, *by_motion);
    return [this, by_force, by_motion](const double lambda)
    {
      const double f = force.frequency;
      const unsigned int size = n_unknowns();
      DenseMatrix matrix = massless ? DenseMatrix(size, size) : *by_force;
      add_answer(massless ? massless_rates(lambda / (f * samples->n_samples())) : *by_motion,
                 condense(body, pairing, force, lambda).compliance, matrix);
      LuFactors<double> factors;
      factors.factorise({&matrix(0, 0), &matrix(0, 0) + std::size_t(size) * size});
      return std::pair<double, int>(log_of_poles(body, pairing, f, lambda) + factors.log_determinant().real(),
                                    factors.sign());
    };
  }

  std::vector<double> PeriodicBalance::contact_stiffness(const unsigned int point, const double rigid) const
  {
    const unsigned int count = samples->n_samples(), rows = body.rows_per_point,
                       normal = point * rows * count;
    const auto gap = [&](const unsigned int k) { return body.gap[point] - u_samples[normal + k]; };
    std::vector<double> result(count, 0.);
    for (unsigned int k = 0; k < count; ++k)
    {
      if (!law[point].is_function_of_gap())
      {
        result[k] = law_samples[normal + k] > 0 ? rigid : 0.;
        continue;
      }
      const unsigned int next = k + 1 < count ? k + 1 : 0;
      const double here = gap(k), there = gap(next);
      if (here < 0 && there < 0)
      {
        result[k] += 0.5 * over_gap(point, here).force_slope;
        result[next] += 0.5 * over_gap(point, there).force_slope;
      }
      else if (here < 0 || there < 0)
      {
        // a part s of the interval is in contact: shares by linear shape functions
        const unsigned int closed = here < 0 ? k : next, open = here < 0 ? next : k;
        const double s = gap(closed) / (gap(closed) - gap(open)),
                     stiffness = over_gap(point, gap(closed)).force_slope;
        result[closed] += stiffness * s * (1 - 0.5 * s);
        result[open] += stiffness * 0.5 * s * s;
      }
    }
    return result;
  }

  std::array<std::vector<double>, 2> PeriodicBalance::normal_tangent(const unsigned int point) const
  {
    const unsigned int count = samples->n_samples();
    const auto first = std::size_t(point) * body.rows_per_point * body.rows_per_point * count;
    return {{{&by_u[first], &by_u[first] + count}, {&by_c[first], &by_c[first] + count}}};
  }
} // namespace vibrocontact
