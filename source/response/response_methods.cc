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
    std::unique_ptr<Response> create(const PoleModel &model, const std::vector<std::complex<double>> &state,
                                     const ResponseSettings &settings)
    {
      return std::make_unique<Method>(model, state, settings, wide...);
    }
  } // namespace

  const ResponseMethods &response_methods()
  {
    static const ResponseMethods methods = {
        {"modal recursion", "exact propagation of one complex state per pole", false,
         &create<ModalRecursion>},
        {"direct convolution", "sum over the newest forces in every step", true,
         &create<DirectConvolution, true>},
        {"block convolution", "the same sum by fast Fourier transforms of blocks", true,
         &create<BlockConvolution>},
        {"direct convolution, scalar", "the same sum by a plain loop, for comparison", true,
         &create<DirectConvolution, false>}};
    return methods;
  }

  std::unique_ptr<Response> create_response(const std::string &name, const PoleModel &model,
                                            const std::vector<std::complex<double>> &state,
                                            const ResponseSettings &settings, const ResponseMethods &table)
  {
    return find_named(table, name, "response method").create(model, state, settings);
  }
} // namespace vibrocontact
