#pragma once

#include <vibrocontact/analyses/frequency_response/frequency_response.h>
#include <vibrocontact/analyses/frequency_response/modal_response.h>
#include <vibrocontact/base/table.h>

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// One way to compute a response, at some frequencies.
  struct ResponseVariant
  {
    /// direct, hysteretic, time domain
    std::string method;
    /// modes that it uses, 0 for direct
    unsigned int n_modes = 0;
    std::vector<double> frequency;
    /// receptances [m/N]
    std::vector<Receptance> response;
    /// H_ij = H_ji; not of a body that turns
    bool is_reciprocal = true;
  };

  /// All pairs of points, upper triangle unless the response is not reciprocal: column <response>_<force>_real_m_Ns and ..._imag_m_Ns (m_N for
  /// receptances).
  Table response_table(const FrequencyResponseParameters &parameters, const ResponseVariant &variant,
                       const std::string &body);

  /// The variants at the check frequencies, a row per frequency and variant.
  Table check_table(const FrequencyResponseParameters &parameters,
                    const std::vector<ResponseVariant> &variants, const std::string &body);

  /// How far each variant is from the first: difference of the receptance, relative to it (transfers: to the
  /// geometric mean of both driving points), and of its imaginary part, relative to that unless it nearly
  /// vanishes.
  nlohmann::ordered_json checks_json(const FrequencyResponseParameters &parameters,
                                     const std::vector<ResponseVariant> &variants);

  /// Largest and median difference over all frequencies, per pair, relative as in checks_json().
  nlohmann::ordered_json difference_json(const FrequencyResponseParameters &parameters,
                                         const ResponseVariant &exact, const ResponseVariant &other);

  /// Calls action(label of a point, index of its own response into a Receptance) for every point.
  void for_each_driving_point(const FrequencyResponseParameters &parameters,
                              const std::function<void(const std::string &, unsigned int)> &action);

  /// What the terminal ends with about analyses.frequency_response of results.json, see Answer.
  std::vector<std::string> frequency_response_answer(const nlohmann::ordered_json &response);
} // namespace vibrocontact
