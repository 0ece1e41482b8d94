#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/phi_functions.h>
#include <vibrocontact/propagators/step_weights.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    bool stands_for_a_rest(const BodyInContact &model, const Complex &pole)
    {
      return model.relaxation > 0 && pole == -1 / model.relaxation;
    }

    void add_rest(const double relaxation, const double time_step, StepWeights &weights)
    {
      const double factor = relaxation / (time_step + relaxation);
      weights.factor.push_back(factor);
      weights.now.push_back(time_step * factor);
      weights.later.push_back(0);
    }
  } // namespace

  StepWeights step_weights(const BodyInContact &model, const double time_step,
                           const ForceInterpolation interpolation)
  {
    StepWeights weights;
    for (const Complex &pole : model.poles)
    {
      if (stands_for_a_rest(model, pole))
      {
        add_rest(model.relaxation, time_step, weights);
        continue;
      }
      const Complex x = pole * time_step;
      weights.factor.push_back(std::exp(x));
      switch (interpolation)
      {
      case ForceInterpolation::impulse:
        weights.now.push_back(time_step * weights.factor.back());
        weights.later.push_back(0);
        break;
      case ForceInterpolation::constant:
        weights.now.push_back(time_step * phi(1, x));
        weights.later.push_back(0);
        break;
      case ForceInterpolation::linear:
        weights.now.push_back(time_step * phi(2, x));
        // phi_1 - phi_2 without their difference: int_0^1 e^(x (1 - s)) (1 - s) ds
        weights.later.push_back(time_step *
                                (std::abs(x) < 1.5 ? phi(2, -x) * std::exp(x) : phi(1, x) - phi(2, x)));
        break;
      }
    }
    return weights;
  }

  StepWeights theta_weights(const BodyInContact &model, const double time_step,
                            const ForceInterpolation interpolation, const double theta)
  {
    StepWeights weights;
    for (const Complex &pole : model.poles)
    {
      if (stands_for_a_rest(model, pole))
      {
        add_rest(model.relaxation, time_step, weights);
        continue;
      }
      const Complex x = pole * time_step, inverse = 1. / (1. - theta * x);
      const bool is_linear = interpolation == ForceInterpolation::linear;
      weights.factor.push_back((1. + (1 - theta) * x) * inverse);
      weights.now.push_back(time_step * (interpolation == ForceInterpolation::impulse ? weights.factor.back()
                                         : is_linear                                  ? theta * inverse
                                                                                      : inverse));
      weights.later.push_back(is_linear ? time_step * (1 - theta) * inverse : 0.);
    }
    return weights;
  }

  DenseMatrix one_step_compliance(const BodyInContact &model, const StepWeights &weights)
  {
    DenseMatrix result = sum_over_poles(model, weights.now);
    if (model.residual.m() > 0)
      result.add(1., model.residual);
    return result;
  }

  double critical_time_step(const DenseMatrix &S, const DenseMatrix &slope,
                            const ForceInterpolation interpolation)
  {
    if (interpolation == ForceInterpolation::impulse)
      return std::numeric_limits<double>::infinity();
    // beyond rounding
    if (S.m() == 0 || !(definiteness(S) > 1e-12))
      return 0;
    if (interpolation == ForceInterpolation::constant)
      return std::numeric_limits<double>::infinity();
    const unsigned int n = S.m();
    DenseMatrix left(n, n), right(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
      {
        left(i, j) = 0.5 * (slope(i, j) + slope(j, i));
        right(i, j) = 0.5 * (S(i, j) + S(j, i));
      }
    std::vector<DenseVector> vectors;
    left.compute_generalized_eigenvalues_symmetric(right, vectors);
    double largest = 0;
    for (unsigned int i = 0; i < n; ++i)
      largest = std::max(largest, left.eigenvalue(i).real());
    return 2.7 / std::sqrt(largest);
  }

  double critical_theta_step(const DenseMatrix &S, const ForceInterpolation interpolation, const double theta)
  {
    const bool gives_way = S.m() > 0 && definiteness(S) > 1e-12;
    return interpolation == ForceInterpolation::impulse || theta > 0.5 || gives_way
               ? std::numeric_limits<double>::infinity()
               : 0.;
  }

  void exchange_past_forces(CheckpointFile &file, std::vector<double> &forces)
  {
    const std::size_t n_forces = forces.size();
    file("propagator/forces", forces);
    if (forces.size() != n_forces)
      throw InputError(
          "A convolution that remembers every force of its run cannot go on beyond its End time: give "
          "Modal convolution/Memory, or run the file without --resume.");
  }

  FreeFall::FreeFall(const BodyInContact &model, const double time_step) : time_step(time_step)
  {
    for (unsigned int k = 0; k < model.pole_load.size(); ++k)
      if (is_rigid_motion(model.poles[k]) && model.pole_load[k] != 0.)
      {
        acceleration.resize(model.n_rows());
        for (unsigned int i = 0; i < model.n_rows(); ++i)
          acceleration[i] += 2 * (model.right(i, k) * model.poles[k] * model.pole_load[k]).real();
      }
  }

  void FreeFall::add_to(double *u) const
  {
    const double t = step * time_step;
    for (unsigned int i = 0; i < acceleration.size(); ++i)
      u[i] += 0.5 * acceleration[i] * t * t;
  }

  void FreeFall::add_rate_to(double *v) const
  {
    for (unsigned int i = 0; i < acceleration.size(); ++i)
      v[i] += acceleration[i] * step * time_step;
  }

  void FreeFall::exchange(CheckpointFile &file, const std::string &name)
  {
    if (!is_none())
      file(name + "/step", step);
  }

  FreeMotion::FreeMotion(const BodyInContact &model, const std::vector<Complex> &state,
                         const double time_step)
      : n_rows(model.n_rows()), constant(model.n_rows(), 0.), fall(model, time_step)
  {
    for (unsigned int k = 0; k < model.n_poles(); ++k)
    {
      const Complex rest = rest_of_state(model, k);
      for (unsigned int i = 0; i < n_rows; ++i)
        constant[i] += 2 * (model.right(i, k) * rest).real();
      if (state[k] == rest)
        continue;
      poles.push_back(model.poles[k]);
      factor.push_back(std::exp(model.poles[k] * time_step));
      moving.push_back(factor.back() * (state[k] - rest));
      for (unsigned int i = 0; i < n_rows; ++i)
        shape.push_back(2. * model.right(i, k));
    }
  }

  void FreeMotion::add_to(double *u) const
  {
    for (unsigned int i = 0; i < n_rows; ++i)
      u[i] += constant[i];
    fall.add_to(u);
    for (unsigned int k = 0; k < moving.size(); ++k)
      for (unsigned int i = 0; i < n_rows; ++i)
      {
        const Complex &c = shape[k * n_rows + i];
        u[i] += c.real() * moving[k].real() - c.imag() * moving[k].imag();
      }
  }

  void FreeMotion::add_rate_to(double *v) const
  {
    fall.add_rate_to(v);
    for (unsigned int k = 0; k < moving.size(); ++k)
      for (unsigned int i = 0; i < n_rows; ++i)
        v[i] += (shape[k * n_rows + i] * poles[k] * moving[k]).real();
  }

  void FreeMotion::advance()
  {
    fall.advance();
    for (unsigned int k = 0; k < moving.size(); ++k)
    {
      const Complex z = moving[k], e = factor[k];
      moving[k] = {z.real() * e.real() - z.imag() * e.imag(), z.real() * e.imag() + z.imag() * e.real()};
    }
  }

  void FreeMotion::exchange(CheckpointFile &file, const std::string &name)
  {
    file(name, moving);
    fall.exchange(file, name + "/fall");
  }

  namespace
  {
    /// Row and force of a Green's function.
    struct RowAndForce
    {
      unsigned int row, force;
    };

    /// What forces of one step do at its end and later, of all poles: 2 Re and -2 Im of their weights at the lags from `begin` on.
    void set_weights_at_lags(const BodyInContact &model, const double time_step, const StepWeights &weights,
                             const unsigned long begin, DenseMatrix &at_lags)
    {
      const unsigned int n_poles = model.n_poles();
      for (unsigned int k = 0; k < n_poles; ++k)
      {
        const Complex x = stands_for_a_rest(model, model.poles[k]) ? std::log(weights.factor[k])
                                                                   : model.poles[k] * time_step;
        // beyond it e^(x lag) is zero in double precision
        const double end = x.real() < 0 ? 2 + 745. / -x.real() : std::numeric_limits<double>::infinity();
        for (unsigned int row = 0; row < at_lags.m(); ++row)
        {
          const double lag = begin + row;
          Complex weight = lag < end ? weights.now[k] * std::exp(x * lag) : 0.;
          if (lag > 0 && lag < end)
            weight += weights.later[k] * std::exp(x * (lag - 1));
          at_lags(row, k) = 2 * weight.real();
          at_lags(row, n_poles + k) = -2 * weight.imag();
        }
      }
    }

    /// Samples of some Green's functions without the residual compliance: products of the poles' weights at the lags with their shapes.
    std::vector<std::vector<double>> samples_of(const BodyInContact &model, const double time_step,
                                                const ForceInterpolation interpolation,
                                                const unsigned long n_lags,
                                                const std::vector<RowAndForce> &which)
    {
      // lags at once, and functions: what is written stays in the cache
      constexpr unsigned long lags_at_once = 1024;
      constexpr std::size_t functions_at_once = 128;
      const unsigned int n_poles = model.n_poles();
      std::vector<std::vector<double>> samples(which.size(), std::vector<double>(n_lags, 0.));
      const StepWeights weights = step_weights(model, time_step, interpolation);
      for (unsigned long begin = 0; begin < n_lags && n_poles > 0; begin += lags_at_once)
      {
        const unsigned int n = std::min(lags_at_once, n_lags - begin);
        DenseMatrix at_lags(n, 2 * n_poles);
        set_weights_at_lags(model, time_step, weights, begin, at_lags);
        for (std::size_t first = 0; first < which.size(); first += functions_at_once)
        {
          const unsigned int n_functions = std::min(functions_at_once, which.size() - first);
          DenseMatrix shapes(2 * n_poles, n_functions), product(n, n_functions);
          for (unsigned int f = 0; f < n_functions; ++f)
            for (unsigned int k = 0; k < n_poles; ++k)
            {
              const Complex shape =
                  model.right(which[first + f].row, k) * model.left(which[first + f].force, k);
              shapes(k, f) = shape.real();
              shapes(n_poles + k, f) = shape.imag();
            }
          at_lags.mmult(product, shapes);
          for (unsigned int f = 0; f < n_functions; ++f)
            std::copy(&product(0, f), &product(0, f) + n, samples[first + f].begin() + begin);
        }
      }
      return samples;
    }
  } // namespace

  std::vector<std::vector<double>> step_kernel(const BodyInContact &model, const double time_step,
                                               const ForceInterpolation interpolation,
                                               const unsigned long n_lags)
  {
    const unsigned int n = model.n_rows();
    std::vector<RowAndForce> all;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        all.push_back({i, j});
    std::vector<std::vector<double>> kernel = samples_of(model, time_step, interpolation, n_lags, all);
    for (unsigned int i = 0; i < n && model.residual.m() > 0; ++i)
      for (unsigned int j = 0; j < n; ++j)
        kernel[i * n + j][0] += model.residual(i, j);
    return kernel;
  }

  unsigned long steps_of_memory(const BodyInContact &model, const double time_step, const double share,
                                const unsigned long most_steps)
  {
    std::vector<double> size(model.n_poles(), 0.);
    double sum = 0;
    for (unsigned int k = 0; k < model.n_poles(); ++k)
    {
      for (unsigned int i = 0; i < model.n_rows(); ++i)
        size[k] = std::max(size[k], std::abs(model.right(i, k) * model.left(i, k)));
      sum += size[k];
    }
    double low = 0, high = most_steps * time_step;
    const auto envelope = [&](const double t)
    {
      double value = 0;
      for (unsigned int k = 0; k < model.n_poles(); ++k)
        value += size[k] * std::exp(model.poles[k].real() * t);
      return value / sum;
    };
    // the largest g stays below the envelope at zero, hence the fifth
    for (unsigned int k = 0; k < 60 && !(envelope(high) > 0.2 * share); ++k)
    {
      const double middle = 0.5 * (low + high);
      (envelope(middle) > 0.2 * share ? low : high) = middle;
    }
    // from there on backwards to the last sample above the share
    std::vector<RowAndForce> driving_points;
    for (unsigned int i = 0; i < model.n_rows(); ++i)
      driving_points.push_back({i, i});
    const auto kernel = samples_of(
        model, time_step, ForceInterpolation::impulse,
        std::min(most_steps, static_cast<unsigned long>(std::ceil(high / time_step))), driving_points);
    double largest = 0;
    for (const std::vector<double> &g : kernel)
      for (const double value : g)
        largest = std::max(largest, std::abs(value));
    unsigned long last = 0;
    for (const std::vector<double> &g : kernel)
      for (unsigned long k = last; k < g.size(); ++k)
        if (std::abs(g[k]) > share * largest)
          last = k + 1;
    return last;
  }
} // namespace vibrocontact
