#include <vibrocontact/numerics/newton_method.h>

#include <cmath>

namespace vibrocontact
{
  NewtonResult solve_by_newton(NewtonEquations &equations, const NewtonSettings &settings,
                               std::vector<double> &x)
  {
    NewtonResult result;
    std::vector<double> step, trial(x.size());
    bool are_fresh = true;
    unsigned int doublings = 0;
    result.size = equations.evaluate(x);
    while (std::isfinite(result.size))
    {
      result.converged = equations.keep(x, result.size);
      if (result.converged || result.iterations == settings.max_iterations)
        return result;
      if (!equations.find_step(are_fresh, step))
        return result;
      ++result.iterations;
      bool falls = false;
      double next = result.size;
      const double shortest = are_fresh && result.size > settings.enough ? settings.shortest_length : 1.;
      for (double length = 1; !falls && length >= shortest; length /= 2)
      {
        for (std::size_t k = 0; k < x.size(); ++k)
          trial[k] = x[k] + length * step[k];
        next = equations.evaluate(trial);
        falls = next < (1 - settings.decrease * length) * result.size;
      }
      if (!falls && settings.doublings > 0)
      {
        doublings += next > 2 * result.size;
        falls = doublings < settings.doublings;
      }
      if (!falls && are_fresh)
        return result;
      are_fresh = !settings.keeps_factors || !falls || next > 0.1 * result.size;
      if (falls)
      {
        x = trial;
        result.size = next;
      }
      else
        equations.evaluate(x); // old factors led nowhere: new ones
    }
    return result;
  }
} // namespace vibrocontact
