#include <vibrocontact/analyses/transient/mode_projection.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/coupled_bodies/pair_motion.h>
#include <vibrocontact/numerics/eigenvalues.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrocontact
{
  ModeProjection::ModeProjection(const ContactPair &pair, const CreepScheme &scheme,
                                 const RollingEquilibrium &equilibrium, const DynamicState &rest,
                                 const unsigned int n_roots, const std::string &also)
      : rest(rest)
  {
    LinearisationOptions options;
    options.stick = true;
    const DenseMatrix A = linearised_contact(pair, scheme, equilibrium, options);
    const unsigned int m = pair.n_modes(), size = A.m();
    if (size > 2 * m)
    {
      const SlidingFrame frame = sliding_frame(equilibrium);
      const unsigned int n = pair.n_points();
      across = frame.across;
      if (!pair.relaxing.empty())
      {
        shares = shares_in(span_of_forces(frame, n));
        across.clear();
        const DenseMatrix W = at_once(compliance_of_contact(pair, equilibrium), pair.relaxing);
        for (const unsigned int k : followed_at_once(W, frame.across, n))
          across.push_back(frame.across[k]);
      }
    }
    const Eigenvalues lambda = eigenvalues(A, true);

    std::vector<unsigned int> order;
    std::vector<StabilityRoot> roots;
    for (unsigned int k = 0; k < size; ++k)
    {
      std::vector<std::complex<double>> shape;
      if (lambda.values[k].imag() > 0)
      {
        for (unsigned int i = 0; i < m; ++i)
          shape.push_back(lambda.component(i, k));
        order.push_back(k);
      }
      roots.push_back(named_root(lambda.values[k], std::move(shape), pair.omega, pair.labels));
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](const unsigned int a, const unsigned int b)
                     { return roots[a].growth > roots[b].growth; });
    for (unsigned int place = 0; place < order.size(); ++place)
    {
      const unsigned int k = order[place];
      if (place >= n_roots && roots[k].label != also)
        continue;
      std::complex<double> product = 0;
      for (unsigned int i = 0; i < size; ++i)
        product += std::conj(lambda.left_component(i, k)) * lambda.component(i, k);
      double velocity = 0;
      for (unsigned int row = 0; row < pair.trace.m(); ++row)
      {
        std::complex<double> sum = 0;
        for (unsigned int i = 0; i < m; ++i)
          sum += pair.trace(row, i) * lambda.component(i, k);
        velocity = std::max(velocity, std::abs(lambda.values[k] * sum));
      }
      std::vector<std::complex<double>> weight(size);
      for (unsigned int i = 0; i < size; ++i)
        weight[i] = std::conj(lambda.left_component(i, k)) * (2 * velocity / product);
      weights.push_back(std::move(weight));
      kept.push_back(roots[k]);
    }
  }

  std::vector<double> ModeProjection::amplitudes(const DynamicState &state) const
  {
    const unsigned int m = state.q.size(), n = state.R.size() / 3;
    std::vector<double> x(2 * m), result;
    for (unsigned int i = 0; i < m; ++i)
    {
      x[i] = state.q[i] - rest.q[i];
      x[m + i] = state.v[i];
    }
    for (unsigned int k = 0; k < state.relaxed.size(); ++k)
    {
      DenseVector moved = state.relaxed[k], of_span(shares.m());
      moved -= rest.relaxed[k];
      multiply(shares, moved, of_span);
      x.insert(x.end(), of_span.begin(), of_span.end());
    }
    for (const ContactDirection &direction : across)
    {
      x.push_back(0);
      for (unsigned int c = 0; c < 2; ++c)
      {
        const unsigned int row = (c + 1) * n + direction.point;
        x.back() += (c == 0 ? direction.x : direction.y) * (state.R[row] - rest.R[row]);
      }
    }
    for (const auto &weight : weights)
      result.push_back(
          std::abs(std::inner_product(weight.begin(), weight.end(), x.begin(), std::complex<double>(0))));
    return result;
  }
} // namespace vibrocontact
