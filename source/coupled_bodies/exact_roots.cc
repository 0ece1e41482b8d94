#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/contact_root.h>
#include <vibrocontact/coupled_bodies/exact_roots.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    constexpr double two_pi = 2 * dealii::numbers::PI;
    /// of |s|: step of the difference, how far the straight line holds, how far a root may move, how near two are one
    constexpr double step = 1e-4, straight = 2e-4, farthest = 0.02, equal = 1e-10;
    /// in which the poles turn into the exact receptance
    constexpr unsigned int n_shares = 5;

    /// Of a body about some s: value + slope (s - about), exact and by its poles, and the share of the former.
    struct Line
    {
      Complex about;
      ComplexMatrix exact, exact_slope, fitted, fitted_slope;
      double share = 0;

      void put(const ExactReceptance &body, const Complex &s)
      {
        about = s;
        const Complex h(0, step * std::abs(s));
        exact = body.at(s);
        fitted = body.by_poles(s);
        exact_slope = quotient(body.at(s + h), exact, h);
        fitted_slope = quotient(body.by_poles(s + h), fitted, h);
      }
      ComplexMatrix slope() const { return mean(exact_slope, fitted_slope); }
      ComplexMatrix value(const Complex &s) const
      {
        ComplexMatrix result = mean(exact, fitted);
        result.add(s - about, slope());
        return result;
      }

    private:
      static ComplexMatrix quotient(const ComplexMatrix &far, const ComplexMatrix &near, const Complex &h)
      {
        ComplexMatrix result(near.m(), near.n());
        result.add(1. / h, far);
        result.add(-1. / h, near);
        return result;
      }
      ComplexMatrix mean(const ComplexMatrix &one, const ComplexMatrix &other) const
      {
        ComplexMatrix result(one.m(), one.n());
        result.add(share, one);
        result.add(1. - share, other);
        return result;
      }
    };
  } // namespace

  double make_exact(std::vector<StabilityRoot> &roots, const ContactPair &pair, const CreepScheme &scheme,
                    const RollingEquilibrium &equilibrium, const HystereticLoss &loss)
  {
    std::vector<unsigned int> order;
    for (unsigned int k = 0; k < roots.size(); ++k)
      if (roots[k].frequency > 0)
        order.push_back(k);
    std::stable_sort(order.begin(), order.end(),
                     [&](const unsigned int a, const unsigned int b)
                     { return roots[a].divergence_rate > roots[b].divergence_rate; });
    order.resize(std::min<std::size_t>(order.size(), n_exact_roots));
    std::vector<std::shared_ptr<Line>> lines;
    std::vector<PatchReceptance> by_lines;
    for (const ExactReceptance &body : loss.exact)
    {
      const auto line = std::make_shared<Line>();
      lines.push_back(line);
      by_lines.push_back({body.basis, [line](const Complex &s) { return line->value(s); },
                          [line](const Complex &) { return line->slope(); }});
    }
    const ContactReceptance F(pair, scheme, equilibrium, &loss, by_lines);
    const auto put_lines = [&](const Complex &s)
    {
      for (unsigned int b = 0; b < lines.size(); ++b)
        lines[b]->put(loss.exact[b], s);
    };
    const auto root_with = [&](const double share, const Complex &s, const std::vector<Complex> &x)
    {
      for (const auto &line : lines)
        line->share = share;
      return contact_root(F, s, x);
    };
    double largest_change = 0;
    std::vector<Complex> found;
    for (const unsigned int k : order)
    {
      StabilityRoot &root = roots[k];
      const Complex start(root.growth, two_pi * root.frequency);
      put_lines(start);
      ContactRoot at = root_with(0, start, {});
      for (unsigned int i = 1; i <= n_shares; ++i)
        at = root_with(double(i) / n_shares, at.s, at.x);
      for (Complex before = start; std::abs(at.s - before) > straight * std::abs(before);)
      {
        before = at.s;
        put_lines(before);
        at = root_with(1, before, at.x);
      }
      const Complex s = at.s;
      if (!(std::abs(s - start) < farthest * std::abs(start)))
        throw ConvergenceError("The root of " + root.label + " near " + number_text(root.frequency) +
                               " Hz is not found with the exact receptance: ask for more pairs of poles.");
      for (const Complex &other : found)
        if (std::abs(s - other) < equal * std::abs(s))
          throw ConvergenceError("Two roots near " + number_text(root.frequency) +
                                 " Hz become one with the exact receptance: ask for more pairs of poles.");
      found.push_back(s);
      if (root.growth > 0 || s.real() > 0)
        largest_change = std::max(largest_change, std::abs(s.real() - root.growth));
      root.frequency = s.imag() / two_pi;
      root.growth = s.real();
      root.divergence_rate = s.real() / s.imag();
    }
    sort_roots(roots);
    return largest_change;
  }
} // namespace vibrocontact
