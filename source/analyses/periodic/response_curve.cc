#include <vibrocontact/analyses/periodic/response_curve.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/numerics/cycle_measure.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    /// The balance as a curve in one parameter of the scene.
    class BalanceCurve : public CurveEquations
    {
    public:
      BalanceCurve(PeriodicBalance &balance, const SceneParameter parameter)
          : balance(balance), parameter(parameter)
      {
      }

      void set(const double p)
      {
        if (p != value)
          balance.set(parameter, value = p);
      }
      void evaluate(const std::vector<double> &x, const double p, std::vector<double> &residual,
                    DenseMatrix *by_x, std::vector<double> *by_p) override
      {
        set(p);
        balance.evaluate(x, residual, by_x, by_p, parameter);
      }
      std::size_t piece() const override { return balance.active_pattern(); }
      std::vector<double> events(const std::vector<double> &x, const double p) override
      {
        set(p);
        std::vector<double> residual;
        balance.evaluate(x, residual, nullptr, nullptr);
        return {approach()};
      }

      bool is_grazing(const CurvePoint &point)
      {
        const double gap = balance.linear_body().gap[0];
        return std::abs(events(point.x, point.p)[0]) <= 1e-4 * std::max(std::abs(gap), gap + approach());
      }

      /// largest displacement beyond the gap [m]; between samples by the parabola through three of them
      double approach() const
      {
        const ForcedBody &body = balance.linear_body();
        const unsigned int count = balance.sampling().n_samples();
        double result = -1e300;
        for (unsigned int p = 0; p < body.n_points(); ++p)
        {
          const double *const u = balance.row_samples(p * body.rows_per_point);
          const unsigned int top = std::max_element(u, u + count) - u;
          const double most =
              balance.trial().n_derivatives() == 0
                  ? u[top]
                  : extreme_between_samples(u[(top + count - 1) % count], u[top], u[(top + 1) % count]);
          result = std::max(result, most - body.gap[p]);
        }
        return result;
      }

    private:
      PeriodicBalance &balance;
      const SceneParameter parameter;
      double value = std::nan("");
    };

    /// relative difference of amplitudes, difference of parts of the period, that are no change
    constexpr double same_amplitude = 5e-4, same_part = 1e-3;
    constexpr unsigned int most_spurious = 2;
    /// of the parameter over the whole curve: turns that lie nearer together blur no fold, however many they are
    constexpr double least_spread = 5e-4;

    bool is_same_turn(const BranchPoint &a, const BranchPoint &b)
    {
      return std::abs(a.amplitude - b.amplitude) <= same_amplitude * a.amplitude &&
             std::abs(a.active - b.active) <= same_part;
    }

    /// Parameter of the projections for a whole branch, between those of its stiffest and its most compliant motion. Forces of N
    /// functions depend on it within the error of the functions; the branch must not change with it on the way.
    double projection_of_branch(PeriodicBalance &balance, const BranchSettings &settings)
    {
      const ForcedBody &body = balance.linear_body();
      std::vector<double> values = {settings.start};
      for (unsigned int k = 0; k < body.n_modes() && settings.parameter == SceneParameter::frequency; ++k)
      {
        const double natural = body.omega[k] / (2 * M_PI);
        if (natural > settings.least && natural < settings.most)
          values.push_back(natural);
      }
      double least = 1e300, most = 0;
      for (const double value : values)
      {
        balance.set(settings.parameter, value);
        double compliance = 0;
        for (unsigned int row = 0; row < body.n_contact_rows(); row += body.rows_per_point)
          compliance = std::max(compliance, largest_compliance(balance.condensed(), row));
        least = std::min(least, compliance);
        most = std::max(most, compliance);
      }
      balance.set(settings.parameter, settings.start);
      return balance.settings.projection / std::sqrt(least * most);
    }

    /// Keeps the parameter of the projections while it lives.
    struct OneProjection
    {
      OneProjection(PeriodicBalance &balance, const double rho) : balance(balance)
      {
        balance.set_projection(rho);
      }
      ~OneProjection() { balance.set_projection(0); }
      PeriodicBalance &balance;
    };

    /// force that closes the gap at rest
    double force_scale(const PeriodicBalance &balance)
    {
      const ForcedBody &body = balance.linear_body();
      double scale = balance.excitation().amplitude;
      for (unsigned int p = 0; p < body.n_points(); ++p)
      {
        const unsigned int row = p * body.rows_per_point;
        const double compliance = std::abs(balance.condensed().compliance[row * body.n_contact_rows() + row]);
        if (compliance > 0)
          scale = std::max(scale, std::abs(body.gap[p]) / compliance);
      }
      return scale > 0 ? scale : 1.;
    }

    /// A resonance of the body without contact, and how far from it half of its power is left [Hz].
    struct Resonance
    {
      double frequency, half_width;
    };

    /// Those at which the exciting force moves contact rows by what matters beside the gap or the largest of them.
    std::vector<Resonance> resonances(const ForcedBody &body, const double force)
    {
      constexpr double per_turn = 1 / (2 * dealii::numbers::PI), least_of_gap = 1e-3;
      std::vector<Resonance> all;
      std::vector<double> peaks;
      // @param rate at which it decays [1/s]; @param response of a row to the force over twice that [m/s]
      const auto add = [&](const double omega, const double rate, const auto &response)
      {
        double peak = 0;
        for (unsigned int row = 0; row < body.n_contact_rows(); ++row)
          peak = std::max(peak, force * response(row));
        all.push_back({omega * per_turn, rate * per_turn});
        peaks.push_back(peak > 0 && rate > 0 ? peak / rate : peak > 0 ? HUGE_VAL : 0);
      };
      for (unsigned int k = 0; k < body.omega.size(); ++k)
        if (body.omega[k] > 0)
          add(body.omega[k], body.damping_ratio[k] * body.omega[k],
              [&](const unsigned int row)
              { return std::abs(body.trace(row, k) * body.modal_force(k)) / (2 * body.omega[k]); });
      for (unsigned int k = 0; k < body.poles.size(); ++k)
        if (body.poles[k].imag() != 0)
          add(std::abs(body.poles[k]), std::abs(body.poles[k].real()),
              [&](const unsigned int row)
              { return std::abs(body.right(row, k) * body.left(body.force_row, k)); });
      double matters = 0;
      for (const double peak : peaks)
        matters = std::max(matters, peak);
      for (const double gap : body.gap)
        matters = std::min(matters, std::abs(gap));
      std::vector<Resonance> result;
      for (std::size_t k = 0; k < all.size(); ++k)
        if (peaks[k] > least_of_gap * matters)
          result.push_back(all[k]);
      return result;
    }

    /// Largest change of the frequency from a point of open contact, where the unknown forces are zero and do not see the body
    /// resonate: resonances ahead are come near by halves and met, those behind are left by twice the distance. What nothing damps is passed close by.
    double longest_change(const std::vector<Resonance> &resonances, const double frequency,
                          const bool upwards)
    {
      constexpr double least_width = 1e-6, met = 1e-6;
      double longest = std::numeric_limits<double>::infinity();
      for (const auto &[at, half_width] : resonances)
      {
        const double width = half_width > 0 ? half_width : least_width * at,
                     ahead = upwards ? at - frequency : frequency - at;
        if (ahead > met * width)
          longest = std::min(longest, half_width > 0 && ahead <= width ? ahead : std::max(width, ahead / 2));
        else
          longest = std::min(longest, std::max(width / 2, -ahead));
      }
      return longest;
    }
  } // namespace

  void merge_folds(ResponseCurve &curve)
  {
    std::vector<BranchPoint *> folds;
    for (BranchPoint &point : curve.points)
      if (point.kind == CurvePoint::Kind::fold)
        folds.push_back(&point);
    curve.folds.clear();
    curve.n_spurious = 0;
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const BranchPoint &point : curve.points)
    {
      least = std::min(least, point.value(curve.parameter));
      most = std::max(most, point.value(curve.parameter));
    }
    unsigned int longest = 0;
    for (std::size_t first = 0, end; first < folds.size(); first = end)
    {
      for (end = first + 1; end < folds.size() && is_same_turn(*folds[end - 1], *folds[end]);)
        ++end;
      const bool turns = (end - first) % 2 == 1;
      std::size_t outermost = first;
      double lowest = HUGE_VAL, highest = -HUGE_VAL;
      // members of even distance turn the same way as the first, those between back
      const double sense =
          end - first > 1 && folds[first + 1]->value(curve.parameter) > folds[first]->value(curve.parameter)
              ? -1.
              : 1.;
      for (std::size_t k = first; k < end; ++k)
      {
        folds[k]->is_spurious = true;
        lowest = std::min(lowest, folds[k]->value(curve.parameter));
        highest = std::max(highest, folds[k]->value(curve.parameter));
        if (sense * folds[k]->value(curve.parameter) > sense * folds[outermost]->value(curve.parameter))
          outermost = k;
      }
      const unsigned int n_spurious = end - first - turns;
      curve.n_spurious += n_spurious;
      if (highest - lowest > least_spread * (most - least))
        longest = std::max(longest, n_spurious);
      if (!turns)
        continue;
      folds[outermost]->is_spurious = false;
      curve.folds.push_back(folds[outermost]->value(curve.parameter));
    }
    if (longest > most_spurious)
    {
      curve.complete = false;
      curve.reason += ", but it turns " + std::to_string(longest) +
                      " times in a row without its amplitude or its contact changing: take a softer or the "
                      "exact law, more functions or more samples";
    }
  }

  double BranchPoint::value(const SceneParameter parameter) const
  {
    return parameter == SceneParameter::frequency ? excitation.frequency
           : parameter == SceneParameter::force   ? excitation.amplitude
                                                  : gap;
  }

  ResponseCurve follow_response(PeriodicBalance &balance, const BranchSettings &settings)
  {
    const bool wants_stability = settings.stability != StabilityMethod::none;
    if (wants_stability && balance.settings.friction > 0 && !balance.slipping_points())
      throw InputError(
          "The stability of motions with friction needs a rigid stop before contact points without mass "
          "whose residual does not relax: set Periodic/Continuation/Stability = none.");
    const ForcedBody &body = balance.linear_body();
    for (unsigned int p = 0, row = 0; p < body.n_points() && wants_stability; ++p, row += body.rows_per_point)
      if (!balance.normal_law(p).is_function_of_gap() && !(body.residual(row, row) > 0))
        throw InputError(
            "The stability of motions against a rigid stop needs a massless contact point: give the body "
            "one, or set Periodic/Continuation/Stability = none.");
    dealii::Timer timer;
    ResponseCurve result;
    result.parameter = settings.parameter;
    result.has_stability = wants_stability;
    const OneProjection one_projection(balance, projection_of_branch(balance, settings));
    const PeriodicSolution first = balance.solve();
    if (!first.converged)
    {
      result.reason = "Newton's method did not converge at the start";
      return result;
    }
    BalanceCurve equations(balance, settings.parameter);
    ContinuationSettings continuation;
    continuation.x_scale = continuation.residual_scale = force_scale(balance);
    continuation.p_scale =
        settings.scale > 0 ? settings.scale : std::max(0.1 * (settings.most - settings.least), 1e-300);
    continuation.p_min = settings.least;
    continuation.p_max = settings.most;
    continuation.first_step = settings.first_step;
    continuation.min_step = settings.min_step;
    continuation.max_step = settings.max_step;
    continuation.max_points = settings.max_points;
    continuation.location_tolerance = settings.location_tolerance;
    continuation.direction = settings.direction;
    continuation.tolerance = balance.settings.tolerance;
    if (settings.parameter == SceneParameter::frequency)
      continuation.longest_change = [all = resonances(body, balance.excitation().amplitude),
                                     open = 1e-9 * continuation.x_scale](const CurvePoint &point)
      {
        const bool is_open = std::all_of(point.x.begin(), point.x.end(),
                                         [open](const double force) { return std::abs(force) <= open; });
        return is_open ? longest_change(all, point.p, point.tangent.back() > 0)
                       : std::numeric_limits<double>::infinity();
      };
    CurvePoint start;
    start.x = first.force;
    start.p = settings.start;
    const Curve curve = continue_curve(equations, start, continuation);
    result.end = curve.end;
    result.complete = result.is_whole();
    result.reason = curve.reason();
    if (curve.end == Curve::End::turned_back && equations.is_grazing(curve.points.back()))
      result.reason = "turned back at grazing";

    const unsigned int count = balance.sampling().n_samples();
    std::vector<double> residual;
    double stability_begin = timer.wall_time();
    for (const CurvePoint &point : curve.points)
    {
      equations.set(point.p);
      balance.evaluate(point.x, residual, nullptr, nullptr);
      BranchPoint response;
      response.kind = point.kind;
      response.excitation = balance.excitation();
      response.gap = balance.linear_body().gap[0];
      response.force = point.x;
      const double *const u = balance.row_samples(0);
      for (unsigned int k = 0; k < count; ++k)
        response.amplitude = std::max(response.amplitude, std::abs(u[k]));
      response.active = double(balance.n_active()) / (count * balance.linear_body().n_points());
      if (result.has_stability)
        try
        {
          response.multiplier =
              largest_multiplier(balance, settings.stability, settings.mode_limit, settings.hill_harmonics);
        }
        catch (const ConvergenceError &error)
        {
          // the branch stands without it
          result.has_stability = result.complete = false;
          result.reason += ", without its stability: " + std::string(error.what());
        }
      if (point.kind == CurvePoint::Kind::event)
        result.grazing.push_back(point.p);
      result.points.push_back(std::move(response));
    }
    merge_folds(result);
    result.stability_seconds = timer.wall_time() - stability_begin;
    result.seconds = timer.wall_time();
    return result;
  }
} // namespace vibrocontact
