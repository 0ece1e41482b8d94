#include <vibrocontact/analyses/stability/root_count.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/wall_clock.h>
#include <vibrocontact/coupled_bodies/contact_receptance.h>
#include <vibrocontact/numerics/lu_factors.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace vibrocontact
{
  namespace
  {
    using Complex = std::complex<double>;

    /// a of arg(s + a) [rad/s]
    constexpr double beyond_origin = 1e4;

    /// arg det F(s) - power arg(s + a), between -pi and pi
    double argument(const ContactReceptance &F, const Complex &s)
    {
      const ComplexMatrix matrix = F.value(s);
      const unsigned int size = matrix.m();
      std::vector<double> largest(size, 0.);
      for (unsigned int j = 0; j < size; ++j)
        for (unsigned int i = 0; i < size; ++i)
          largest[i] = std::max(largest[i], std::abs(matrix(i, j)));
      const auto refuse = [&]
      {
        throw ConvergenceError("The count of unstable roots met a singular contact at " +
                               number_text(std::abs(s) / (2 * dealii::numbers::PI)) +
                               " Hz: a root lies on the axis.");
      };
      // points that stick without rolling do not resist at 0 Hz
      if (!std::all_of(largest.begin(), largest.end(), [](const double value) { return value > 0; }))
        refuse();
      std::vector<Complex> scaled;
      for (unsigned int j = 0; j < size; ++j)
        for (unsigned int i = 0; i < size; ++i)
          scaled.push_back(matrix(i, j) / largest[i]);
      LuFactors<Complex> factors;
      if (!factors.factorise(std::move(scaled)))
        refuse();
      return std::remainder(factors.log_determinant().imag() - F.power() * std::arg(s + beyond_origin),
                            2 * dealii::numbers::PI);
    }

    /// A coarse net over everything [rad/s]
    std::vector<double> coarse_net()
    {
      std::vector<double> result = {0.};
      for (double w = 1; w < 1e11; w *= 1.15)
        result.push_back(w);
      return result;
    }

    /// The turn of the argument along a ray from the origin, at distances of a net and halved between them until it is short.
    double turn_along(const ContactReceptance &F, const Complex &direction, const std::vector<double> &net,
                      unsigned int &evaluations)
    {
      constexpr double longest_turn = 0.5;
      const auto evaluate = [&](const double distance)
      {
        ++evaluations;
        return argument(F, distance * direction);
      };
      const std::function<double(double, double, double, double, unsigned int)> turn =
          [&](const double w_0, const double arg_0, const double w_1, const double arg_1,
              const unsigned int depth)
      {
        const double step = std::remainder(arg_1 - arg_0, 2 * dealii::numbers::PI);
        if (std::abs(step) < longest_turn || depth == 0)
          return step;
        const double w = (w_0 + w_1) / 2, arg = evaluate(w);
        return turn(w_0, arg_0, w, arg, depth - 1) + turn(w, arg, w_1, arg_1, depth - 1);
      };
      double sum = 0, last = evaluate(net[0]);
      for (unsigned int k = 1; k < net.size(); ++k)
      {
        const double next = evaluate(net[k]);
        sum += turn(net[k - 1], last, net[k], next, 40);
        last = next;
      }
      return sum;
    }

    /// Frequencies round each free mode and each expected root from half its damping on, twice as far each
    /// time, and the coarse net [rad/s]
    /// @param damping_ratio of the modes, hysteretic loss included
    std::vector<double> frequencies(const ContactPair &pair, const std::vector<double> &damping_ratio,
                                    const std::vector<StabilityRoot> &expected)
    {
      std::vector<double> result = coarse_net();
      const auto add_round = [&](const double w, const double width)
      {
        result.push_back(w);
        for (double distance = width / 2; distance < 0.1 * w; distance *= 2)
        {
          result.push_back(w - distance);
          result.push_back(w + distance);
        }
      };
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
        add_round(pair.omega[k], damping_ratio[k] * pair.omega[k]);
      for (const StabilityRoot &root : expected)
      {
        const double w = 2 * dealii::numbers::PI * root.frequency;
        bool at_a_mode = false;
        for (unsigned int k = 0; k < pair.n_modes(); ++k)
          at_a_mode = at_a_mode || std::abs(w - pair.omega[k]) < damping_ratio[k] * pair.omega[k];
        if (!at_a_mode)
          add_round(w, std::max(std::abs(root.growth), 1e-8 * w));
      }
      std::sort(result.begin(), result.end());
      result.erase(std::unique(result.begin(), result.end(),
                               [](const double a, const double b) { return b - a < 1e-9 * b; }),
                   result.end());
      return result;
    }
  } // namespace

  RootCount count_unstable_roots(const ContactPair &pair, const CreepScheme &scheme,
                                 const RollingEquilibrium &equilibrium,
                                 const std::vector<StabilityRoot> &expected, const HystereticLoss *const loss)
  {
    std::vector<double> damping_ratio = pair.damping_ratio;
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
    {
      if (loss && pair.omega[k] > 0)
        damping_ratio[k] += loss->modal(k, k) / (2 * pair.omega[k] * pair.omega[k]);
      if (!(damping_ratio[k] > 0) || !(pair.omega[k] > 0))
        throw InputError("Stability/Second count needs modes with damping, but " + pair.labels[k] +
                         " has none: give the body a loss factor, or set it to false.");
    }
    const auto begin = WallClock::now();
    RootCount result;
    const ContactReceptance F(pair, scheme, equilibrium, loss);
    double turn =
        -turn_along(F, Complex(0, 1), frequencies(pair, damping_ratio, expected), result.evaluations);
    if (loss)
      turn += turn_along(F, 1., coarse_net(), result.evaluations);
    const double winding = turn / (loss ? 2 * dealii::numbers::PI : dealii::numbers::PI);
    result.unstable = std::lround(winding);
    result.remainder = winding - result.unstable;
    result.seconds = seconds_since(begin);
    return result;
  }
} // namespace vibrocontact
