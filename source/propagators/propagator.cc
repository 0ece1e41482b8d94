#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/laws/signorini.h>
#include <vibrocontact/propagators/propagator.h>

namespace vibrocontact
{
  unsigned long Propagator::advance_in_contact(const unsigned int n_steps, const double *heights,
                                               double *displacements, double *forces)
  {
    const double inverse = 1 / one_step(0, 0);
    unsigned long closed = 0;
    for (unsigned int k = 0; k < n_steps; ++k)
    {
      forces[k] = rigid_force((heights[k] - free[0]) * inverse);
      displacements[k] = forces[k] > 0 ? heights[k] : free[0];
      closed += forces[k] > 0;
      advance(forces + k);
    }
    return closed;
  }

  const std::vector<std::string> &force_interpolation_names()
  {
    static const std::vector<std::string> names = {"impulse", "constant", "linear"};
    return names;
  }

  ForceInterpolation force_interpolation(const std::string &name)
  {
    for (unsigned int k = 0; k < force_interpolation_names().size(); ++k)
      if (force_interpolation_names()[k] == name)
        return static_cast<ForceInterpolation>(k);
    throw InputError("There is no force shape \"" + name + "\": choose impulse, constant or linear.");
  }

  std::vector<std::complex<double>> state_at_rest(const BodyInContact &model)
  {
    return std::vector<std::complex<double>>(model.n_poles(), 0.);
  }

  std::vector<std::complex<double>> state_in_equilibrium(const BodyInContact &model)
  {
    std::vector<std::complex<double>> state = state_at_rest(model);
    for (unsigned int k = 0; k < model.pole_load.size(); ++k)
    {
      if (is_rigid_motion(model.poles[k]) && model.pole_load[k] != 0.)
        throw InputError(
            "Modal convolution/Initial state is equilibrium, but the body is free and falls under "
            "its loads: set it to at rest.");
      state[k] = rest_of_state(model, k);
    }
    return state;
  }
} // namespace vibrocontact
