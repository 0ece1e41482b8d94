#include <vibrocontact/base/complex_dense.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/coupled_bodies/body_roots.h>
#include <vibrocontact/numerics/complex_eigenvectors.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// shares of a frequency: own motions in one band, what is near to a band, masses that move by themselves near to it
    constexpr double band_width = 0.05, near_to_band = 0.12, near_mass = 0.4;
    /// roots with a smaller divergence rate are looked at more closely only if there are too few others
    constexpr double least_divergence_of_candidates = -5e-3;
    /// by how much of |s| a root that grows may seem to decay before it is settled
    constexpr double margin_of_growth = 1e-4;
    constexpr double settled_root = 1e-11, same_root = 1e-8;
    /// and how far from where its surroundings were taken one may be that is compared with others
    constexpr double near_enough = 3e-3;
    constexpr unsigned int most_passes = 60;

    /// q'' + diag(lambda) q = left g, motions right q: modes of K + j H, which H couples within small blocks.
    struct LossyModes
    {
      std::vector<Complex> lambda;
      /// motions x modes, modes x motions
      ComplexMatrix right, left;
    };

    LossyModes lossy_modes(const BareBody &body, const DenseMatrix &motions)
    {
      const unsigned int m = body.omega.size(), n = motions.m();
      LossyModes modes;
      modes.right.reinit(n, m);
      modes.left.reinit(m, n);
      modes.lambda.resize(m);
      std::vector<bool> done(m, false);
      for (unsigned int first = 0; first < m; ++first)
      {
        if (done[first])
          continue;
        std::vector<unsigned int> block = {first};
        done[first] = true;
        for (unsigned int i = 0; i < block.size(); ++i)
          for (unsigned int k = 0; k < m; ++k)
            if (!done[k] && body.loss(block[i], k) != 0)
            {
              done[k] = true;
              block.push_back(k);
            }
        std::sort(block.begin(), block.end());
        const unsigned int size = block.size();
        ComplexMatrix K(size, size);
        for (unsigned int j = 0; j < size; ++j)
        {
          for (unsigned int i = 0; i < size; ++i)
            K(i, j) = Complex(0, body.loss(block[i], block[j]));
          K(j, j) += body.omega[block[j]] * body.omega[block[j]];
        }
        ComplexEigenvectors own;
        if (size == 1)
        {
          own.values = {K(0, 0)};
          own.right.reinit(1, 1);
          own.left.reinit(1, 1);
          own.right(0, 0) = own.left(0, 0) = 1;
        }
        else
          own = complex_eigenvectors(K, "modes of body 1 with loss");
        std::vector<unsigned int> order(size);
        std::iota(order.begin(), order.end(), 0u);
        std::sort(order.begin(), order.end(),
                  [&](const unsigned int a, const unsigned int b)
                  { return own.values[a].real() < own.values[b].real(); });
        for (unsigned int e = 0; e < size; ++e)
        {
          modes.lambda[block[e]] = own.values[order[e]];
          for (unsigned int i = 0; i < size; ++i)
            for (unsigned int r = 0; r < n; ++r)
            {
              modes.right(r, block[e]) += motions(r, block[i]) * own.right(i, order[e]);
              modes.left(block[e], r) += own.left(order[e], i) * motions(r, block[i]);
            }
        }
      }
      return modes;
    }

    Complex stiffness_of(const AttachedMass &one)
    {
      return one.stiffness() * Complex(1, one.loss_factor);
    }

    /// What a mass that moves with body 1 holds against its place at s [N/m].
    Complex dynamic_stiffness(const AttachedMass &one, const Complex &s)
    {
      const Complex inertia = one.mass * s * s;
      return one.is_sprung() ? stiffness_of(one) * inertia / (stiffness_of(one) + inertia) : inertia;
    }

    /// The roots of a band: modes and masses near to it.
    class Band
    {
    public:
      Band(const unsigned int n_patch, const LossyModes &modes, const std::vector<AttachedMass> &masses,
           const double low, const double high)
          : modes(modes), masses(masses), n_patch(n_patch)
      {
        for (unsigned int k = 0; k < modes.lambda.size(); ++k)
        {
          const double w = std::sqrt(std::max(0., modes.lambda[k].real()));
          (w > low * (1 - near_to_band) && w < high * (1 + near_to_band) ? near : far).push_back(k);
        }
        for (unsigned int a = 0; a < masses.size(); ++a)
          if (masses[a].is_sprung() && masses[a].omega > low * (1 - near_mass) &&
              masses[a].omega < high * (1 + near_mass))
            moving.push_back(a);
        const unsigned int n_rows = n_patch + masses.size(), n_near = near.size();
        right.reinit(n_rows, size());
        left.reinit(size(), n_rows);
        right_far.reinit(n_rows, far.size());
        left_far.reinit(far.size(), n_rows);
        real_left_far.reinit(far.size(), n_rows);
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int j = 0; j < far.size(); ++j)
          {
            right_far(r, j) = modes.right(r, far[j]);
            left_far(j, r) = modes.left(far[j], r);
            real_left_far(j, r) = left_far(j, r).real();
            has_real_modes = has_real_modes && left_far(j, r).imag() == 0;
          }
        for (unsigned int j = 0; j < n_near; ++j)
          for (unsigned int r = 0; r < n_rows; ++r)
          {
            right(r, j) = modes.right(r, near[j]);
            left(j, r) = modes.left(near[j], r);
          }
        for (unsigned int j = 0; j < moving.size(); ++j)
        {
          const unsigned int row = n_patch + moving[j];
          right(row, n_near + j) = left(n_near + j, row) = -1 / std::sqrt(masses[moving[j]].mass);
        }
      }

      unsigned int size() const { return near.size() + moving.size(); }

      /// Eigenvalues -s^2 of what is near, with all that follows taken at s.
      ComplexEigenvectors eigenvalues(AnswerOfRest &rest, const Complex &s)
      {
        const unsigned int n_rows = right.m(), n = size();
        ComplexMatrix C(n_rows, n_rows), weighted = right_far, X = right;
        const ComplexMatrix T = rest.at(s);
        add_block(C, T, 0, 0);
        for (unsigned int a = 0; a < masses.size(); ++a)
          C(n_patch + a, n_patch + a) = dynamic_stiffness(masses[a], s);
        for (const unsigned int a : moving)
          C(n_patch + a, n_patch + a) = stiffness_of(masses[a]);
        for (unsigned int j = 0; j < far.size(); ++j)
        {
          const Complex factor = 1. / (s * s + modes.lambda[far[j]]);
          for (unsigned int i = 0; i < n_rows; ++i)
            weighted(i, j) *= factor;
        }
        ComplexMatrix Z = product(of_far(weighted), C);
        for (unsigned int i = 0; i < n_rows; ++i)
          Z(i, i) += 1;
        Z.compute_lu_factorization();
        Z.solve(X);
        forces = product(C, X);
        ComplexMatrix S = product(left, forces);
        for (unsigned int i = 0; i < near.size(); ++i)
          S(i, i) += modes.lambda[near[i]];
        return n == 1 ? alone(S(0, 0)) : complex_eigenvectors(S, "roots near modes of body 1");
      }

      /// Amplitudes of all modes at the s last asked for. @param v of what is near
      std::vector<Complex> amplitudes(const Complex &s, const std::vector<Complex> &v) const
      {
        std::vector<Complex> result(modes.lambda.size());
        for (unsigned int i = 0; i < near.size(); ++i)
          result[near[i]] = v[i];
        for (const unsigned int k : far)
        {
          Complex force = 0;
          for (unsigned int r = 0; r < forces.m(); ++r)
            for (unsigned int j = 0; j < forces.n(); ++j)
              force += modes.left(k, r) * forces(r, j) * v[j];
          result[k] = -force / (s * s + modes.lambda[k]);
        }
        return result;
      }

    private:
      /// weighted left_far, in half of the time if the modes are real
      ComplexMatrix of_far(const ComplexMatrix &weighted) const
      {
        return has_real_modes
                   ? mapped(weighted, [&](const DenseMatrix &part) { return product(part, real_left_far); })
                   : product(weighted, left_far);
      }
      static ComplexEigenvectors alone(const Complex &value)
      {
        ComplexEigenvectors one;
        one.values = {value};
        one.right.reinit(1, 1);
        one.right(0, 0) = 1;
        return one;
      }

      const LossyModes &modes;
      const std::vector<AttachedMass> &masses;
      const unsigned int n_patch;
      std::vector<unsigned int> near, far, moving;
      ComplexMatrix right, left, right_far, left_far, forces;
      DenseMatrix real_left_far;
      bool has_real_modes = true;
    };

    /// Im s > 0
    Complex root_of(const Complex &eigenvalue)
    {
      return Complex(0, 1) * std::sqrt(eigenvalue);
    }

    struct Candidate
    {
      Complex s;
      std::vector<Complex> v;
      unsigned int band;
    };

    std::vector<Complex> column(const ComplexMatrix &matrix, const unsigned int j)
    {
      std::vector<Complex> result(matrix.m());
      double norm = 0;
      for (unsigned int i = 0; i < result.size(); ++i)
        norm += std::norm(result[i] = matrix(i, j));
      for (Complex &value : result)
        value /= std::sqrt(norm);
      return result;
    }

    double likeness(const std::vector<Complex> &a, const std::vector<Complex> &b)
    {
      Complex sum = 0;
      for (unsigned int i = 0; i < a.size(); ++i)
        sum += std::conj(a[i]) * b[i];
      return std::norm(sum);
    }

    /// @param at where `root` was found @param tolerance of |s|
    void settle(Band &band, AnswerOfRest &rest, Complex at, const double tolerance, Candidate &root)
    {
      Complex before = 0, change_before = 0;
      for (unsigned int pass = 0; pass < most_passes; ++pass)
      {
        if (std::abs(root.s - at) < tolerance * std::abs(root.s))
          return;
        at = root.s;
        const ComplexEigenvectors all = band.eigenvalues(rest, root.s);
        double best = -1;
        Complex next;
        std::vector<Complex> v;
        for (unsigned int k = 0; k < all.values.size(); ++k)
        {
          const std::vector<Complex> other = column(all.right, k);
          const double far = std::abs(root_of(all.values[k]) - root.s) / std::abs(root.s),
                       like = likeness(root.v, other) / (1 + 1e3 * far);
          if (like > best)
          {
            best = like;
            next = root_of(all.values[k]);
            v = other;
          }
        }
        // the secant of what a pass changes, once that grows smaller
        const Complex change = next - at;
        root.s = pass > 0 && std::abs(change) < 0.1 * std::abs(change_before)
                     ? at - change * (at - before) / (change - change_before)
                     : next;
        root.v = v;
        before = at;
        change_before = change;
      }
      throw ConvergenceError("The root near " + number_text(root.s.imag() / (2 * dealii::numbers::PI)) +
                             " Hz of body 1 with its dampers does not settle: set Stability/Roots to all.");
    }

    double divergence(const Candidate &one)
    {
      return one.s.real() / one.s.imag();
    }

    /// That with the largest divergence rate first.
    void sort_by_divergence(std::vector<Candidate> &candidates)
    {
      std::stable_sort(candidates.begin(), candidates.end(),
                       [](const Candidate &a, const Candidate &b) { return divergence(a) > divergence(b); });
    }

    /// settle(), which one that decays fast need not.
    bool settles(Band &band, AnswerOfRest &rest, const Complex &at, const double tolerance, Candidate &root)
    {
      const bool decays_fast = divergence(root) < least_divergence_of_candidates;
      try
      {
        settle(band, rest, at, tolerance, root);
      }
      catch (const ConvergenceError &)
      {
        if (!decays_fast)
          throw;
        return false;
      }
      return true;
    }

    /// Lowest and highest own frequency of each band [rad/s].
    std::vector<std::pair<double, double>> bands_of(const BareBody &body,
                                                    const std::vector<AttachedMass> &masses)
    {
      std::vector<double> own = body.omega;
      for (const AttachedMass &one : masses)
        if (one.is_sprung())
          own.push_back(one.omega);
      std::sort(own.begin(), own.end());
      std::vector<std::pair<double, double>> bands;
      for (const double w : own)
        if (w > 0 && (bands.empty() || w > bands.back().first * (1 + band_width)))
          bands.emplace_back(w, w);
        else if (w > 0)
          bands.back().second = w;
      return bands;
    }
  } // namespace

  std::vector<StabilityRoot> roots_of_body(AnswerOfRest &nearly, AnswerOfRest &rest, const BareBody &body,
                                           const std::vector<AttachedMass> &masses,
                                           const unsigned int n_wanted)
  {
    const unsigned int m = body.omega.size(), n_patch = rest.basis().n();
    DenseMatrix motions(n_patch + masses.size(), m);
    add_block(motions, body.amplitudes, 0, 0);
    for (unsigned int a = 0; a < masses.size(); ++a)
      for (unsigned int k = 0; k < m; ++k)
        motions(n_patch + a, k) = masses[a].motion[k];
    const LossyModes modes = lossy_modes(body, motions);
    const std::vector<std::pair<double, double>> bands = bands_of(body, masses);
    std::vector<Band> all_bands;
    std::vector<Candidate> candidates;
    for (unsigned int b = 0; b < bands.size(); ++b)
    {
      const auto [low, high] = bands[b];
      all_bands.emplace_back(n_patch, modes, masses, low, high);
      // bands meet in the middle between their own frequencies
      const double from = b == 0 ? 0.5 * low : (bands[b - 1].second + low) / 2,
                   to = b + 1 == bands.size() ? 1.5 * high : (high + bands[b + 1].first) / 2;
      const ComplexEigenvectors found = all_bands.back().eigenvalues(nearly, Complex(0, (low + high) / 2));
      for (unsigned int k = 0; k < found.values.size(); ++k)
        if (const Complex s = root_of(found.values[k]); s.imag() >= from && s.imag() < to)
          candidates.push_back({s, column(found.right, k), b});
    }
    sort_by_divergence(candidates);
    while (candidates.size() > n_wanted && divergence(candidates.back()) < least_divergence_of_candidates)
      candidates.pop_back();
    // far from the band's middle growth is not yet that of a root
    std::vector<Candidate> chosen;
    for (Candidate &one : candidates)
    {
      const auto [low, high] = bands[one.band];
      if (settles(all_bands[one.band], nearly, Complex(0, (low + high) / 2), near_enough, one))
        chosen.push_back(std::move(one));
    }
    sort_by_divergence(chosen);
    std::vector<StabilityRoot> roots;
    std::vector<Complex> known;
    for (Candidate &one : chosen)
    {
      if (known.size() >= n_wanted && !(divergence(one) > -margin_of_growth))
        break;
      if (!settles(all_bands[one.band], rest, 0, settled_root, one))
        continue;
      if (std::any_of(known.begin(), known.end(),
                      [&](const Complex &s) { return std::abs(s - one.s) < same_root * std::abs(s); }))
        continue;
      if (known.size() >= n_wanted && !(one.s.real() > 0))
        continue;
      known.push_back(one.s);
      roots.push_back(
          named_root(one.s, all_bands[one.band].amplitudes(one.s, one.v), body.omega, body.labels));
    }
    if (roots.empty())
      throw ConvergenceError(
          "No root near the modes of body 1 and its dampers oscillates: set Stability/Roots to all.");
    sort_roots(roots);
    return roots;
  }
} // namespace vibrocontact
