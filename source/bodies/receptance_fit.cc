#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/bodies/receptance_fit.h>
#include <vibrocontact/numerics/least_squares.h>
#include <vibrocontact/numerics/vector_fitting.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// a [rad/s]
    constexpr double slow = 2 * dealii::numbers::PI * 0.1;
    /// share of what follows forces at once that a fit has to leave to do so
    constexpr double least_at_once = 0.2;
    /// entries below, of the largest at a line, are round-off of a symmetry
    constexpr double round_off = 1e-9;
    /// lines below count less: no poles follow a constant loss down to 0 Hz [rad/s]
    constexpr double fully_counted = 2 * dealii::numbers::PI * 100;

    /// sqrt |G_ii| at a line, or means of these over all lines
    std::vector<double> sizes_of_rows(const ComplexMatrix &G)
    {
      std::vector<double> result;
      for (unsigned int i = 0; i < G.m(); ++i)
        result.push_back(std::sqrt(std::abs(G(i, i))));
      return result;
    }

    std::vector<double> mean_sizes(const ReceptanceLines &lines)
    {
      std::vector<double> result(lines.values.front().m(), 0.);
      for (const ComplexMatrix &G : lines.values)
        for (unsigned int i = 0; i < result.size(); ++i)
          result[i] += sizes_of_rows(G)[i] / lines.values.size();
      return result;
    }

    /// largest |G_ij| over the sizes of its rows
    double relative_size(const ComplexMatrix &G, const std::vector<double> &of_rows)
    {
      double largest = 0;
      for (unsigned int j = 0; j < G.n(); ++j)
        for (unsigned int i = 0; i < G.m(); ++i)
          largest = std::max(largest, std::abs(G(i, j)) / (of_rows[i] * of_rows[j]));
      return largest;
    }

    /// One entry for each pair of rows.
    std::pair<Spectra, EntryMap> spectra_of(const ReceptanceLines &lines)
    {
      const unsigned int n = lines.values.front().m();
      const std::vector<double> mean = mean_sizes(lines);
      Spectra data;
      data.omega = lines.omega;
      for (unsigned int l = 0; l < lines.omega.size(); ++l)
        data.weight.push_back(std::min(1., lines.omega[l] / fully_counted) /
                              relative_size(lines.values[l], mean));
      EntryMap map{n, std::vector<unsigned int>(n * n)};
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j <= i; ++j)
        {
          map.entry[i * n + j] = map.entry[j * n + i] = data.values.size();
          data.values.emplace_back();
          bool moves = false;
          for (const ComplexMatrix &G : lines.values)
          {
            const std::vector<double> size = sizes_of_rows(G);
            data.values.back().push_back(G(i, j));
            moves = moves || std::abs(G(i, j)) > round_off * size[i] * size[j];
          }
          if (!moves)
            std::fill(data.values.back().begin(), data.values.back().end(), 0.);
        }
      return {data, map};
    }

    /// V diag(f(w)) V^T of a symmetric matrix
    template <typename Function>
    DenseMatrix function_of(const DenseMatrix &A, const Function &f)
    {
      DenseMatrix V, scaled, result(A.m(), A.m());
      const std::vector<double> w = symmetric_eigenvalues(A, V);
      scaled = V;
      for (unsigned int k = 0; k < w.size(); ++k)
        for (unsigned int i = 0; i < w.size(); ++i)
          scaled(i, k) *= f(w[k]);
      scaled.mTmult(result, V);
      return result;
    }

    /// The direct term of a fit where it is at least a share of what follows forces at once, else that: A^1/2 max(A^-1/2 D
    /// A^-1/2, share) A^1/2.
    DenseMatrix direct_term(const PoleFit &fit, const EntryMap &map, const DenseMatrix &at_once)
    {
      const unsigned int n = map.n_rows;
      DenseMatrix D(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          D(i, j) = fit.direct[map.entry[i * n + j]];
      const DenseMatrix root = function_of(at_once, [](const double w) { return std::sqrt(w); }),
                        inverse = function_of(at_once, [](const double w) { return 1 / std::sqrt(w); }),
                        share = function_of(product(inverse, product(D, inverse)),
                                            [](const double w) { return std::max(w, least_at_once); });
      return product(root, product(share, root));
    }

    /// X a / (s + a) as real poles, one for each eigenvalue but for those of rounding
    void add_slow_part(DenseMatrix X, BodyInContact &body)
    {
      const unsigned int n = X.m(), before = body.n_poles();
      DenseMatrix vectors;
      const std::vector<double> values = symmetric_eigenvalues(X, vectors);
      const double largest = std::max(std::abs(values.front()), std::abs(values.back()));
      std::vector<unsigned int> kept;
      for (unsigned int k = 0; k < n; ++k)
        if (std::abs(values[k]) > 1e-12 * largest)
          kept.push_back(k);
      const auto widened = [&](const ComplexMatrix &shapes, const auto &factor)
      {
        ComplexMatrix result(n, before + kept.size());
        for (unsigned int i = 0; i < n; ++i)
        {
          for (unsigned int k = 0; k < before; ++k)
            result(i, k) = shapes(i, k);
          for (unsigned int k = 0; k < kept.size(); ++k)
            result(i, before + k) = factor(kept[k]) * vectors(i, kept[k]);
        }
        return result;
      };
      // a real pole carries half its residue
      body.right = widened(body.right, [](unsigned int) { return 1.; });
      body.left = widened(body.left, [&](const unsigned int k) { return values[k] * slow / 2; });
      body.poles.resize(before + kept.size(), -slow);
      body.pole_load.resize(before + kept.size(), 0.);
    }
  } // namespace

  double ReceptanceFit::worst_error() const
  {
    return *std::max_element(error.begin(), error.end());
  }

  unsigned int ReceptanceFit::worst_line() const
  {
    return std::max_element(error.begin(), error.end()) - error.begin();
  }

  ReceptanceFit fit_receptance(const ReceptanceLines &lines, const DenseMatrix &at_rest,
                               const DenseMatrix &at_once, const unsigned int n_pairs)
  {
    auto [data, map] = spectra_of(lines);
    VectorFittingOptions options;
    options.rules.direct = true;
    PoleFit fit = vector_fit(data, n_pairs, options);
    ReceptanceFit result;
    result.converged = fit.converged;
    const DenseMatrix D = direct_term(fit, map, at_once);
    const unsigned int n = map.n_rows;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        for (Complex &value : data.values[map.entry[i * n + j]])
          value -= D(i, j);
    fit = fit_residues(data, fit.poles);
    result.body = identified_model(fit, map, 1e-9).model;

    result.body.residual = D;
    DenseMatrix X = at_rest;
    X.add(-1., D);
    X.add(-1., sum_over_poles(result.body, static_weights(result.body)));
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < i; ++j)
        X(i, j) = X(j, i) = (X(i, j) + X(j, i)) / 2;
    add_slow_part(X, result.body);
    for (unsigned int l = 0; l < lines.omega.size(); ++l)
    {
      ComplexMatrix difference = receptance(result.body, lines.omega[l]);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          difference(i, j) -= lines.values[l](i, j);
      result.error.push_back(relative_size(difference, sizes_of_rows(lines.values[l])));
    }
    return result;
  }
} // namespace vibrocontact
