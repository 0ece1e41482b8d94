#include <vibrocontact/analyses/periodic/floquet.h>
#include <vibrocontact/analyses/periodic/slip_map.h>
#include <vibrocontact/analyses/periodic/stability.h>
#include <vibrocontact/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;

    /// growth over a period within which a real multiplier is that of the balance's own tangents, on a closed motion, too; the
    /// fastest that is looked for; the change by which Hill's method may correct a multiplier
    constexpr double near_fold = 0.03, fastest_growth = 4, hill_correction = 0.1;

    bool is_positive(const Complex &value)
    {
      return value.imag() == 0 && value.real() > 0;
    }
    bool is_smaller(const Complex &a, const Complex &b)
    {
      return std::abs(a) < std::abs(b);
    }

    /// Real multipliers of the balance's own tangents; growth is over a period, log of the multiplier.
    class RealGrowth
    {
    public:
      explicit RealGrowth(const PeriodicBalance &balance)
          : determinant(balance.growth_determinant()), f(balance.excitation().frequency), at_one(at(0)),
            // what has a history answers nothing at the end of very fast growth, its determinant is one
            sign_beyond(balance.slipping_points() ? 1 : at(fastest_growth).sign)
      {
      }

      /// whether an odd number of them is above one
      bool is_unstable() const { return at_one.sign != sign_beyond; }

      /// A growth above zero at which the sign changes, of an unstable motion; sought first below `near`.
      double above_one(const double near) const
      {
        Value below = at_one, above = at(near);
        while (above.growth < fastest_growth && above.sign != sign_beyond)
        {
          below = above;
          above = at(std::min(3 * above.growth, fastest_growth));
        }
        return zero_between(below, above);
      }

      /// The first change of sign below zero and not below `least`, of a stable motion; or nothing.
      std::optional<double> below_one(const double least) const
      {
        Value above = at_one;
        for (const double part : {0.1, 0.4, 1.})
        {
          const Value below = at(part * least);
          if (below.sign != above.sign)
            return zero_between(below, above);
          above = below;
        }
        return {};
      }

    private:
      /// the determinant at a growth: logarithm of its modulus, sign
      struct Value
      {
        double growth, log;
        int sign;
      };
      Value at(const double growth) const
      {
        const auto [log, sign] = determinant(growth * f);
        return {growth, log, sign};
      }

      /// Regula falsi; the value of an end that stays is halved (Illinois).
      double zero_between(const Value &first, const Value &last) const
      {
        constexpr double tolerance = 1e-6;
        const auto over_first = [&](const Value &value)
        { return value.sign * std::exp(std::clamp(value.log - first.log, -300., 300.)); };
        double a = first.growth, b = last.growth, value_a = over_first(first), value_b = over_first(last);
        for (unsigned int iteration = 0; iteration < 60 && std::abs(b - a) > tolerance; ++iteration)
        {
          const double next = b - value_b * (b - a) / (value_b - value_a), value = over_first(at(next));
          if (std::abs(next - b) < tolerance || value == 0)
            return next;
          if ((value > 0) != (value_b > 0))
          {
            a = b;
            value_a = value_b;
          }
          else
            value_a *= 0.5;
          b = next;
          value_b = value;
        }
        return b;
      }

      const std::function<std::pair<double, int>(double)> determinant;
      const double f;
      const Value at_one;
      const int sign_beyond;
    };

    /// Multipliers of a monodromy matrix.
    struct Found
    {
      std::vector<Complex> values;
      /// of a motion that repeats itself, rather than of the balance's
      bool closed = false;
    };

    bool has_massless_points(const PeriodicBalance &balance)
    {
      const ForcedBody &body = balance.linear_body();
      bool result = body.relaxation == 0 && balance.trial().n_derivatives() > 0;
      for (unsigned int p = 0; p < body.n_points(); ++p)
        result = result && !balance.normal_law(p).is_function_of_gap();
      for (unsigned int i = 0; i < body.n_contact_rows(); ++i)
        result = result && body.residual(i, i) > 0;
      return result;
    }

    /// the sample in the middle of the longest flight of all points, or 0
    unsigned int middle_of_flight(const PeriodicBalance &balance)
    {
      const unsigned int count = balance.sampling().n_samples(), points = balance.linear_body().n_points();
      unsigned int run = 0, longest = 0, middle = 0;
      for (unsigned int k = 0; k < 2 * count; ++k)
      {
        bool is_open = true;
        for (unsigned int p = 0; p < points; ++p)
          is_open = is_open && balance.point_status()[p * count + k % count] == ContactStatus::open;
        run = is_open ? run + 1 : 0;
        if (run > longest)
        {
          longest = run;
          middle = (k - run / 2) % count;
        }
      }
      return middle;
    }

    Found by_slip_map(const PeriodicBalance &balance)
    {
      const ForcedBody &body = balance.linear_body();
      const TimeSampling &sampling = balance.sampling();
      const HarmonicForce &force = balance.excitation();
      const unsigned int count = sampling.n_samples(), n = body.n_modes(), first = middle_of_flight(balance);
      std::vector<double> friction;
      for (unsigned int p = 0; p < body.n_points(); ++p)
        friction.push_back(balance.friction_of(p));
      SlipMap map(body, friction, force, count, sampling.phases()[0], first);
      map.expect(balance.point_status());
      std::vector<double> state = map.without_contact(map.begin());
      for (double &value : state)
        value *= -1;
      const DenseMatrix q =
          modal_coefficients(body, balance.integrals(), force, balance.body_forces(balance.last_force()));
      for (unsigned int d = 0; d < 2; ++d)
      {
        const DenseMatrix values = sampled(balance.trial(), {map.begin()}, d);
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int i = 0; i < q.m(); ++i)
            state[d * n + k] += (d == 0 ? 1. : force.frequency) * values(0, i) * q(i, k);
      }
      const unsigned int before = (first + count - 1) % count;
      for (unsigned int i = 0; i < body.n_contact_rows(); ++i)
        state.push_back(balance.row_samples(i)[before]);
      const SlipMultipliers found = slip_multipliers(map, state);
      return {found.values, found.correction >= 0};
    }

    /// Points without mass at stops that relax, or where samples do not resolve them, see a stiff spring.
    TangentContact spring_like(const PeriodicBalance &balance)
    {
      const ForcedBody &body = balance.linear_body();
      TangentContact contact;
      contact.frequency = balance.excitation().frequency;
      for (unsigned int p = 0; p < body.n_points(); ++p)
      {
        const double residual = body.residual(p * body.rows_per_point, p * body.rows_per_point);
        contact.stiffness.push_back(balance.contact_stiffness(p, residual > 0 ? 1e4 / residual : 0.));
      }
      return contact;
    }

    TangentContact projection_tangent(const PeriodicBalance &balance)
    {
      TangentContact tangent;
      tangent.frequency = balance.excitation().frequency;
      for (unsigned int p = 0; p < balance.linear_body().n_points(); ++p)
      {
        const auto [by_displacement, by_force] = balance.normal_tangent(p);
        tangent.stiffness.push_back(by_displacement);
        tangent.share.push_back(by_force);
      }
      return tangent;
    }

    /// By Hill's method, if that finds one nearby.
    Complex refined(const ForcedBody &body, const TangentContact &tangent, const unsigned int n_harmonics,
                    const Complex &start)
    {
      try
      {
        const Complex found = hill_multiplier(body, tangent, n_harmonics, start);
        return std::abs(found - start) < hill_correction ? found : start;
      }
      catch (const ConvergenceError &)
      {
        return start;
      }
    }
  } // namespace

  Complex largest_multiplier(const PeriodicBalance &balance, const StabilityMethod method,
                             const double mode_limit, const unsigned int hill_harmonics)
  {
    const ForcedBody &body = balance.linear_body();
    const double f = balance.excitation().frequency;
    const bool has_friction = balance.slipping_points() != nullptr, is_spring = balance.is_spring();
    // with friction all modes move: a static answer beside S makes friction unstable that is not
    const bool is_map = balance.n_active() > 0 && has_massless_points(balance) &&
                        (has_friction || SlipMap::resolves(body, f, balance.sampling().n_samples()));
    const Found found =
        is_map
            ? by_slip_map(balance)
            : Found{monodromy_multipliers(slow_part(body, 2 * M_PI * f * mode_limit), spring_like(balance)),
                    false};
    if (balance.n_active() == 0)
      return found.values[0];

    Complex other = 0;
    std::optional<double> real;
    for (const Complex &value : found.values)
      if (!is_positive(value))
        other = std::max(other, value, is_smaller);
      else
        real = std::max(real.value_or(0), value.real());
    const auto by_hill = [&](const Complex &start)
    {
      if (is_map || (is_spring && method != StabilityMethod::hill) || start == 0.)
        return start;
      return refined(body, is_spring ? spring_like(balance) : projection_tangent(balance),
                     is_spring ? hill_harmonics : balance.settings.n_functions / 2, start);
    };
    other = by_hill(other);

    const RealGrowth own(balance);
    const bool agrees = found.closed && (real.value_or(0) > 1) == own.is_unstable();
    if (!agrees || std::abs(std::log(real.value_or(0))) < near_fold)
    {
      std::optional<double> growth;
      if (own.is_unstable())
        growth = own.above_one(real.value_or(0) > 1 ? std::min(1.3 * std::log(*real) + 1e-3, 1.) : near_fold);
      else
        growth = own.below_one(std::clamp(std::log(std::abs(other)), -1., -near_fold));
      if (growth)
        real = std::exp(*growth);
      else if (real.value_or(0) > 1)
        real.reset(); // of a number that the sign says is even: an error of the matrix
      else if (real)
        real = std::abs(by_hill(*real)); // two of them between which no sign was asked
    }
    return std::max(Complex(real.value_or(0)), other, is_smaller);
  }
} // namespace vibrocontact
