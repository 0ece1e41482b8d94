#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/response/block_convolution.h>
#include <vibrocontact/response/direct_convolution.h>
#include <vibrocontact/response/modal_recursion.h>
#include <vibrocontact/response/response.h>
#include <vibrocontact/response/step_weights.h>

#include <cmath>

namespace vibrocontact
{
  namespace
  {
    template <typename Method, bool... wide>
    std::unique_ptr<Response> create(const PoleModel &model, const std::vector<std::complex<double>> &state,
                                     const ResponseSettings &settings)
    {
      return std::make_unique<Method>(model, state, settings, wide...);
    }
  } // namespace

  unsigned long Response::advance_in_contact(const unsigned int n_steps, const double *heights,
                                             double *displacements, double *forces)
  {
    const double inverse = 1 / one_step(0, 0);
    unsigned long closed = 0;
    for (unsigned int k = 0; k < n_steps; ++k)
    {
      const double trial = (heights[k] - free[0]) * inverse;
      forces[k] = trial > 0 ? trial : 0.;
      displacements[k] = trial > 0 ? heights[k] : free[0];
      closed += trial > 0;
      advance(forces + k);
    }
    return closed;
  }

  const std::vector<std::string> &force_shape_names()
  {
    static const std::vector<std::string> names = {"impulse", "constant", "linear"};
    return names;
  }

  ForceShape force_shape(const std::string &name)
  {
    for (unsigned int k = 0; k < force_shape_names().size(); ++k)
      if (force_shape_names()[k] == name)
        return static_cast<ForceShape>(k);
    throw InputError("There is no force shape \"" + name + "\": choose impulse, constant or linear.");
  }

  std::vector<std::complex<double>> state_at_rest(const PoleModel &model)
  {
    return std::vector<std::complex<double>>(model.n_poles(), 0.);
  }

  std::vector<std::complex<double>> state_in_equilibrium(const PoleModel &model)
  {
    std::vector<std::complex<double>> state = state_at_rest(model);
    for (unsigned int k = 0; k < model.load.size(); ++k)
      state[k] = -model.load[k] / model.poles[k];
    return state;
  }

  const std::vector<ResponseMethod> &response_methods()
  {
    static const std::vector<ResponseMethod> methods = {
        {"modal recursion", "exact propagation of one complex state per pole", &create<ModalRecursion>},
        {"direct convolution", "sum over the newest forces in every step", &create<DirectConvolution, true>},
        {"block convolution", "the same sum by fast Fourier transforms of blocks", &create<BlockConvolution>},
        {"direct convolution, scalar", "the same sum by a plain loop, for comparison",
         &create<DirectConvolution, false>}};
    return methods;
  }

  std::unique_ptr<Response> create_response(const std::string &name, const PoleModel &model,
                                            const std::vector<std::complex<double>> &state,
                                            const ResponseSettings &settings)
  {
    std::string known;
    for (const ResponseMethod &method : response_methods())
    {
      if (method.name == name)
        return method.create(model, state, settings);
      known += (known.empty() ? "" : ", ") + method.name;
    }
    throw InputError("There is no response method \"" + name + "\": choose one of " + known + ".");
  }

  unsigned long steps_of_memory(const PoleModel &model, const double time_step, const double share,
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
    const unsigned int n = model.n_rows();
    PoleModel moving = model;
    moving.residual.reinit(0, 0);
    const auto kernel =
        step_kernel(moving, time_step, ForceShape::impulse,
                    std::min(most_steps, static_cast<unsigned long>(std::ceil(high / time_step))));
    double largest = 0;
    for (unsigned int i = 0; i < n; ++i)
      for (const double value : kernel[i * n + i])
        largest = std::max(largest, std::abs(value));
    unsigned long last = 0;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned long k = last; k < kernel[i * n + i].size(); ++k)
        if (std::abs(kernel[i * n + i][k]) > share * largest)
          last = k + 1;
    return last;
  }
} // namespace vibrocontact
