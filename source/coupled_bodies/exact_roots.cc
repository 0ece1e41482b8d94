#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/contact_root.h>
#include <vibrocontact/coupled_bodies/exact_roots.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    constexpr double two_pi = 2 * dealii::numbers::PI;
    /// of |s|: step of the difference, how far a root may move by the last line and be settled, how far in all, how near two are one
    constexpr double step = 1e-4, settled = 1e-7, farthest = 0.02, equal = 1e-10;
    /// in which the poles turn into the exact receptance
    constexpr unsigned int n_shares = 5;
    /// of |s|: how far the root of the eigenproblem may be from one of the contact's equations with the same poles
    constexpr double same_equations = 1e-6;
    constexpr unsigned int most_lines = 20;

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
      /// Of share 1 alone: the exact one, with the slope of the secant from where it was.
      void move(const ExactReceptance &body, const Complex &s)
      {
        const ComplexMatrix here = body.at(s);
        exact_slope = quotient(here, exact, s - about);
        exact = here;
        about = s;
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

    bool is_exact(const HystereticLoss &loss, const unsigned int body)
    {
      return std::any_of(loss.exact.begin(), loss.exact.end(),
                         [&](const ExactReceptance &one) { return one.body == body; });
    }

    /// After the mode or pole with the largest share, of bodies that are no fits.
    void name_after_mode(const ContactPair &pair, const HystereticLoss &loss, const Complex &s,
                         StabilityRoot &root)
    {
      const unsigned int m = pair.n_modes();
      std::vector<Complex> shape = root.shape;
      for (unsigned int k = 0; k < pair.n_poles(); ++k)
        if (is_exact(loss, pair.body_of_pole[k]))
          shape[m + k] = 0;
      const StabilityRoot named = named_root(s, std::move(shape), pair.frequencies(), pair.labels);
      root.label = named.label;
      root.share = named.share;
    }

    std::set<std::string> labels_of_fits(const ContactPair &pair, const HystereticLoss &loss)
    {
      std::set<std::string> result;
      for (unsigned int k = 0; k < pair.n_poles(); ++k)
        if (is_exact(loss, pair.body_of_pole[k]))
          result.insert(pair.labels[pair.n_modes() + k]);
      return result;
    }
  } // namespace

  void make_exact(std::vector<StabilityRoot> &roots, const ContactPair &pair, const CreepScheme &scheme,
                  const RollingEquilibrium &equilibrium, const HystereticLoss &loss)
  {
    std::stable_sort(roots.begin(), roots.end(),
                     [](const StabilityRoot &a, const StabilityRoot &b)
                     { return a.divergence_rate > b.divergence_rate; });
    const std::set<std::string> of_fits = labels_of_fits(pair, loss);
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
    const auto found_from = [&](const Complex &start)
    {
      put_lines(start);
      ContactRoot at = root_with(0, start, {});
      if (!(std::abs(at.s - start) < same_equations * std::abs(start)))
        throw ConvergenceError("The contact's own equations do not have it by the poles.");
      for (unsigned int i = 1; i <= n_shares; ++i)
        at = root_with(double(i) / n_shares, at.s, at.x);
      unsigned int n_lines = 0;
      for (Complex before = start; std::abs(at.s - before) > settled * std::abs(before);)
      {
        if (++n_lines > most_lines || !(std::abs(at.s - start) < farthest * std::abs(start)))
          throw ConvergenceError("It leads elsewhere.");
        before = at.s;
        for (unsigned int b = 0; b < lines.size(); ++b)
          lines[b]->move(loss.exact[b], before);
        at = root_with(1, before, at.x);
      }
      return at.s;
    };

    double least_divergence = least_exact_divergence, up_to = 1e300;
    for (const ExactReceptance &body : loss.exact)
    {
      // where waves still decay along the body
      least_divergence = std::max(least_divergence, -body.loss / 4);
      up_to = std::min(up_to, body.up_to);
    }
    std::vector<Complex> found;
    std::vector<StabilityRoot> kept;
    for (StabilityRoot &root : roots)
    {
      const bool of_fit = of_fits.count(root.label) > 0;
      const bool grows = root.growth > 0;
      if (root.frequency == 0 && of_fit && grows)
        throw ConvergenceError("The poles near the receptance of " +
                               root.label.substr(0, root.label.find(':')) +
                               " make a root that grows without oscillation: change its Pole pairs.");
      if (root.frequency > up_to && grows)
        throw ConvergenceError("The root of " + root.label + " at " + number_text(root.frequency) +
                               " Hz grows by poles that end at " + number_text(up_to) +
                               " Hz: raise Fitted up to, or keep fewer modes.");
      if (root.frequency == 0 || root.frequency > up_to || root.divergence_rate < least_divergence ||
          (found.size() >= n_exact_roots && !grows))
      {
        if (!of_fit)
          kept.push_back(std::move(root));
        continue;
      }
      Complex s;
      try
      {
        s = found_from({root.growth, two_pi * root.frequency});
      }
      catch (const ConvergenceError &error)
      {
        if (of_fit)
          continue;
        throw ConvergenceError("The root of " + root.label + " near " + number_text(root.frequency) +
                               " Hz is not found with the exact receptance: change Pole pairs. " +
                               error.what());
      }
      const bool known =
          std::any_of(found.begin(), found.end(),
                      [&](const Complex &other) { return std::abs(s - other) < equal * std::abs(s); });
      if (known && of_fit)
        continue;
      if (known)
        throw ConvergenceError("Two roots near " + number_text(root.frequency) +
                               " Hz become one with the exact receptance: change Pole pairs.");
      found.push_back(s);
      root.frequency = s.imag() / two_pi;
      root.growth = s.real();
      root.divergence_rate = s.real() / s.imag();
      root.exact = true;
      root.states.clear();
      if (of_fit)
        name_after_mode(pair, loss, s, root);
      kept.push_back(std::move(root));
    }
    roots = std::move(kept);
    sort_roots(roots);
  }
} // namespace vibrocontact
