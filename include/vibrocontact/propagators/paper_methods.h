#pragma once

#include <vibrocontact/propagators/step_weights.h>

namespace vibrocontact
{
  /// The tyre paper's own forms (Meftah & Duhamel 2011) for one rigid contact point, for the comparison of methods only:
  /// what this project uses instead stands in propagators/modal_recursion.h. Loads and initial state are exact in all.
  class PaperMethod
  {
  public:
    enum class Form
    {
      /// Eqs 18, 19, 25 as printed: sums of growing exponentials e^(-lambda t_n) q_n, no more numbers at
      /// t = 709.8 / (xi omega)
      growing,
      /// Eqs 39-49 corrected: two Gauss forces per step impose displacement and velocity at its end, Psi with h/2 and
      /// arguments t + h - t_i, accepted if their mean is not negative
      gauss,
      /// Eqs 39-49 with the printed Psi (h in place of h/2: half of each correction is applied) and without the test
      gauss_as_printed
    };

    PaperMethod(Form form, const BodyInContact &model, const std::vector<std::complex<double>> &state,
                double time_step);
    /// @param heights, rates of the road at the ends of the steps [m, m/s]; @param displacements at the ends and
    /// @param forces (impulse at the beginning over h, or mean of the Gauss forces); n_steps each
    void run(unsigned long n_steps, const double *heights, const double *rates, double *displacements,
             double *forces);

  private:
    void run_growing(unsigned long n_steps, const double *heights, double *displacements, double *forces);
    void run_gauss(unsigned long n_steps, const double *heights, const double *rates, double *displacements,
                   double *forces);

    const Form form;
    const double h;
    FreeMotion motion;
    /// lambda, 2 R
    std::vector<std::complex<double>> poles, gains;
  };
} // namespace vibrocontact
