// Error E of the identified ring of the tyre paper against the number of pole pairs, for all variants, and what they are worth in
// contact: the tables of doc/identification.md. Three entries, 0 to 1000 Hz by 1 Hz, |n| <= 400.
#include "../unit/ring_data.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/identified_model.h>
#include <vibrocontact/numerics/lsce.h>
#include <vibrocontact/numerics/vector_fitting.h>
#include <vibrocontact/propagators/well_posedness.h>

#include <chrono>
#include <cstdio>

using namespace vibrocontact;

namespace
{
  const EntryMap map = {3, {0, 1, 2, 1, 0, 1, 2, 1, 0}};

  double seconds()
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  /// smallest over largest eigenvalue of the compliance at 20, 10, 2 us and in the limit; |g(0+)| over the largest g
  void print_well_posedness(const PoleFit &fit)
  {
    const WellPosedness r = well_posedness_of_contact(identified_model(fit, map).model, 20e-6);
    std::printf(" | %9.2e %9.2e %9.2e %9.2e g0 %7.1e %s", r.definiteness[0], r.definiteness[1],
                r.definiteness[2], r.limit, r.initial_value, r.usable() ? "usable" : "refused");
  }
} // namespace

int main()
{
  const Spectra clean = ring_data::spectra(), noisy = ring_data::with_noise(clean, 0.01, 1);
  ResidueRules none, direct, zero, real;
  direct.direct = zero.zero_initial_value = real.real_amplitudes = true;
  const auto vector_fitting = [&](const Spectra &data, const ResidueRules &rules, const unsigned int n)
  {
    VectorFittingOptions options;
    options.rules = rules;
    return vector_fit(data, n, options);
  };
  for (const unsigned int n : {8u, 10u, 12u, 14u, 15u, 16u, 18u, 20u, 22u, 25u, 28u, 30u})
  {
    std::printf("%2u pairs\n", n);
    const auto show = [&](const char *name, const PoleFit &fit, const double begin)
    {
      std::printf("  %-42s E %.2e, %g pairs, %u unstable, %.2f s", name, worst_error(clean, fit),
                  fit.n_pairs(), fit.n_unstable(), seconds() - begin);
      print_well_posedness(fit);
      std::printf("\n");
    };
    double begin = seconds();
    const PoleFit free = vector_fitting(clean, none, n);
    show("vector fitting", free, begin);
    show("  g(0+) = 0 imposed on the residues alone", fit_residues(clean, free.poles, zero), begin);
    begin = seconds();
    show("vector fitting with g(0+) = 0", vector_fitting(clean, zero, n), begin);
    begin = seconds();
    show("vector fitting with direct term", vector_fitting(clean, direct, n), begin);
    begin = seconds();
    show("vector fitting, 1 % noise", vector_fitting(noisy, none, n), begin);
    begin = seconds();
    show("vector fitting with g(0+) = 0, 1 % noise", vector_fitting(noisy, zero, n), begin);
    begin = seconds();
    show("LSCE", lsce_fit(clean, n), begin);
    show("LSCE with real amplitudes", lsce_fit(clean, n, real), begin);
    show("LSCE, 1 % noise", lsce_fit(noisy, n), begin);
  }
  return 0;
}
