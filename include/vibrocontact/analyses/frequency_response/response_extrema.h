#pragma once

#include <vibrocontact/analyses/frequency_response/frequency_response_output.h>

#include <array>
#include <complex>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// A maximum or minimum of the magnitude at a driving point over frequency.
  struct ResponseExtremum
  {
    std::string point;
    bool is_maximum = true;
    /// by extremum_between() [Hz]; of the quantity that is shown
    double frequency = 0, magnitude = 0;
    /// the same of the frequency computed that stands out
    double computed_frequency = 0, computed = 0;

    /// Whether both magnitudes agree, in their logarithm.
    bool is_resolved(double accuracy) const;
  };

  /// Where |H| is largest or smallest between three frequencies, H the function (a + b f) / (1 + d f) through its complex values there: one mode
  /// and a constant. @return frequency and magnitude; of the middle if nothing damps, or the function turns nowhere
  std::pair<double, double> extremum_between(const std::array<double, 3> &frequency,
                                             const std::array<std::complex<double>, 3> &value,
                                             bool is_maximum);

  /// Those of the driving points that stand out by 20 % on both sides.
  std::vector<ResponseExtremum> response_extrema(const FrequencyResponseParameters &parameters,
                                                 const ResponseVariant &variant);

  using ResponseSolver = std::function<ResponseVariant(const std::vector<double> &)>;

  /// Takes more frequencies in.
  void insert(const ResponseVariant &more, ResponseVariant &variant);

  /// A response with so many frequencies more that its extrema are those of the body: natural frequencies, then where extremum_between() sees
  /// extrema that are not resolved to an accuracy.
  ResponseVariant with_resolved_extrema(const FrequencyResponseParameters &parameters,
                                        ResponseVariant variant,
                                        const std::vector<double> &natural_frequencies, double accuracy,
                                        const ResponseSolver &solve);
} // namespace vibrocontact
