#pragma once

#include <vibrocontact/receptances/frequency_data.h>

namespace vibrocontact
{
  /// Receptance at multiples of 1 / duration of impulse responses sampled at equal steps from t = 0 on, up to half the sampling rate.
  ///
  /// Trapezoids (a jump at 0+ counts half) give by FFT the sum of the spectrum and its images at multiples of the sampling rate. A response
  /// that begins with a blow at t = 0 and is smooth afterwards has images of its beginning alone, and those of powers of t are known in
  /// closed form: where a polynomial through the first samples converges, its images are taken off. It does not converge for responses that
  /// were filtered or made of a spectrum, which have no images, or that begin between two samples: those stay as trapezoids give them.
  /// @throws InputError if one is an acceleration or has not decayed: if the rms of its last tenth is beyond 5 % of its largest value
  void transform_to_frequency(FrequencyData &data, double step);
} // namespace vibrocontact
