#include <vibrocontact/analyses/periodic/backbone.h>
#include <vibrocontact/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// of the contact forces from one frequency to the next
    constexpr double largest_change = 0.25;
    /// parameter of the projections over the static stiffness: smaller ones widen the tongues, larger ones lead Newton's method
    /// astray
    constexpr double projection = 20;

    /// Unknowns: moments of the contact forces and amplitude of the force; the last equation is the phase condition.
    class FreeMotion : public CurveEquations
    {
    public:
      explicit FreeMotion(PeriodicBalance &balance) : balance(balance), n(balance.n_unknowns()) {}

      void set(const std::vector<double> &x, const double f) { balance.set_force({x[n], f}); }

      void evaluate(const std::vector<double> &x, const double f, std::vector<double> &residual,
                    DenseMatrix *by_x, std::vector<double> *by_f) override
      {
        set(x, f);
        const std::vector<double> c(x.begin(), x.begin() + n);
        DenseMatrix inner;
        std::vector<double> by_force;
        balance.evaluate(c, residual, by_x ? &inner : nullptr, by_f, SceneParameter::frequency);
        if (by_x)
        {
          std::vector<double> same;
          balance.evaluate(c, same, nullptr, &by_force, SceneParameter::force);
          by_x->reinit(n + 1, n + 1);
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int i = 0; i < n; ++i)
              (*by_x)(i, j) = inner(i, j);
          for (unsigned int i = 0; i < n; ++i)
            (*by_x)(i, n) = by_force[i];
          (*by_x)(n, 2) = 1;
        }
        residual.push_back(c[2]);
        if (by_f)
          by_f->push_back(0);
      }
      std::size_t piece() const override { return balance.active_pattern(); }

    private:
      PeriodicBalance &balance;
      const unsigned int n;
    };

    /// whether forces are near those of the motion before, not on a tongue or another branch
    bool continues(const std::vector<double> &c, const std::vector<double> &before, const double limit)
    {
      double change = 0, size = 0;
      for (unsigned int k = 0; k < before.size(); ++k)
      {
        change += (c[k] - before[k]) * (c[k] - before[k]);
        size += before[k] * before[k];
      }
      return change <= limit * limit * size;
    }
  } // namespace

  Backbone follow_backbone(PeriodicBalance &balance, const double first, const double last,
                           const unsigned int n_points)
  {
    if (balance.settings.trial != "fourier" || balance.settings.weighting != "fourier" ||
        balance.settings.n_functions < 3)
      throw InputError(
          "A backbone needs Fourier functions, three at least: set Periodic/Trial basis and Weighting "
          "basis to fourier.");
    const unsigned int n = balance.n_unknowns(), N = balance.settings.n_functions,
                       rows = balance.linear_body().n_contact_rows(), count = balance.sampling().n_samples();
    FreeMotion equations(balance);
    // a pulse on the first point, smooth enough for the harmonics there are
    const auto pulse = [&](const double f)
    {
      std::vector<double> x(n + 1, 0.);
      equations.set(x, f);
      const std::vector<std::complex<double>> &compliance = balance.condensed().compliance;
      double closes = -compliance[0].real();
      x[0] = 1;
      for (unsigned int m = 1; 2 * m < N; ++m)
      {
        x[2 * m - 1] = std::pow(std::cos(M_PI * m / (N + 1.)), 2);
        closes -= 2 * x[2 * m - 1] * compliance[m * rows * rows].real();
      }
      for (double &value : x)
        value *= balance.linear_body().gap[0] / closes;
      return x;
    };

    // receptances grow without bounds at resonances, which would soften the projections
    equations.set(std::vector<double>(n + 1, 0.), first);
    balance.set_projection(projection / std::abs(balance.condensed().compliance[0]));

    Backbone result;
    std::vector<double> residual, before;
    double limit = largest_change;
    for (unsigned int k = 0; k < n_points; ++k)
    {
      CurvePoint start;
      start.p = n_points == 1 ? first : first + (last - first) * k / (n_points - 1);
      ContinuationSettings settings;
      settings.max_points = 1;
      settings.max_newton = 30;
      settings.tolerance = std::max(balance.settings.tolerance, 1e-9);
      const std::vector<double> fresh = pulse(start.p);
      settings.x_scale = settings.residual_scale = std::max(std::abs(fresh[0]), 1e-300);
      Curve curve;
      for (const std::vector<double> &x : {before, fresh})
        if ((curve.points.empty() || !continues(curve.points[0].x, before, limit)) && !x.empty())
        {
          start.x = x;
          curve = continue_curve(equations, start, settings);
        }
      if (curve.points.empty() || !continues(curve.points[0].x, before, limit))
      {
        result.missed.push_back(start.p);
        limit += largest_change;
        continue;
      }
      before = curve.points[0].x;
      limit = largest_change;
      equations.evaluate(before, start.p, residual, nullptr, nullptr);
      BranchPoint motion;
      motion.excitation = balance.excitation();
      motion.gap = balance.linear_body().gap[0];
      motion.force.assign(before.begin(), before.begin() + n);
      for (unsigned int i = 0; i < count; ++i)
        motion.amplitude = std::max(motion.amplitude, std::abs(balance.row_samples(0)[i]));
      motion.active = double(balance.n_active()) / (count * balance.linear_body().n_points());
      result.points.push_back(std::move(motion));
    }
    return result;
  }

  std::vector<InternalResonance> internal_resonances(const std::vector<double> &natural, const double least,
                                                     const double most, const unsigned int n_harmonics)
  {
    std::vector<InternalResonance> result;
    for (unsigned int mode = 0; mode < natural.size(); ++mode)
      for (unsigned int m = 1; m <= n_harmonics; ++m)
        if (natural[mode] / m >= least && natural[mode] / m <= most)
          result.push_back({natural[mode] / m, m, mode});
    std::sort(result.begin(), result.end(),
              [](const InternalResonance &a, const InternalResonance &b)
              { return a.frequency < b.frequency; });
    return result;
  }
} // namespace vibrocontact
