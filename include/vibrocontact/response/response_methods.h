#pragma once

#include <vibrocontact/response/response.h>

#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  struct ResponseMethod
  {
    std::string name, help;
    std::unique_ptr<Response> (*create)(const PoleModel &, const std::vector<std::complex<double>> &state,
                                        const ResponseSettings &);
  };

  /// modal recursion, direct convolution, block convolution; direct convolution, scalar
  const std::vector<ResponseMethod> &response_methods();
  /// @throws InputError naming the methods
  std::unique_ptr<Response> create_response(const std::string &name, const PoleModel &model,
                                            const std::vector<std::complex<double>> &state,
                                            const ResponseSettings &settings);
} // namespace vibrocontact
