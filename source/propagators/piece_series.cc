#include <vibrocontact/propagators/piece_series.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// nodes of the road's interpolation in a piece
    constexpr unsigned int n_nodes = 12;
    using Nodes = std::array<double, n_nodes>;

    /// Chebyshev points of [0, 1] and the matrix from values there to coefficients of powers.
    struct Interpolation
    {
      Interpolation()
      {
        for (unsigned int i = 0; i < n_nodes; ++i)
          x[i] = 0.5 - 0.5 * std::cos(std::acos(-1.) * (i + 0.5) / n_nodes);
        for (unsigned int i = 0; i < n_nodes; ++i)
        {
          // Lagrange polynomial of point i
          Nodes own{};
          own[0] = 1;
          unsigned int degree = 0;
          for (unsigned int j = 0; j < n_nodes; ++j)
            if (j != i)
            {
              const double factor = 1 / (x[i] - x[j]);
              ++degree;
              for (unsigned int k = degree + 1; k-- > 0;)
                own[k] = ((k > 0 ? own[k - 1] : 0.) - x[j] * own[k]) * factor;
            }
          for (unsigned int k = 0; k < n_nodes; ++k)
            to_powers[i][k] = own[k];
        }
      }

      Nodes x;
      std::array<Nodes, n_nodes> to_powers;
    };

    const Interpolation interpolation;

    /// Without the tests for infinite factors that std::complex has.
    inline std::complex<double> product(const std::complex<double> &a, const std::complex<double> &b)
    {
      return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
    }
  } // namespace

  PieceSeries::PieceSeries(const BodyInContact &model, const Road &road)
      : model(model), road(road), n(model.n_rows()), n_poles(model.n_poles()),
        series(most_orders, std::vector<Complex>(n_poles)), rate(n_poles), bent(n * n_poles),
        u(n * most_orders), q(n * most_orders), acceleration(n * n_nodes), unbalanced(n)
  {
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int k = 0; k < n_poles; ++k)
        bent[i * n_poles + k] = 2. * model.right(i, k) * model.poles[k];
  }

  double PieceSeries::interpolate_road(const std::vector<unsigned int> &closed)
  {
    // of the largest value: last coefficient of Chebyshev polynomials
    constexpr double tolerance = 1e-10;
    double factor = 8;
    for (unsigned int j = 0; j < closed.size(); ++j)
    {
      double *const own = &acceleration[j * n_nodes];
      std::fill_n(own, n_nodes, 0.);
      double largest = 0;
      for (unsigned int i = 0; i < n_nodes; ++i)
      {
        const double value = road.at(closed[j], begin_time + duration * interpolation.x[i]).second;
        largest = std::max(largest, std::abs(value));
        for (unsigned int k = 0; k < n_nodes; ++k)
          own[k] += interpolation.to_powers[i][k] * value;
      }
      // 2^(2 k - 1) is the first power's coefficient in the polynomial of order k on [0, 1]
      const double last = std::ldexp(std::abs(own[n_nodes - 1]), 3 - 2 * static_cast<int>(n_nodes));
      if (last * std::pow(factor / 0.9, n_nodes - 1.) > tolerance * largest)
        factor = 0.9 * std::pow(tolerance * largest / last, 1. / (n_nodes - 1));
    }
    return std::max(factor, 0.1);
  }

  double PieceSeries::expand(const std::vector<Complex> &state, const double begin, const double length,
                             const std::vector<unsigned int> &closed,
                             const std::vector<double> &closed_inverse, const bool at_any_rate)
  {
    const unsigned int m = closed.size();
    begin_time = begin;
    duration = length;
    const double factor = interpolate_road(closed);
    if (factor < 1 && !at_any_rate)
      return factor;
    std::fill(q.begin(), q.end(), 0.);
    series[0] = state;
    double largest = 0;
    unsigned int small = 0;
    for (unsigned int order = 0; order < most_orders; ++order)
    {
      const std::vector<Complex> &c = series[order];
      double size = 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        double sum = 0;
        for (unsigned int k = 0; k < n_poles; ++k)
          sum += model.right(i, k).real() * c[k].real() - model.right(i, k).imag() * c[k].imag();
        u[i * most_orders + order] = 2 * sum;
      }
      for (unsigned int k = 0; k < n_poles; ++k)
        size = std::max(size, std::abs(c[k].real()) + std::abs(c[k].imag()));
      largest = std::max(largest, size);
      small = size <= 1e-18 * largest ? small + 1 : 0;
      orders = order + 1;
      if ((small > 1 && (m == 0 || order >= n_nodes)) || orders == most_orders)
        break;
      for (unsigned int k = 0; k < n_poles; ++k)
        rate[k] = product(model.poles[k], c[k]);
      if (order == 0 && !model.pole_load.empty())
        for (unsigned int k = 0; k < n_poles; ++k)
          rate[k] += model.pole_load[k];
      for (unsigned int j = 0; j < m; ++j)
      {
        const Complex *const own = &bent[closed[j] * n_poles];
        double sum = 0;
        for (unsigned int k = 0; k < n_poles; ++k)
          sum += own[k].real() * rate[k].real() - own[k].imag() * rate[k].imag();
        unbalanced[j] = (order < n_nodes ? acceleration[j * n_nodes + order] : 0.) - sum;
      }
      for (unsigned int i = 0; i < m; ++i)
      {
        double force = 0;
        for (unsigned int j = 0; j < m; ++j)
          force += closed_inverse[i * m + j] * unbalanced[j];
        q[closed[i] * most_orders + order] = force;
        for (unsigned int k = 0; k < n_poles; ++k)
          rate[k] += model.left(closed[i], k) * force;
      }
      const double step = length / (order + 1);
      for (unsigned int k = 0; k < n_poles; ++k)
        series[order + 1][k] = rate[k] * step;
    }
    return std::max(1., factor);
  }

  void PieceSeries::state(const double x, std::vector<Complex> &z) const
  {
    z = series[orders - 1];
    for (unsigned int order = orders - 1; order-- > 0;)
      for (unsigned int k = 0; k < n_poles; ++k)
        z[k] = z[k] * x + series[order][k];
  }

  double PieceSeries::impulse(const unsigned int i, const double x) const
  {
    double integral = 0;
    for (unsigned int k = orders; k-- > 0;)
      integral = integral * x + force(i)[k] / (k + 1);
    return integral * x * duration;
  }
} // namespace vibrocontact
