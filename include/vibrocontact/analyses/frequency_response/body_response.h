#pragma once

#include <vibrocontact/analyses/frequency_response/frequency_response_output.h>
#include <vibrocontact/analyses/frequency_response/revolved_response.h>
#include <vibrocontact/run/meshed_body.h>

#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// The frequency response of one body with elements: what is asked for, from the cache or computed. A body solved by
  /// harmonics is quickly done and keeps nothing. All members are collective.
  class BodyResponse
  {
  public:
    /// @throws InputError for points that are not on the body, which is made for it
    static void check_points(MeshedBody &body, const FrequencyResponseParameters &parameters);

    /// @param speed of rolling, of a body by harmonics that turns past its points [m/s]
    BodyResponse(MeshedBody &body, const FrequencyResponseParameters &parameters, double speed);

    /// @throws InputError if a Count of modes does not reach as far as is asked for (check_reach_of_modes())
    void check_count();
    /// Omega, 0: at rest [rad/s]
    double rotation() const;

    ResponseVariant direct(const std::vector<double> &frequency);
    /// @param method hysteretic or time domain @param cut modes above are left out, 0: none [Hz]
    ResponseVariant modal(const std::string &method, double cut, const std::vector<double> &frequency);

  private:
    /// Omega of axes that turn with the body and bring Coriolis forces; 0: they do not [rad/s]
    double turning_axes() const;
    const ResponseReduction &reduction();
    const std::vector<TraceRow> &points();
    RevolvedResponse &waves();

    MeshedBody &body;
    const FrequencyResponseParameters &parameters;
    const double speed;
    const ReductionCache cache;
    const std::string key;
    std::optional<ResponseReduction> reduced;
    std::vector<TraceRow> rows;
    std::optional<RevolvedResponse> by_harmonics;
  };
} // namespace vibrocontact
