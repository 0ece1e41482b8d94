#include <vibrocontact/base/named_table.h>
#include <vibrocontact/propagators/block_convolution.h>
#include <vibrocontact/propagators/direct_convolution.h>
#include <vibrocontact/propagators/modal_recursion.h>
#include <vibrocontact/propagators/propagator_types.h>

namespace vibrocontact
{
  namespace
  {
    template <typename Method, bool... wide>
    std::unique_ptr<Propagator> create(const BodyInContact &model,
                                       const std::vector<std::complex<double>> &state,
                                       const PropagatorSettings &settings)
    {
      return std::make_unique<Method>(model, state, settings, wide...);
    }

    std::unique_ptr<Propagator> exact_recursion(const BodyInContact &model,
                                                const std::vector<std::complex<double>> &state,
                                                const PropagatorSettings &settings)
    {
      return std::make_unique<ModalRecursion>(
          model, state, settings, step_weights(model, settings.time_step, settings.interpolation));
    }

    std::unique_ptr<Propagator> theta_recursion(const BodyInContact &model,
                                                const std::vector<std::complex<double>> &state,
                                                const PropagatorSettings &settings)
    {
      return std::make_unique<ModalRecursion>(
          model, state, settings,
          theta_weights(model, settings.time_step, settings.interpolation, settings.theta));
    }
  } // namespace

  const PropagatorTypes &propagator_types()
  {
    static const PropagatorTypes methods = {
        {"modal recursion", "exact propagation of one complex state per pole", false, false,
         &exact_recursion},
        {"theta method", "Jean's theta method on the same states", false, true, &theta_recursion},
        {"direct convolution", "sum over the newest forces in every step", true, false,
         &create<DirectConvolution, true>},
        {"block convolution", "the same sum by fast Fourier transforms of blocks", true, false,
         &create<BlockConvolution>},
        {"direct convolution, scalar", "the same sum by a plain loop, for comparison", true, false,
         &create<DirectConvolution, false>}};
    return methods;
  }

  std::unique_ptr<Propagator> create_propagator(const std::string &name, const BodyInContact &model,
                                                const std::vector<std::complex<double>> &state,
                                                const PropagatorSettings &settings,
                                                const PropagatorTypes &table)
  {
    const PropagatorType &type = find_named(table, name, "propagator");
    if (!(model.relaxation > 0) || !has_rest(model))
      return type.create(model, state, settings);
    const BodyInContact whole = rest_by_poles(model);
    std::vector<std::complex<double>> states = state;
    states.resize(whole.n_poles());
    return type.create(whole, states, settings);
  }
} // namespace vibrocontact
