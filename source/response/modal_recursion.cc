#include <vibrocontact/response/modal_recursion.h>
#include <vibrocontact/response/step_weights.h>

#include <algorithm>
#include <numeric>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    constexpr unsigned int few = 4;
  }

  ModalRecursion::ModalRecursion(const PoleModel &model, const std::vector<Complex> &state,
                                 const ResponseSettings &settings)
      : n_poles(model.n_poles()), n_states(padded(model.n_poles())), n_padded(padded(model.n_rows())),
        p(2 * n_states), e(2 * n_states), w(2 * n_states * model.n_rows()), c(2 * n_states * model.n_rows()),
        constant(model.n_rows(), 0.)
  {
    const unsigned int n = model.n_rows();
    one_step = one_step_compliance(model, settings.time_step, settings.shape);
    free.resize(n);
    const StepWeights weights = step_weights(model, settings.time_step, settings.shape);
    const auto put =
        [&](AlignedVector &to, const unsigned int row, const unsigned int k, const Complex &value)
    {
      to[2 * n_states * row + k] = value.real();
      to[2 * n_states * row + n_states + k] = value.imag();
    };
    for (unsigned int k = 0; k < n_poles; ++k)
    {
      const Complex factor = std::exp(model.poles[k] * settings.time_step);
      const Complex rest = model.load.empty() ? 0. : -model.load[k] / model.poles[k];
      put(e, 0, k, factor);
      put(p, 0, k, factor * (state[k] - rest));
      for (unsigned int i = 0; i < n; ++i)
      {
        put(w, i, k, (factor * weights.now[k] + weights.later[k]) * model.left(i, k));
        put(c, i, k, 2. * model.right(i, k));
        constant[i] += 2 * (model.right(i, k) * rest).real();
      }
    }
    if (n > few)
    {
      columns.resize(2 * n_states * n_padded);
      u.resize(n_padded);
      bool complex_shapes = false;
      for (std::size_t k = 0; k < n_states; ++k)
        for (unsigned int i = 0; i < n; ++i)
        {
          columns[k * n_padded + i] = c[2 * n_states * i + k];
          columns[(n_states + k) * n_padded + i] = -c[2 * n_states * i + n_states + k];
          complex_shapes = complex_shapes || c[2 * n_states * i + n_states + k] != 0;
        }
      all.resize(complex_shapes ? 2 * n_states : n_states);
      std::iota(all.begin(), all.end(), 0u);
      listed.resize(n);
      factors.resize(n);
      c.clear();
      show_many();
      return;
    }
    keep_real_shapes(model);
    for (unsigned int i = 0; i < n; ++i)
    {
      free[i] = constant[i];
      if (real_shapes)
      {
        for (std::size_t k = 0; k < n_states; ++k)
          free[i] += c[n_states * i + k] * p[k];
        continue;
      }
      for (std::size_t k = 0; k < n_states; ++k)
        free[i] += c[2 * n_states * i + k] * p[k] - c[2 * n_states * i + n_states + k] * p[n_states + k];
    }
  }

  void ModalRecursion::keep_real_shapes(const PoleModel &model)
  {
    const unsigned int n = model.n_rows();
    AlignedVector gains(2 * n_states, 0.), shapes(n * n_states, 0.);
    for (unsigned int k = 0; k < n_poles; ++k)
    {
      unsigned int row = 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        if (model.right(i, k).imag() != 0)
          return;
        shapes[n_states * i + k] = model.right(i, k).real();
        if (std::abs(model.right(i, k)) > std::abs(model.right(row, k)))
          row = i;
      }
      if (model.right(row, k) == 0.)
        return;
      const Complex gain = model.left(row, k) / model.right(row, k);
      for (unsigned int i = 0; i < n; ++i)
        if (std::abs(model.left(i, k) - gain * model.right(i, k)) > 1e-15 * std::abs(model.left(row, k)))
          return;
      // w of the largest row, and twice as p
      gains[k] = 2 * w[2 * n_states * row + k] / model.right(row, k).real();
      gains[n_states + k] = 2 * w[2 * n_states * row + n_states + k] / model.right(row, k).real();
    }
    real_shapes = true;
    w = gains;
    c = shapes;
    for (double &value : p)
      value *= 2;
  }

  void ModalRecursion::show_many()
  {
    std::copy(constant.begin(), constant.end(), u.begin());
    wide_add_columns(u.data(), columns.data(), n_padded, all.data(), p.data(), all.size());
    std::copy(u.begin(), u.begin() + free.size(), free.begin());
  }

  void ModalRecursion::advance(const double *q)
  {
    const unsigned int n = free.size();
    if (n_poles == 1 && n == 1 && !real_shapes)
    {
      const std::size_t i = n_states;
      const double real = e[0] * p[0] - e[i] * p[i] + w[0] * q[0];
      const double imaginary = e[0] * p[i] + e[i] * p[0] + w[i] * q[0];
      p[0] = real;
      p[i] = imaginary;
      free[0] = constant[0] + (c[0] * real - c[i] * imaginary);
      return;
    }
    if (real_shapes && n_poles == 1 && n == 1)
    {
      const std::size_t i = n_states;
      const double load = c[0] * q[0], real = e[0] * p[0] - e[i] * p[i] + w[0] * load;
      p[i] = e[0] * p[i] + e[i] * p[0] + w[i] * load;
      p[0] = real;
      free[0] = constant[0] + c[0] * real;
      return;
    }
    if (n <= few)
    {
      if (real_shapes)
        wide_real_recursion(p.data(), e.data(), w.data(), c.data(), q, free.data(), n_states, n);
      else
        wide_recursion(p.data(), e.data(), w.data(), c.data(), q, free.data(), n_states, n);
      for (unsigned int i = 0; i < n; ++i)
        free[i] += constant[i];
      return;
    }
    unsigned int n_listed = 0;
    for (unsigned int j = 0; j < n; ++j)
      if (q[j] != 0)
      {
        listed[n_listed] = j;
        factors[n_listed++] = q[j];
      }
    wide_rotate(p.data(), e.data(), n_states);
    wide_add_columns(p.data(), w.data(), 2 * n_states, listed.data(), factors.data(), n_listed);
    show_many();
  }

  void ModalRecursion::exchange(CheckpointFile &file)
  {
    std::vector<double> states(p.begin(), p.end());
    file("response/states", states);
    file("response/free", free);
    std::copy(states.begin(), states.end(), p.begin());
  }
} // namespace vibrocontact
