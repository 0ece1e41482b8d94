#include <vibrocontact/propagators/work_account.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  void WorkAccount::exchange(CheckpointFile &file)
  {
    file("work/input", input);
    file("work/returned", returned);
    file("work/impacts", impacts);
    file("work/friction", friction);
    file("work/damping", damping);
    file("work/least", least_work);
  }

  bool ModalEnergy::applies(const BodyInContact &model)
  {
    if (model.relaxation > 0 && has_rest(model))
      return false;
    for (unsigned int k = 0; k < model.n_poles(); ++k)
    {
      if (model.poles[k].imag() == 0 || is_rigid_motion(model.poles[k]))
        return false;
      const Complex gain = 1. / Complex(0, 2 * model.poles[k].imag());
      for (unsigned int i = 0; i < model.n_rows(); ++i)
        if (model.right(i, k).imag() != 0 ||
            std::abs(model.left(i, k) - gain * model.right(i, k)) > 1e-12 * std::abs(model.left(i, k)))
          return false;
    }
    return true;
  }

  ModalEnergy::ModalEnergy(const BodyInContact &model) : model(model) {}

  std::vector<Complex> ModalEnergy::from_equilibrium(const std::vector<Complex> &state) const
  {
    std::vector<Complex> result = state;
    for (unsigned int k = 0; k < model.pole_load.size(); ++k)
      result[k] += model.pole_load[k] / model.poles[k];
    return result;
  }

  double ModalEnergy::energy(const std::vector<Complex> &state) const
  {
    double sum = 0;
    for (unsigned int k = 0; k < model.n_poles(); ++k)
    {
      const double rate = 2 * (model.poles[k] * state[k]).real(), place = 2 * state[k].real();
      sum += 0.5 * (rate * rate + std::norm(model.poles[k]) * place * place);
    }
    return sum;
  }

  double ModalEnergy::damping_power(const std::vector<Complex> &state) const
  {
    double sum = 0;
    for (unsigned int k = 0; k < model.n_poles(); ++k)
      sum -= 2 * model.poles[k].real() * std::pow(2 * (model.poles[k] * state[k]).real(), 2);
    return sum;
  }

  SteppedModalWork::SteppedModalWork(const BodyInContact &model, const std::vector<Complex> &state,
                                     const double time_step, const ForceInterpolation interpolation)
      : model(model), modes(model), h(time_step), interpolation(interpolation),
        z(modes.from_equilibrium(state)), next(z), weights(step_weights(model, time_step, interpolation)),
        last(model.n_rows(), 0.)
  {
    initial = modes.energy(z);
  }

  double SteppedModalWork::displacement(const unsigned int i, const std::vector<Complex> &state) const
  {
    double sum = 0;
    for (unsigned int k = 0; k < model.n_poles(); ++k)
      sum += 2 * (model.right(i, k) * state[k]).real();
    return sum;
  }

  double SteppedModalWork::velocity(const unsigned int i, const std::vector<Complex> &state) const
  {
    double sum = 0;
    for (unsigned int k = 0; k < model.n_poles(); ++k)
      sum += 2 * (model.right(i, k) * model.poles[k] * state[k]).real();
    return sum;
  }

  void SteppedModalWork::add(const double *q)
  {
    const unsigned int n = model.n_rows(), n_poles = model.n_poles();
    if (interpolation == ForceInterpolation::impulse)
    {
      next = z;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int k = 0; k < n_poles && q[i] != 0; ++k)
          next[k] += h * q[i] * model.left(i, k);
      for (unsigned int i = 0; i < n; ++i)
        if (q[i] != 0)
          work += 0.5 * h * q[i] * (velocity(i, z) + velocity(i, next));
      for (unsigned int k = 0; k < n_poles; ++k)
        z[k] = weights.factor[k] * next[k];
      std::copy_n(q, n, last.begin());
      return;
    }
    const bool linear = interpolation == ForceInterpolation::linear;
    for (unsigned int k = 0; k < n_poles; ++k)
    {
      Complex now = 0, before = 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        now += model.left(i, k) * q[i];
        before += model.left(i, k) * last[i];
      }
      next[k] = weights.factor[k] * z[k] + weights.now[k] * now + weights.later[k] * before;
    }
    for (unsigned int i = 0; i < n; ++i)
    {
      const double old = linear ? last[i] : q[i];
      if (q[i] == 0 && old == 0)
        continue;
      // by parts: q u' = (q u)' - q' u
      work += q[i] * displacement(i, next) - old * displacement(i, z);
      if (!linear || q[i] == old)
        continue;
      double integral = 0;
      for (unsigned int k = 0; k < n_poles; ++k)
      {
        Complex push = 0;
        for (unsigned int j = 0; j < n; ++j)
          push += model.left(j, k) * (0.5 * h * (q[j] + last[j]));
        integral += 2 * (model.right(i, k) * (next[k] - z[k] - push) / model.poles[k]).real();
      }
      work -= (q[i] - old) / h * integral;
    }
    std::swap(z, next);
    std::copy_n(q, n, last.begin());
  }

  double SteppedModalWork::energy() const
  {
    double sum = modes.energy(z);
    for (unsigned int i = 0; i < model.residual.m(); ++i)
      for (unsigned int j = 0; j < model.residual.m(); ++j)
        sum += 0.5 * last[i] * model.residual(i, j) * last[j];
    return sum;
  }

  double SteppedModalWork::damping() const
  {
    return initial + work - modes.energy(z);
  }

  void SteppedModalWork::exchange(CheckpointFile &file)
  {
    file("modal_work", z);
    file("modal_work/last", last);
    file("modal_work/work", work);
  }
} // namespace vibrocontact
