#pragma once

#include <vibrocontact/propagators/response.h>

#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// One row of the table of response methods: how the motion of a body with poles is propagated.
  struct ResponseMethod
  {
    std::string name, help;
    /// whether it sums over past forces, which it can forget
    bool is_convolution;
    /// whether it is the theta-method, whose theta is given
    bool takes_theta;
    std::unique_ptr<Response> (*create)(const BodyInContact &, const std::vector<std::complex<double>> &state,
                                        const ResponseSettings &);
  };

  using ResponseMethods = std::vector<ResponseMethod>;
  /// The shipped ones: modal recursion, theta method, direct convolution, block convolution; direct convolution, scalar. A
  /// program may have more (run/tables.h).
  const ResponseMethods &response_methods();
  /// @throws InputError naming the methods
  std::unique_ptr<Response> create_response(const std::string &name, const BodyInContact &model,
                                            const std::vector<std::complex<double>> &state,
                                            const ResponseSettings &settings,
                                            const ResponseMethods &table = response_methods());
} // namespace vibrocontact
