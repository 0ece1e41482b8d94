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

  Complex ModalEnergy::gain(const Complex pole)
  {
    return 1. / Complex(0, 2 * pole.imag());
  }

  bool ModalEnergy::applies(const BodyInContact &model)
  {
    if (model.relaxation > 0 && has_rest(model))
      return false;
    for (unsigned int k = 0; k < model.n_poles(); ++k)
    {
      if (model.poles[k].imag() == 0 || is_rigid_motion(model.poles[k]))
        return false;
      const Complex gain = ModalEnergy::gain(model.poles[k]);
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
        z(modes.from_equilibrium(state)), weights(step_weights(model, time_step, interpolation)),
        shapes(model.n_poles(), model.n_rows()), last(model.n_rows()), modal_force(model.n_poles()),
        last_modal_force(model.n_poles())
  {
    for (unsigned int k = 0; k < model.n_poles(); ++k)
      for (unsigned int i = 0; i < model.n_rows(); ++i)
        shapes(k, i) = model.right(i, k).real();
    for (const Complex pole : model.poles)
      gains.push_back(ModalEnergy::gain(pole));
    initial = modes.energy(z);
  }

  void SteppedModalWork::set_modal_force(const DenseVector &q, DenseVector &on_modes) const
  {
    if (on_modes.size() > 0)
      shapes.vmult(on_modes, q);
  }

  void SteppedModalWork::add(const double *q)
  {
    std::copy(q, q + last.size(), last.begin());
    set_modal_force(last, modal_force);
    for (unsigned int k = 0; k < z.size(); ++k)
    {
      const double now = modal_force[k], before = last_modal_force[k];
      const Complex into = gains[k];
      if (interpolation == ForceInterpolation::impulse)
      {
        const Complex next = z[k] + h * now * into;
        work += h * now * (model.poles[k] * (z[k] + next)).real();
        z[k] = weights.factor[k] * next;
        continue;
      }
      const Complex next =
          weights.factor[k] * z[k] + (weights.now[k] * now + weights.later[k] * before) * into;
      // by parts: q u' = (q u)' - q' u
      if (interpolation == ForceInterpolation::linear)
      {
        const Complex push = 0.5 * h * (now + before) * into,
                      integral = (next - z[k] - push) / model.poles[k];
        work += 2 * (now * next - before * z[k] - (now - before) / h * integral).real();
      }
      else
        work += 2 * now * (next - z[k]).real();
      z[k] = next;
    }
    std::swap(modal_force, last_modal_force);
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
    set_modal_force(last, last_modal_force);
    file("modal_work/work", work);
  }
} // namespace vibrocontact
