#pragma once

#include <vibrocontact/bodies/identified_model.h>
#include <vibrocontact/numerics/pole_fit.h>

namespace vibrocontact
{
  /// Green's functions of data that nothing is fitted to, by inverse Fourier transform: with the real parts alone, which say
  /// all of a causal function (the imaginary parts would add motion before the force),
  ///
  ///   g(t) = 4 int_0^f_max Re G(f) cos(2 pi f t) df,     t > 0,
  ///
  /// by trapezoids over the data's equally spaced lines. Nothing is taken to be above the band, and g repeats itself
  /// after 1 / spacing, backwards from half of that on. As poles on the imaginary axis it takes the exact integrals
  /// of force interpolations like any other model; n_rows states per line. For comparison: a fit by poles is a hundred times
  /// cheaper and, by its behaviour above the band, more accurate.
  /// @throws InputError if the lines are not equally spaced from zero on
  BodyInContact band_limited_model(const Spectra &data, const EntryMap &map);

  /// Half the period of such a g: forces have to be forgotten by then [s].
  double band_limited_memory(const Spectra &data);
} // namespace vibrocontact
