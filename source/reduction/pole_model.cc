#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/reduction/pole_model.h>

#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    // right diag(weights) left^T
    ComplexMatrix sum_of_residues(const PoleModel &model, const std::vector<Complex> &weights,
                                  const bool conjugate)
    {
      const unsigned int n = model.n_rows();
      ComplexMatrix result(n, n);
      for (unsigned int k = 0; k < model.n_poles(); ++k)
        for (unsigned int j = 0; j < n; ++j)
        {
          const Complex left = weights[k] * (conjugate ? std::conj(model.left(j, k)) : model.left(j, k));
          for (unsigned int i = 0; i < n; ++i)
            result(i, j) += left * (conjugate ? std::conj(model.right(i, k)) : model.right(i, k));
        }
      return result;
    }
  } // namespace

  PoleModel pole_model(const std::vector<double> &omega, const std::vector<double> &damping_ratio,
                       const DenseMatrix &trace, const std::vector<double> &modal_load,
                       const DenseMatrix &residual, const std::vector<std::string> &labels)
  {
    PoleModel model;
    // poles of mode and 1 / (difference to the other pole of its pair)
    std::vector<unsigned int> mode;
    std::vector<Complex> gain;
    for (unsigned int k = 0; k < omega.size(); ++k)
    {
      if (omega[k] <= 0)
        throw InputError("Mode " + (labels.empty() ? std::to_string(k) : labels[k]) +
                         " is a rigid motion, which has no simple pole; hold the body or put it on springs");
      const double zeta = damping_ratio[k], w = omega[k];
      // critical damping by a hair less: the pole would be double
      const double discriminant = std::abs(1 - zeta * zeta) < 1e-14 ? 1e-14 : 1 - zeta * zeta;
      if (discriminant > 0)
      {
        const Complex pole(-zeta * w, w * std::sqrt(discriminant));
        mode.push_back(k);
        model.poles.push_back(pole);
        gain.push_back(1. / Complex(0, 2 * pole.imag()));
        continue;
      }
      const double root = w * std::sqrt(-discriminant);
      for (const double sign : {1., -1.})
      {
        mode.push_back(k);
        model.poles.emplace_back(-zeta * w + sign * root);
        gain.emplace_back(0.5 * sign / (2 * root));
      }
    }
    const unsigned int n = trace.m(), n_poles = model.poles.size();
    model.right.reinit(n, n_poles);
    model.left.reinit(n, n_poles);
    for (unsigned int k = 0; k < n_poles; ++k)
    {
      for (unsigned int i = 0; i < n; ++i)
      {
        model.right(i, k) = trace(i, mode[k]);
        model.left(i, k) = gain[k] * trace(i, mode[k]);
      }
      model.load.push_back(modal_load.empty() ? 0. : gain[k] * modal_load[mode[k]]);
      if (!labels.empty())
        model.labels.push_back(labels[mode[k]]);
    }
    model.residual = residual;
    return model;
  }

  DenseMatrix sum_over_poles(const PoleModel &model, const std::vector<Complex> &weights)
  {
    const ComplexMatrix sum = sum_of_residues(model, weights, false);
    DenseMatrix result(sum.m(), sum.n());
    for (unsigned int i = 0; i < sum.m(); ++i)
      for (unsigned int j = 0; j < sum.n(); ++j)
        result(i, j) = 2 * sum(i, j).real();
    return result;
  }

  ComplexMatrix receptance(const PoleModel &model, const double omega)
  {
    std::vector<Complex> direct, mirrored;
    for (const Complex &pole : model.poles)
    {
      direct.push_back(1. / (Complex(0, omega) - pole));
      mirrored.push_back(1. / (Complex(0, omega) - std::conj(pole)));
    }
    ComplexMatrix result = sum_of_residues(model, direct, false);
    const ComplexMatrix other = sum_of_residues(model, mirrored, true);
    for (unsigned int i = 0; i < result.m(); ++i)
      for (unsigned int j = 0; j < result.n(); ++j)
        result(i, j) += other(i, j) + (model.residual.m() > 0 ? model.residual(i, j) : 0.);
    return result;
  }

  DenseMatrix impulse_response(const PoleModel &model, const double t)
  {
    std::vector<Complex> weights;
    for (const Complex &pole : model.poles)
      weights.push_back(std::exp(pole * t));
    return sum_over_poles(model, weights);
  }

  DenseMatrix initial_derivative(const PoleModel &model, const unsigned int order)
  {
    std::vector<Complex> weights;
    for (const Complex &pole : model.poles)
      weights.push_back(std::pow(pole, order));
    return sum_over_poles(model, weights);
  }
} // namespace vibrocontact
