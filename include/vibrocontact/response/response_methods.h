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
    /// whether it sums over past forces, which it can forget
    bool is_convolution;
    std::unique_ptr<Response> (*create)(const BodyInContact &, const std::vector<std::complex<double>> &state,
                                        const ResponseSettings &);
  };

  /// modal recursion, theta method, direct convolution, block convolution; direct convolution, scalar
  const std::vector<ResponseMethod> &response_methods();
  /// @throws InputError naming the methods
  const ResponseMethod &response_method(const std::string &name);
  /// @throws InputError naming the methods
  std::unique_ptr<Response> create_response(const std::string &name, const BodyInContact &model,
                                            const std::vector<std::complex<double>> &state,
                                            const ResponseSettings &settings);
} // namespace vibrocontact
