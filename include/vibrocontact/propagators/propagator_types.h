#pragma once

#include <vibrocontact/propagators/propagator.h>

#include <memory>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// One row of the table of propagators: how the motion of a body with poles is propagated.
  struct PropagatorType
  {
    std::string name, help;
    /// whether it sums over past forces, which it can forget
    bool is_convolution;
    /// whether it is the theta method, whose theta is given
    bool takes_theta;
    std::unique_ptr<Propagator> (*create)(const BodyInContact &,
                                          const std::vector<std::complex<double>> &state,
                                          const PropagatorSettings &);
  };

  using PropagatorTypes = std::vector<PropagatorType>;
  /// The shipped ones: modal recursion, theta method, direct convolution, block convolution; direct convolution, scalar. A
  /// program may have more (run/tables.h).
  const PropagatorTypes &propagator_types();
  /// A rest that relaxes goes by poles (rest_by_poles()). @param state of the model's own poles
  /// @throws InputError naming the methods
  std::unique_ptr<Propagator> create_propagator(const std::string &name, const BodyInContact &model,
                                                const std::vector<std::complex<double>> &state,
                                                const PropagatorSettings &settings,
                                                const PropagatorTypes &table = propagator_types());
} // namespace vibrocontact
