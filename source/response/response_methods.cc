#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/response/block_convolution.h>
#include <vibrocontact/response/direct_convolution.h>
#include <vibrocontact/response/modal_recursion.h>
#include <vibrocontact/response/response_methods.h>

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
} // namespace vibrocontact
