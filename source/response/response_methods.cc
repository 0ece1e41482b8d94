#include <vibrocontact/base/named_table.h>
#include <vibrocontact/response/block_convolution.h>
#include <vibrocontact/response/direct_convolution.h>
#include <vibrocontact/response/modal_recursion.h>
#include <vibrocontact/response/response_methods.h>

namespace vibrocontact
{
  namespace
  {
    template <typename Method, bool... wide>
    std::unique_ptr<Response> create(const BodyInContact &model,
                                     const std::vector<std::complex<double>> &state,
                                     const ResponseSettings &settings)
    {
      return std::make_unique<Method>(model, state, settings, wide...);
    }

    std::unique_ptr<Response> exact_recursion(const BodyInContact &model,
                                              const std::vector<std::complex<double>> &state,
                                              const ResponseSettings &settings)
    {
      return std::make_unique<ModalRecursion>(
          model, state, settings, step_weights(model, settings.time_step, settings.interpolation));
    }

    std::unique_ptr<Response> theta_recursion(const BodyInContact &model,
                                              const std::vector<std::complex<double>> &state,
                                              const ResponseSettings &settings)
    {
      return std::make_unique<ModalRecursion>(
          model, state, settings,
          theta_weights(model, settings.time_step, settings.interpolation, settings.theta));
    }
  } // namespace

  const std::vector<ResponseMethod> &response_methods()
  {
    static const std::vector<ResponseMethod> methods = {
        {"modal recursion", "exact propagation of one complex state per pole", false, &exact_recursion},
        {"theta method", "Jean's theta-method on the same states", false, &theta_recursion},
        {"direct convolution", "sum over the newest forces in every step", true,
         &create<DirectConvolution, true>},
        {"block convolution", "the same sum by fast Fourier transforms of blocks", true,
         &create<BlockConvolution>},
        {"direct convolution, scalar", "the same sum by a plain loop, for comparison", true,
         &create<DirectConvolution, false>}};
    return methods;
  }

  const ResponseMethod &response_method(const std::string &name)
  {
    return find_named(response_methods(), name, "response method");
  }

  std::unique_ptr<Response> create_response(const std::string &name, const BodyInContact &model,
                                            const std::vector<std::complex<double>> &state,
                                            const ResponseSettings &settings)
  {
    return response_method(name).create(model, state, settings);
  }
} // namespace vibrocontact
