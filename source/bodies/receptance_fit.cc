#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/bodies/passive_fit.h>
#include <vibrocontact/bodies/passivity_test.h>
#include <vibrocontact/bodies/receptance_fit.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/vector_fitting.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// a [rad/s]
    constexpr double slow = 2 * dealii::numbers::PI * 0.1;
    /// share of what follows forces at once that a fit has to leave to do so, where roots are sought from and in time
    constexpr double least_at_once = 0.2, least_at_once_in_time = 0.6;
    /// entries below, of the largest at a line, are round-off of a symmetry
    constexpr double round_off = 1e-9;
    /// lines below count less: no poles follow a constant loss down to 0 Hz [rad/s]
    constexpr double fully_counted = 2 * dealii::numbers::PI * 100;
    /// what lines outside the bands count, how little of it low ones at least, and what rest counts
    constexpr double outside_bands = 0.05, least_counted = 0.05, rest_counts = 100;
    constexpr unsigned int most_weightings = 5;
    /// rates [rad/s] and size, of the mean ones, of real poles that cover what the tolerance of a passive fit leaves
    constexpr double rates_of_cover[] = {2 * dealii::numbers::PI * 20, 2 * dealii::numbers::PI * 500},
                     cover_sizes[] = {1e-5, 1e-4, 1e-3}, left_to_cover = 2e-3;
    /// share of what follows forces at once that has to be left in the end
    constexpr double least_left_at_once = 0.05;

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
    /// @param counts what a line counts at omega, over its size
    std::pair<Spectra, EntryMap> spectra_of(const ReceptanceLines &lines,
                                            const std::function<double(double)> &counts)
    {
      const unsigned int n = lines.values.front().m();
      const std::vector<double> mean = mean_sizes(lines);
      Spectra data;
      data.omega = lines.omega;
      for (unsigned int l = 0; l < lines.omega.size(); ++l)
        data.weight.push_back(counts(lines.omega[l]) / relative_size(lines.values[l], mean));
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
    DenseMatrix direct_term(const PoleFit &fit, const EntryMap &map, const DenseMatrix &at_once,
                            const double least)
    {
      const unsigned int n = map.n_rows;
      DenseMatrix D(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          D(i, j) = fit.direct[map.entry[i * n + j]];
      const DenseMatrix root = function_of(at_once, [](const double w) { return std::sqrt(w); }),
                        inverse = function_of(at_once, [](const double w) { return 1 / std::sqrt(w); }),
                        share = function_of(product(inverse, product(D, inverse)),
                                            [&](const double w) { return std::max(w, least); });
      return product(root, product(share, root));
    }

    /// X a / (s + a) as real poles, one for each eigenvalue but for those of rounding
    void add_real_poles(const DenseMatrix &X, const double rate, BodyInContact &body)
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
      body.left = widened(body.left, [&](const unsigned int k) { return values[k] * rate / 2; });
      body.poles.resize(before + kept.size(), -rate);
      body.pole_load.resize(before + kept.size(), 0.);
    }

    /// Poles and residues of what a direct term leaves, which is D.
    PoleFit poles_beside_direct(Spectra &data, const EntryMap &map, const DenseMatrix &at_once,
                                const double least, const unsigned int n_pairs, DenseMatrix &D,
                                bool &converged)
    {
      VectorFittingOptions options;
      options.rules.direct = true;
      const PoleFit fit = vector_fit(data, n_pairs, options);
      converged = fit.converged;
      D = direct_term(fit, map, at_once, least);
      for (unsigned int i = 0; i < map.n_rows; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          for (Complex &value : data.values[map.entry[i * map.n_rows + j]])
            value -= D(i, j);
      return fit_residues(data, fit.poles);
    }

    /// What a body has too little of at rest, symmetric.
    DenseMatrix missing_at_rest(const DenseMatrix &at_rest, const BodyInContact &body)
    {
      DenseMatrix X = at_rest;
      X.add(-1., body.residual);
      X.add(-1., sum_over_poles(body, static_weights(body)));
      for (unsigned int i = 0; i < X.m(); ++i)
        for (unsigned int j = 0; j < i; ++j)
          X(i, j) = X(j, i) = (X(i, j) + X(j, i)) / 2;
      return X;
    }

    /// A_ij (d_i d_j)^sign
    DenseMatrix scaled_rows(DenseMatrix A, const std::vector<double> &sizes, const int sign)
    {
      for (unsigned int i = 0; i < A.m(); ++i)
        for (unsigned int j = 0; j < A.n(); ++j)
          A(i, j) *= std::pow(sizes[i] * sizes[j], sign);
      return A;
    }

    std::vector<double> errors_on(const ReceptanceLines &lines, const BodyInContact &body)
    {
      std::vector<double> result;
      for (unsigned int l = 0; l < lines.omega.size(); ++l)
      {
        ComplexMatrix difference = receptance(body, lines.omega[l]);
        difference.add(-1., lines.values[l]);
        result.push_back(relative_size(difference, sizes_of_rows(lines.values[l])));
      }
      return result;
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
    auto [data, map] =
        spectra_of(lines, [](const double omega) { return std::min(1., omega / fully_counted); });
    ReceptanceFit result;
    DenseMatrix D;
    const PoleFit fit = poles_beside_direct(data, map, at_once, least_at_once, n_pairs, D, result.converged);
    result.body = identified_model(fit, map, 1e-9).model;
    result.body.residual = D;
    add_real_poles(missing_at_rest(at_rest, result.body), slow, result.body);
    result.error = errors_on(lines, result.body);
    return result;
  }

  namespace
  {
    /// @param band_counts what the lines of each band count
    ReceptanceFit passive_fit_once(const ReceptanceLines &lines, const std::vector<FrequencyBand> &bands,
                                   const std::vector<double> &band_counts, const DenseMatrix &at_rest,
                                   const DenseMatrix &at_once, const unsigned int n_pairs)
    {
      const std::vector<double> sizes = mean_sizes(lines);
      // rows of different units as equals
      ReceptanceLines scaled;
      ComplexMatrix elastic(at_rest.m(), at_rest.n());
      for (unsigned int i = 0; i < at_rest.m(); ++i)
        for (unsigned int j = 0; j < at_rest.n(); ++j)
          elastic(i, j) = at_rest(i, j) / (sizes[i] * sizes[j]) - (i == j ? left_to_cover : 0.);
      if (lines.omega.front() > 0)
      {
        scaled.omega.push_back(0);
        scaled.values.push_back(elastic);
      }
      for (unsigned int l = 0; l < lines.omega.size(); ++l)
      {
        scaled.omega.push_back(lines.omega[l]);
        scaled.values.push_back(lines.values[l]);
        for (unsigned int i = 0; i < sizes.size(); ++i)
          for (unsigned int j = 0; j < sizes.size(); ++j)
            scaled.values.back()(i, j) /= sizes[i] * sizes[j];
      }
      const auto counts = [&](const double omega)
      {
        if (omega == 0)
          return rest_counts;
        double inside = 0;
        for (unsigned int b = 0; b < bands.size(); ++b)
          if (bands[b].holds(omega))
            inside = std::max(inside, band_counts[b]);
        return inside > 0 ? inside : outside_bands * std::clamp(omega / fully_counted, least_counted, 1.);
      };
      auto [data, map] = spectra_of(scaled, counts);
      ReceptanceFit result;
      DenseMatrix D;
      PoleFit fit = poles_beside_direct(data, map, scaled_rows(at_once, sizes, -1), least_at_once_in_time,
                                        n_pairs, D, result.converged);
      const PassiveFit passive = nearest_passive_fit(data, fit, map, {});
      result.change = passive.change;
      BodyInContact poles = identified_model(passive.fit, map, 1e-10).model;
      poles.residual = D;
      DenseMatrix vectors;
      for (const double cover : cover_sizes)
      {
        result.body = poles;
        DenseMatrix even(sizes.size(), sizes.size());
        for (unsigned int i = 0; i < sizes.size(); ++i)
          even(i, i) = cover;
        for (const double rate : rates_of_cover)
          add_real_poles(even, rate, result.body);
        const DenseMatrix X = missing_at_rest(scaled_rows(at_rest, sizes, -1), result.body),
                          slowly = function_of(X, [](const double w) { return std::max(w, 0.); });
        result.body.residual.add(1., X);
        result.body.residual.add(-1., slowly);
        add_real_poles(slowly, slow, result.body);
        if (test_passivity(result.body).is_passive())
        {
          result.passive = true;
          break;
        }
      }
      result.body.residual = scaled_rows(result.body.residual, sizes, 1);
      const DenseMatrix inverse = function_of(at_once, [](const double w) { return 1 / std::sqrt(w); });
      result.passive =
          result.passive &&
          symmetric_eigenvalues(product(inverse, product(result.body.residual, inverse)), vectors).front() >
              least_left_at_once;
      for (unsigned int k = 0; k < result.body.n_poles(); ++k)
        for (unsigned int i = 0; i < sizes.size(); ++i)
        {
          result.body.right(i, k) *= sizes[i];
          result.body.left(i, k) *= sizes[i];
        }
      result.error = errors_on(lines, result.body);
      return result;
    }
  } // namespace

  std::vector<double> errors_in_bands(const ReceptanceFit &fit, const ReceptanceLines &lines,
                                      const std::vector<FrequencyBand> &bands)
  {
    std::vector<double> worst(bands.size(), 0.);
    for (unsigned int l = 0; l < lines.omega.size(); ++l)
      for (unsigned int b = 0; b < bands.size(); ++b)
        if (bands[b].holds(lines.omega[l]))
          worst[b] = std::max(worst[b], fit.error[l]);
    return worst;
  }

  ReceptanceFit passive_receptance_fit(const ReceptanceLines &lines, const std::vector<FrequencyBand> &bands,
                                       const DenseMatrix &at_rest, const DenseMatrix &at_once,
                                       const unsigned int n_pairs)
  {
    ReceptanceFit best;
    double least = 1e300;
    std::vector<double> counts(bands.size(), 1.);
    for (unsigned int round = 0; round < most_weightings && !(best.passive && least < 1); ++round)
    {
      ReceptanceFit fit = passive_fit_once(lines, bands, counts, at_rest, at_once, n_pairs);
      std::vector<double> errors = errors_in_bands(fit, lines, bands);
      for (unsigned int b = 0; b < bands.size(); ++b)
        errors[b] /= bands[b].aimed_error;
      const double worst = errors.empty() ? 0. : *std::max_element(errors.begin(), errors.end());
      for (unsigned int b = 0; b < bands.size(); ++b)
        counts[b] *= std::clamp(errors[b], 1., 3.);
      if (round == 0 || (fit.passive && (!best.passive || worst < least)))
      {
        least = worst;
        best = std::move(fit);
      }
    }
    return best;
  }
} // namespace vibrocontact
