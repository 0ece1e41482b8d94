#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/bodies/ring_poles.h>
#include <vibrocontact/bodies/road_rows.h>
#include <vibrocontact/bodies/rolling_modes.h>
#include <vibrocontact/numerics/complex_eigenvectors.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// less of the largest entry of G is the rounding of the modes
    constexpr double uncoupled = 1e-10;

    /// Modes that couple with each other, in the order of their first ones.
    std::vector<std::vector<unsigned int>> coupled_modes(const FlowReduction &flow)
    {
      const unsigned int n = flow.fixed.m();
      if (!flow.flows() && n > 0)
      {
        std::vector<unsigned int> all(n);
        std::iota(all.begin(), all.end(), 0u);
        return {all};
      }
      const auto coupling = [&](const unsigned int i, const unsigned int j)
      {
        return std::max({std::abs(flow.fixed(i, j)), std::abs(flow.turning(i, j)),
                         flow.of_square.m() > 0 ? std::abs(flow.of_square(i, j)) : 0.});
      };
      double largest = 0;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < j; ++i)
          largest = std::max(largest, coupling(i, j));
      std::vector<unsigned int> first(n);
      std::iota(first.begin(), first.end(), 0u);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < j; ++i)
          if (coupling(i, j) > uncoupled * largest && first[i] != first[j])
          {
            const auto [low, high] = std::minmax(first[i], first[j]);
            const unsigned int from = high, to = low;
            std::replace(first.begin(), first.end(), from, to);
          }
      std::map<unsigned int, std::vector<unsigned int>> blocks;
      for (unsigned int k = 0; k < n; ++k)
        blocks[first[k]].push_back(k);
      std::vector<std::vector<unsigned int>> result;
      for (const auto &block : blocks)
        result.push_back(block.second);
      return result;
    }

    /// The components of a wave around the ring pass into those a quarter of a wave farther, times its order.
    unsigned int order_of(const FlowReduction &flow, const std::vector<unsigned int> &block)
    {
      double square = 0;
      for (const unsigned int j : block)
        square += std::pow(flow.turning(block.front(), j), 2);
      return std::lround(std::sqrt(square));
    }

    /// A pole of the modes of a block: their amplitudes, and what modal forces feed into it.
    struct BlockPole
    {
      Complex lambda;
      std::vector<Complex> right, left;
    };

    /// A wave runs towards growing theta if d/dtheta of its shape is -j n times the shape.
    std::string wave_name(const FlowReduction &flow, const std::vector<unsigned int> &block,
                          const BlockPole &pole, const double rotation)
    {
      unsigned int largest = 0;
      double sense = 0, size = 0;
      for (unsigned int i = 0; i < block.size(); ++i)
      {
        if (std::norm(pole.right[i]) > (1 + 1e-6) * std::norm(pole.right[largest]))
          largest = i;
        size += std::norm(pole.right[i]);
        for (unsigned int j = 0; j < block.size(); ++j)
          sense -=
              rotation * flow.turning(block[i], block[j]) * (std::conj(pole.right[i]) * pole.right[j]).imag();
      }
      const std::string &name = flow.names[block[largest]];
      const bool stays =
          std::abs(sense) < 0.5 * std::abs(rotation) * order_of(flow, block) * size || sense == 0;
      return stays ? name : name + (sense > 0 ? " forward" : " backward");
    }

    /// One of each conjugate pair; real ones by half.
    std::vector<BlockPole> poles_of_block(const BodyInContact &body, const FlowReduction &flow,
                                          const std::vector<unsigned int> &block, const double rotation)
    {
      const unsigned int n = block.size();
      double s = 0;
      for (const unsigned int k : block)
        s = std::max(s, body.omega[k]);
      // y = (q, q' / s)
      ComplexMatrix A(2 * n, 2 * n);
      for (unsigned int i = 0; i < n; ++i)
      {
        const double w = body.omega[block[i]], loss = 2 * body.damping_ratio[block[i]] * w;
        A(i, n + i) = 1;
        A(n + i, i) = -w * w / (s * s);
        A(n + i, n + i) = -loss / s;
        for (unsigned int j = 0; j < n; ++j)
        {
          if (flow.flows())
            A(n + i, j) -= loss * rotation * flow.turning(block[i], block[j]) / (s * s);
          if (flow.of_square.m() > 0)
            A(n + i, j) -= rotation * rotation * flow.of_square(block[i], block[j]) / (s * s);
          A(n + i, n + j) -= 2 * rotation * flow.fixed(block[i], block[j]) / s;
        }
      }
      const ComplexEigenvectors found = complex_eigenvectors(A, "poles of a rolling body");
      std::vector<BlockPole> poles;
      for (unsigned int k = 0; k < 2 * n; ++k)
      {
        const Complex lambda = s * found.values[k];
        if (!flow.flows())
        {
          AssertThrow(lambda.real() < 1e-8 * s,
                      dealii::ExcMessage("Coriolis forces, which do no work, let a motion grow."));
        }
        else if (flow.names.empty())
          check_decay(lambda, order_of(flow, block), s, rotation);
        else if (!(lambda.real() < 1e-10 * s))
          throw InputError("A wheel turns at " + number_text(std::abs(rotation)) + " rad/s, where " +
                           flow.names[block.front()] + " grows by " + number_text(lambda.real()) +
                           " 1/s without any contact: lower Rolling/Speed.");
        const double share = share_of_pair(lambda);
        if (share == 0)
          continue;
        BlockPole pole{lambda, {}, {}};
        for (unsigned int i = 0; i < n; ++i)
        {
          pole.right.push_back(found.right(i, k));
          pole.left.push_back(share / s * found.left(k, n + i));
        }
        poles.push_back(pole);
      }
      std::sort(poles.begin(), poles.end(),
                [](const BlockPole &a, const BlockPole &b) { return a.lambda.imag() < b.lambda.imag(); });
      return poles;
    }

    /// The residual flexibility of the band at its contact points, then along theta at the places in front of them, nearest
    /// first. @param rows of the body at rest with friction, tread not included
    DenseMatrix band_of(const BodyInContact &at_rest, const FlowReduction &flow, const double rotation)
    {
      const unsigned int n = at_rest.n_rows(), n_beyond = flow.beyond.m() / 2,
                         first = rotation < 0 ? n_beyond : 0;
      DenseMatrix band(n + n_beyond, n);
      for (unsigned int j = 0; j < n; ++j)
      {
        for (unsigned int i = 0; i < n; ++i)
          band(i, j) = at_rest.residual(i, j);
        for (unsigned int i = 0; i < n_beyond; ++i)
        {
          double &rest = band(n + i, j) = flow.beyond_compliance(first + i, j);
          for (unsigned int k = 0; k < at_rest.n_modes(); ++k)
            rest -= flow.beyond(first + i, k) * at_rest.trace(j, k) / std::pow(at_rest.omega[k], 2);
        }
      }
      return band;
    }
  } // namespace

  namespace
  {
    /// Pole k in the amplitude of the first row that moves most, or nearly so.
    void scale_shapes(BodyInContact &body, const unsigned int k)
    {
      const unsigned int n = body.n_rows();
      double largest = 0;
      for (unsigned int i = 0; i < n; ++i)
        largest = std::max(largest, std::abs(body.right(i, k)));
      if (!(largest > 0))
        return;
      unsigned int row = 0;
      while (std::abs(body.right(row, k)) < (1 - 1e-6) * largest)
        ++row;
      const Complex scale = body.right(row, k);
      for (unsigned int i = 0; i < n; ++i)
      {
        body.right(i, k) /= scale;
        body.left(i, k) *= scale;
        if (body.gradient.m() > 0)
          body.gradient(i, k) /= scale;
      }
      body.pole_load[k] *= scale;
    }
  } // namespace

  BodyInContact rolling_modes(const BodyInContact &at_rest, const FlowReduction &flow, const double rotation)
  {
    const unsigned int n = at_rest.n_rows(), n_points = flow.stretch.m();
    BodyInContact body;
    body.residual = at_rest.residual;
    body.residual_load = at_rest.residual_load;
    body.relaxation = at_rest.relaxation;
    struct InBlock
    {
      const std::vector<unsigned int> *modes;
      BlockPole pole;
    };
    std::vector<InBlock> all;
    const std::vector<std::vector<unsigned int>> blocks = coupled_modes(flow);
    std::map<unsigned int, unsigned int> branches;
    std::map<std::string, unsigned int> seen;
    for (const std::vector<unsigned int> &block : blocks)
    {
      const unsigned int order = flow.flows() ? order_of(flow, block) : 0;
      for (const BlockPole &pole : poles_of_block(at_rest, flow, block, rotation))
      {
        body.poles.push_back(pole.lambda);
        if (!flow.flows())
          body.labels.push_back("mode " + std::to_string(++branches[order]));
        else if (flow.names.empty())
          body.labels.push_back("n=" + std::to_string(order) + ", branch " +
                                std::to_string(++branches[order]));
        else
        {
          const std::string name = wave_name(flow, block, pole, rotation);
          const unsigned int number = ++seen[name];
          body.labels.push_back(number == 1 ? name : name + "#" + std::to_string(number));
        }
        Complex load = 0;
        for (unsigned int i = 0; i < block.size() && !at_rest.modal_load.empty(); ++i)
          load += pole.left[i] * at_rest.modal_load[block[i]];
        body.pole_load.push_back(load);
        all.push_back({&block, pole});
      }
    }
    body.right.reinit(n, all.size());
    body.left.reinit(n, all.size());
    const bool has_stretch = n_points > 0 && n == 2 * n_points;
    if (has_stretch)
      body.gradient.reinit(n, all.size());
    for (unsigned int k = 0; k < all.size(); ++k)
    {
      for (unsigned int m = 0; m < all[k].modes->size(); ++m)
      {
        const unsigned int mode = (*all[k].modes)[m];
        for (unsigned int i = 0; i < n; ++i)
        {
          body.right(i, k) += at_rest.trace(i, mode) * all[k].pole.right[m];
          body.left(i, k) += at_rest.trace(i, mode) * all[k].pole.left[m];
        }
        for (unsigned int i = 0; i < n_points && has_stretch; ++i)
          body.gradient(n_points + i, k) += flow.stretch(i, mode) * all[k].pole.right[m];
      }
      scale_shapes(body, k);
    }
    return body;
  }

  ComplexModes complex_modes(const BodyInContact &at_rest, const FlowReduction &coriolis,
                             const double rotation)
  {
    ComplexModes result;
    std::vector<BlockPole> found;
    for (const std::vector<unsigned int> &block : coupled_modes(coriolis))
      found = poles_of_block(at_rest, coriolis, block, rotation);
    result.amplitudes.reinit(at_rest.n_modes(), found.size());
    for (unsigned int k = 0; k < found.size(); ++k)
    {
      result.poles.push_back(found[k].lambda);
      Complex square = 0;
      for (const Complex &amplitude : found[k].right)
        square += amplitude * amplitude;
      const Complex turn = std::polar(1., -std::arg(square) / 2);
      for (unsigned int i = 0; i < found[k].right.size(); ++i)
        result.amplitudes(i, k) = turn * found[k].right[i];
    }
    return result;
  }

  BodyInContact RingParameters::on_road(const ReducedBody &reduced, const bool with_friction,
                                        const double speed, const std::vector<double> &upstream) const
  {
    BodyInContact body = road_rows(reduced, with_friction, 1);
    if (const double turning = rotation(speed); turning != 0)
    {
      AssertThrow(reduced.flow, dealii::ExcMessage("A ring that rolls has been reduced without its flow."));
      const BodyInContact at_rest = std::move(body);
      body = rolling_modes(at_rest, *reduced.flow, turning);
      if (with_friction && !upstream.empty())
      {
        AssertThrow(upstream.size() <= n_beyond + 1, dealii::ExcInternalError());
        body.residual_gradient =
            residual_gradient(*this, band_of(at_rest, *reduced.flow, turning), turning, upstream);
      }
      else
        body.gradient.reinit(0, 0);
    }
    // the residual of material that flows relaxes on its way, and a tread does not: neither is taken
    if (rolls() || tread_compliance(false) > 0 || tread_compliance(true) > 0)
      body.relaxation = 0;
    for (unsigned int i = 0; i < body.n_rows(); ++i)
      body.residual(i, i) += tread_compliance(i >= n_points);
    return body;
  }
} // namespace vibrocontact
