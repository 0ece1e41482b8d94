#pragma once

#include <vibrocontact/contact/laws.h>

namespace vibrocontact
{
  /// A normal law as the compression d(f) that a contact force f needs [m]: zero for the rigid stop, f / k for the
  /// linear spring, log(1 + f/a) / alpha for the exponential penalty with its linear continuation beyond alpha d = 2.
  ///
  /// It is continued smoothly to negative forces, so that the end of a contact is a simple zero.
  struct StopLaw
  {
    enum class Kind
    {
      rigid,
      spring,
      penalty
    } kind = Kind::rigid;
    /// k = a alpha, slope at touch [N/m]; a [N], alpha [1/m] of the penalty
    double stiffness = 0, amplitude = 0, exponent = 0;

    static StopLaw rigid() { return {}; }
    static StopLaw spring(const double k) { return {Kind::spring, k, 0., 0.}; }
    static StopLaw penalty(const double a, const double alpha)
    {
      return {Kind::penalty, a * alpha, a, alpha};
    }
    bool is_linear() const { return kind != Kind::penalty; }

    /// d(f) [m] and d'(f) [m/N]
    double compression(double force) const;
    double compliance(double force) const;
    /// energy stored at the compression d(f) [J]
    double energy(double force) const;
  };

  /// @throws InputError for laws that are neither Signorini's, a linear spring nor the exponential penalty
  StopLaw stop_law(const NormalLaw &law);
} // namespace vibrocontact
