#include <vibrocontact/contact/laws/signorini.h>
#include <vibrocontact/propagators/modal_recursion.h>
#include <vibrocontact/propagators/step_weights.h>

#include <algorithm>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    constexpr unsigned int few = 4;
  }

  ModalRecursion::ModalRecursion(const BodyInContact &model, const std::vector<Complex> &state,
                                 const PropagatorSettings &settings, const StepWeights &weights)
      : n_poles(model.n_poles()), n_states(padded(model.n_poles())), p(2 * n_states), e(2 * n_states),
        w(2 * n_states * model.n_rows()), c(2 * n_states * model.n_rows()), constant(model.n_rows(), 0.),
        fall(model, settings.time_step)
  {
    const unsigned int n = model.n_rows();
    one_step = one_step_compliance(model, weights);
    free.resize(n);
    const auto put =
        [&](AlignedVector &to, const unsigned int row, const unsigned int k, const Complex &value)
    {
      to[2 * n_states * row + k] = value.real();
      to[2 * n_states * row + n_states + k] = value.imag();
    };
    for (unsigned int k = 0; k < n_poles; ++k)
    {
      const Complex factor = weights.factor[k];
      const Complex rest = rest_of_state(model, k);
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
      u.resize(padded(n));
      bool complex_shapes = false;
      for (std::size_t at = 0; at < c.size(); ++at)
        complex_shapes = complex_shapes || (at / n_states % 2 == 1 && c[at] != 0);
      DenseMatrix right(n, complex_shapes ? 2 * n_states : n_states), left(n, 2 * n_states);
      for (unsigned int i = 0; i < n; ++i)
        for (std::size_t k = 0; k < 2 * n_states; ++k)
        {
          left(i, k) = w[2 * n_states * i + k];
          if (k < right.n())
            right(i, k) = k < n_states ? c[2 * n_states * i + k] : -c[2 * n_states * i + k];
        }
      many = rows_and_states(right, left);
      c.clear();
      w.clear();
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
    fall.add_to(free.data());
  }

  void ModalRecursion::keep_real_shapes(const BodyInContact &model)
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
    many.show.add_to(u.data(), p.data());
    std::copy(u.begin(), u.begin() + free.size(), free.begin());
    fall.add_to(free.data());
  }

  void ModalRecursion::advance(const double *q)
  {
    const unsigned int n = free.size();
    fall.advance();
    if (n <= few)
    {
      if (real_shapes)
        wide_real_recursion(p.data(), e.data(), w.data(), c.data(), q, free.data(), n_states, n);
      else
        wide_recursion(p.data(), e.data(), w.data(), c.data(), q, free.data(), n_states, n);
      for (unsigned int i = 0; i < n; ++i)
        free[i] += constant[i];
      fall.add_to(free.data());
      return;
    }
    wide_rotate(p.data(), e.data(), n_states);
    many.load.add_sparse_to(p.data(), q);
    show_many();
  }

  unsigned long ModalRecursion::advance_in_contact(const unsigned int n_steps, const double *heights,
                                                   double *displacements, double *forces)
  {
    if (n_poles > 1 || !fall.is_none())
      return Propagator::advance_in_contact(n_steps, heights, displacements, forces);
    // the state as minus the force that it takes to undo its displacement, so that a step waits for little: a
    // product, a sum and a comparison; what the force before did not change is computed beside
    const std::size_t i = n_states;
    const double stiffness = 1 / one_step(0, 0), own = constant[0];
    const Complex shape(c[0], real_shapes ? 0. : c[i]),
        scale = -stiffness * shape, decay(e[0], e[i]),
        gain = scale * Complex(w[0], w[i]) * (real_shapes ? c[0] : 1.);
    const Complex before = scale * Complex(p[0], p[i]);
    const double er = decay.real(), ei = decay.imag(), gr = gain.real(), gi = gain.imag();
    // real part: without the last force, and by it
    double rest = before.real(), pushed = 0, imaginary = before.imag();
    unsigned long closed = 0;
    for (unsigned int k = 0; k < n_steps; ++k)
    {
      const double force = rigid_force(((heights[k] - own) * stiffness + rest) + pushed),
                   real = rest + pushed;
      forces[k] = force;
      displacements[k] = force > 0 ? heights[k] : own - real * one_step(0, 0);
      closed += force > 0;
      rest = er * real - ei * imaginary;
      imaginary = er * imaginary + ei * real + gi * force;
      pushed = gr * force;
    }
    const Complex after = Complex(rest + pushed, imaginary) / scale;
    p[0] = after.real();
    p[i] = after.imag();
    free[0] = own + (shape * after).real();
    return closed;
  }

  void ModalRecursion::exchange(CheckpointFile &file)
  {
    std::vector<double> states(p.begin(), p.end());
    file("propagator/states", states);
    file("propagator/free", free);
    fall.exchange(file, "propagator/fall");
    std::copy(states.begin(), states.end(), p.begin());
  }
} // namespace vibrocontact
