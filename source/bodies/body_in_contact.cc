#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/bodies/body_in_contact.h>
#include <vibrocontact/numerics/eigenvalues.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// of the pair that stands for a rigid motion [rad/s]
    constexpr double rigid_frequency = 1e-12;

    // right diag(weights) left^T
    ComplexMatrix sum_of_residues(const BodyInContact &body, const std::vector<Complex> &weights,
                                  const bool conjugate)
    {
      const unsigned int n = body.n_rows();
      ComplexMatrix result(n, n);
      for (unsigned int k = 0; k < body.n_poles(); ++k)
        for (unsigned int j = 0; j < n; ++j)
        {
          const Complex left = weights[k] * (conjugate ? std::conj(body.left(j, k)) : body.left(j, k));
          for (unsigned int i = 0; i < n; ++i)
            result(i, j) += left * (conjugate ? std::conj(body.right(i, k)) : body.right(i, k));
        }
      return result;
    }

    struct PoleOfMode
    {
      unsigned int mode;
      Complex pole;
      /// 1 / (difference to the other pole of its pair)
      Complex gain;
    };

    std::vector<PoleOfMode> poles_of_modes(const BodyInContact &body)
    {
      std::vector<PoleOfMode> result;
      for (unsigned int k = 0; k < body.n_modes(); ++k)
      {
        const double zeta = body.damping_ratio[k], w = body.omega[k];
        const double discriminant = std::abs(1 - zeta * zeta) < 1e-14 ? 1e-14 : 1 - zeta * zeta;
        if (w <= 0 || discriminant > 0)
        {
          const Complex pole =
              w <= 0 ? Complex(0, rigid_frequency) : Complex(-zeta * w, w * std::sqrt(discriminant));
          result.push_back({k, pole, 1. / Complex(0, 2 * pole.imag())});
          continue;
        }
        const double root = w * std::sqrt(-discriminant);
        for (const double sign : {1., -1.})
          result.push_back({k, -zeta * w + sign * root, 0.5 * sign / (2 * root)});
      }
      return result;
    }
  } // namespace

  BodyInContact with_rows(const BodyInContact &body, const std::vector<SignedRow> &rows)
  {
    const unsigned int n = rows.size();
    BodyInContact result = body;
    result.trace.reinit(n, body.n_modes());
    result.right.reinit(n, body.n_poles());
    result.left.reinit(n, body.n_poles());
    result.residual.reinit(n, n);
    result.residual_load.assign(n, 0.);
    if (body.gradient.m() > 0)
    {
      result.gradient.reinit(n, body.n_poles());
      result.residual_gradient.reinit(n, n);
    }
    for (unsigned int i = 0; i < n; ++i)
    {
      const auto [row, factor] = rows[i];
      for (unsigned int k = 0; k < body.n_modes(); ++k)
        result.trace(i, k) = factor * body.trace(row, k);
      for (unsigned int k = 0; k < body.n_poles(); ++k)
      {
        result.right(i, k) = factor * body.right(row, k);
        result.left(i, k) = factor * body.left(row, k);
      }
      if (!body.residual_load.empty())
        result.residual_load[i] = factor * body.residual_load[row];
      for (unsigned int j = 0; j < n && body.residual.m() > 0; ++j)
        result.residual(i, j) = factor * rows[j].factor * body.residual(row, rows[j].row);
      for (unsigned int k = 0; k < result.gradient.n(); ++k)
        result.gradient(i, k) = factor * body.gradient(row, k);
      for (unsigned int j = 0; j < result.residual_gradient.n(); ++j)
        result.residual_gradient(i, j) = factor * rows[j].factor * body.residual_gradient(row, rows[j].row);
    }
    return result;
  }

  bool has_rest(const BodyInContact &body)
  {
    for (unsigned int i = 0; i < body.residual.m(); ++i)
      if (body.residual(i, i) != 0)
        return true;
    return false;
  }

  BodyInContact together(const BodyInContact &first, const BodyInContact &second)
  {
    const unsigned int n = first.n_rows();
    Assert(second.n_rows() == n, dealii::ExcDimensionMismatch(second.n_rows(), n));
    if (has_rest(first) && has_rest(second) && first.relaxation != second.relaxation)
      return first.relaxation > 0 ? together(rest_by_poles(first), second)
                                  : together(first, rest_by_poles(second));
    if ((first.n_poles() > 0) != (second.n_poles() > 0))
      return together(by_poles(first), by_poles(second));
    BodyInContact result = first;
    const auto append =
        [](auto &values, auto own, const std::size_t n_first, const std::size_t n_second, const auto &rest)
    {
      if (values.empty() && own.empty())
        return;
      values.resize(n_first, rest);
      own.resize(n_second, rest);
      values.insert(values.end(), own.begin(), own.end());
    };
    const auto beside = [n](auto &shapes, const auto &own)
    {
      const auto left = shapes;
      shapes.reinit(n, left.n() + own.n());
      for (unsigned int i = 0; i < n; ++i)
      {
        for (unsigned int k = 0; k < left.n(); ++k)
          shapes(i, k) = left(i, k);
        for (unsigned int k = 0; k < own.n(); ++k)
          shapes(i, left.n() + k) = own(i, k);
      }
    };
    const std::size_t states[2] = {first.n_modes() + first.n_poles(), second.n_modes() + second.n_poles()};
    append(result.omega, second.omega, first.n_modes(), second.n_modes(), 0.);
    append(result.damping_ratio, second.damping_ratio, first.n_modes(), second.n_modes(), 0.);
    append(result.modal_load, second.modal_load, first.n_modes(), second.n_modes(), 0.);
    append(result.labels, second.labels, states[0], states[1], std::string());
    append(result.poles, second.poles, first.n_poles(), second.n_poles(), Complex());
    append(result.pole_load, second.pole_load, first.n_poles(), second.n_poles(), Complex());
    beside(result.trace, second.trace);
    result.participation.reinit(0, 0);
    beside(result.right, second.right);
    beside(result.left, second.left);
    if (first.gradient.m() > 0 || second.gradient.m() > 0)
    {
      const auto gradient = [n](const BodyInContact &body)
      { return body.gradient.m() > 0 ? body.gradient : ComplexMatrix(n, body.n_poles()); };
      result.gradient = gradient(first);
      beside(result.gradient, gradient(second));
      if (result.residual_gradient.m() == 0)
        result.residual_gradient.reinit(n, n);
      if (second.residual_gradient.m() > 0)
        add_block(result.residual_gradient, second.residual_gradient, 0, 0);
    }
    if (second.residual.m() > 0)
    {
      if (result.residual.m() == 0)
        result.residual.reinit(n, n);
      add_block(result.residual, second.residual, 0, 0);
    }
    if (!second.residual_load.empty())
    {
      result.residual_load.resize(n);
      for (unsigned int i = 0; i < n; ++i)
        result.residual_load[i] += second.residual_load[i];
    }
    if (!has_rest(first))
      result.relaxation = second.relaxation;
    return result;
  }

  BodyInContact by_poles(const BodyInContact &body)
  {
    if (body.n_modes() == 0)
      return body;
    Assert(body.gradient.m() == 0, dealii::ExcNotImplemented());
    const std::vector<PoleOfMode> own = poles_of_modes(body);
    const unsigned int n = body.n_rows(), n_own = own.size(), n_poles = n_own + body.n_poles();
    BodyInContact result;
    result.residual = body.residual;
    result.residual_load = body.residual_load;
    result.relaxation = body.relaxation;
    result.right.reinit(n, n_poles);
    result.left.reinit(n, n_poles);
    double largest_load = 0;
    for (const double load : body.modal_load)
      largest_load = std::max(largest_load, std::abs(load));
    for (const PoleOfMode &one : own)
    {
      const unsigned int k = result.poles.size();
      for (unsigned int i = 0; i < n; ++i)
      {
        result.right(i, k) = body.trace(i, one.mode);
        result.left(i, k) = one.gain * body.trace(i, one.mode);
      }
      result.poles.push_back(one.pole);
      const double load = body.modal_load.empty() ? 0. : body.modal_load[one.mode];
      // a rigid motion across the loads feels their rounding
      const bool is_rounding = body.omega[one.mode] == 0 && std::abs(load) < 1e-10 * largest_load;
      result.pole_load.push_back(is_rounding ? 0. : one.gain * load);
      if (!body.labels.empty())
        result.labels.push_back(body.labels[one.mode]);
    }
    for (unsigned int k = 0; k < body.n_poles(); ++k)
    {
      for (unsigned int i = 0; i < n; ++i)
      {
        result.right(i, n_own + k) = body.right(i, k);
        result.left(i, n_own + k) = body.left(i, k);
      }
      result.poles.push_back(body.poles[k]);
      result.pole_load.push_back(body.pole_load.empty() ? 0. : body.pole_load[k]);
      if (!body.labels.empty())
        result.labels.push_back(body.labels[body.n_modes() + k]);
    }
    return result;
  }

  BodyInContact rest_by_poles(const BodyInContact &body)
  {
    if (!(body.relaxation > 0) || !has_rest(body))
      return body;
    Assert(body.gradient.m() == 0, dealii::ExcNotImplemented());
    constexpr double rounding = 1e-12;
    const unsigned int n = body.n_rows();
    DenseMatrix vectors;
    const std::vector<double> values = symmetric_eigenvalues(body.residual, vectors);
    unsigned int first = 0;
    while (values[first] <= rounding * values.back())
      ++first;
    BodyInContact result = body;
    result.residual.reinit(0, 0);
    const unsigned int n_poles = body.n_poles() + n - first;
    const auto widened = [&](const ComplexMatrix &shapes)
    {
      ComplexMatrix wide(n, n_poles);
      for (unsigned int k = 0; k < shapes.n(); ++k)
        for (unsigned int i = 0; i < n; ++i)
          wide(i, k) = shapes(i, k);
      return wide;
    };
    result.right = widened(body.right);
    result.left = widened(body.left);
    result.poles.resize(n_poles, -1 / body.relaxation);
    result.pole_load.resize(n_poles, 0.);
    for (unsigned int e = first; e < n; ++e)
    {
      const unsigned int k = body.n_poles() + e - first;
      for (unsigned int i = 0; i < n; ++i)
      {
        result.right(i, k) = vectors(i, e);
        result.left(i, k) = values[e] / (2 * body.relaxation) * vectors(i, e);
      }
      if (!body.labels.empty())
        result.labels.push_back("rest " + std::to_string(n - e));
    }
    return result;
  }

  bool is_rigid_motion(const Complex &pole)
  {
    return std::abs(pole) <= 2 * rigid_frequency;
  }

  std::vector<double> pole_marks(const BodyInContact &body)
  {
    std::vector<double> marks;
    for (unsigned int k = 0; k < body.n_poles(); ++k)
    {
      Complex shape = 0;
      for (unsigned int i = 0; i < body.right.m(); ++i)
        shape += std::cos(1. + i) * body.right(i, k);
      marks.insert(marks.end(), {body.poles[k].real(), body.poles[k].imag(), shape.real(), shape.imag()});
    }
    return marks;
  }

  Complex rest_of_state(const BodyInContact &body, const unsigned int k)
  {
    return body.pole_load.empty() || is_rigid_motion(body.poles[k]) ? 0. : -body.pole_load[k] / body.poles[k];
  }

  DenseMatrix sum_over_poles(const BodyInContact &body, const std::vector<Complex> &weights)
  {
    const ComplexMatrix sum = sum_of_residues(body, weights, false);
    DenseMatrix result(sum.m(), sum.n());
    for (unsigned int i = 0; i < sum.m(); ++i)
      for (unsigned int j = 0; j < sum.n(); ++j)
        result(i, j) = 2 * sum(i, j).real();
    return result;
  }

  std::vector<Complex> static_weights(const BodyInContact &body)
  {
    std::vector<Complex> weights;
    for (const Complex &pole : body.poles)
      weights.push_back(-1. / pole);
    return weights;
  }

  ComplexMatrix receptance(const BodyInContact &body, const double omega)
  {
    std::vector<Complex> direct, mirrored;
    for (const Complex &pole : body.poles)
    {
      direct.push_back(1. / (Complex(0, omega) - pole));
      mirrored.push_back(1. / (Complex(0, omega) - std::conj(pole)));
    }
    ComplexMatrix result = sum_of_residues(body, direct, false);
    const ComplexMatrix other = sum_of_residues(body, mirrored, true);
    const Complex rest = 1. / Complex(1, omega * body.relaxation);
    for (unsigned int i = 0; i < result.m(); ++i)
      for (unsigned int j = 0; j < result.n(); ++j)
      {
        result(i, j) += other(i, j) + (body.residual.m() > 0 ? rest * body.residual(i, j) : 0.);
        for (unsigned int k = 0; k < body.n_modes(); ++k)
        {
          const double w = body.omega[k];
          result(i, j) += body.trace(i, k) * body.trace(j, k) /
                          Complex(w * w - omega * omega, 2 * body.damping_ratio[k] * w * omega);
        }
      }
    return result;
  }

  DenseMatrix impulse_response(const BodyInContact &body, const double t)
  {
    std::vector<Complex> weights;
    for (const Complex &pole : body.poles)
      weights.push_back(std::exp(pole * t));
    return sum_over_poles(body, weights);
  }

  DenseMatrix initial_derivative(const BodyInContact &body, const unsigned int order)
  {
    std::vector<Complex> weights;
    for (const Complex &pole : body.poles)
      weights.push_back(std::pow(pole, order));
    return sum_over_poles(body, weights);
  }

  double amplitude_per_state(const BodyInContact &body, const unsigned int k)
  {
    double right = 0, left = 0;
    for (unsigned int i = 0; i < body.right.m(); ++i)
    {
      right = std::max(right, std::abs(body.right(i, k)));
      left = std::max(left, std::abs(body.left(i, k)));
    }
    return left > 0 ? std::sqrt(right / (left * 2 * std::abs(body.poles[k]))) : 0;
  }
} // namespace vibrocontact
