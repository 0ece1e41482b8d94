// Identification: the tyre paper's ring from its frequency response, exact sums of poles, and what makes a model usable
// in contact.
#include "noisy_data.h"
#include "ring_data.h"

#include <vibrocontact/analyses/identification/identification.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/lsce.h>
#include <vibrocontact/numerics/vector_fitting.h>
#include <vibrocontact/propagators/step_weights.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace vibrocontact;
using Complex = std::complex<double>;

namespace
{
  const Spectra &ring()
  {
    static const Spectra data = ring_data::spectra();
    return data;
  }

  /// Toeplitz: entries of distance 0, 1, 2
  EntryMap ring_map()
  {
    return {3, {0, 1, 2, 1, 0, 1, 2, 1, 0}};
  }

  /// two pairs, a real pole and a constant, two entries
  PoleFit known_fit()
  {
    PoleFit fit;
    fit.poles = {{-300, 0}, {-20, 400}, {-90, 2500}};
    fit.residues = {{{0.7, 0}, {0.2, -1.5}, {-0.3, 0.4}}, {{0, 0}, {1, 1}, {2, -3}}};
    fit.direct = {1e-3, 0};
    return fit;
  }

  Spectra lines_of(const PoleFit &fit, const unsigned int n, const double step)
  {
    Spectra data;
    data.values.resize(fit.residues.size());
    for (unsigned int l = 0; l < n; ++l)
    {
      data.omega.push_back(2 * M_PI * step * l);
      for (unsigned int i = 0; i < data.values.size(); ++i)
        data.values[i].push_back(fit.value(i, data.omega.back()));
    }
    return data;
  }

  double smallest_slope(const PoleFit &fit)
  {
    DenseMatrix slope(3, 3), vectors;
    const EntryMap map = ring_map();
    for (unsigned int i = 0; i < 9; ++i)
      slope(i / 3, i % 3) = fit.initial(map.entry[i], 1);
    const std::vector<double> values = symmetric_eigenvalues(slope, vectors);
    return values.front() / values.back();
  }
} // namespace

TEST(Identification, RingOfTheTests)
{
  EXPECT_NEAR(ring_data::receptance(0, 0, 3000).real() * 1e6, 3.39624, 1e-5);
  const Complex at_100 = ring_data::receptance(200 * M_PI, 0, 3000) * 1e6;
  EXPECT_NEAR(at_100.real(), 5.91608, 1e-5);
  EXPECT_NEAR(at_100.imag(), -3.58979, 1e-5);
}

TEST(Identification, VectorFittingFindsKnownPoles)
{
  const PoleFit exact = known_fit();
  VectorFittingOptions options;
  options.rules.direct = true;
  const Spectra data = lines_of(exact, 500, 1.7);
  // five real unknowns: two pairs and a half are fitted by three pairs, one real pole too many
  const PoleFit fit = vector_fit(data, 3, options);
  EXPECT_LT(worst_error(data, fit), 1e-9);
  for (const Complex &pole : exact.poles)
  {
    double nearest = 1e9;
    for (const Complex &other : fit.poles)
      nearest = std::min(nearest, std::abs(other - pole));
    EXPECT_LT(nearest, 1e-5 * std::abs(pole));
  }
  EXPECT_NEAR(fit.direct[0], 1e-3, 1e-9);
}

TEST(Identification, UnstablePolesAreMirrored)
{
  PoleFit exact = known_fit();
  exact.poles[1] = {20, 400};
  const Spectra data = lines_of(exact, 500, 1.7);
  const PoleFit fit = vector_fit(data, 4);
  EXPECT_EQ(fit.n_unstable(), 0);
  EXPECT_EQ(fit.n_pairs(), 4);
}

TEST(Identification, LsceFindsKnownPoles)
{
  PoleFit exact = known_fit();
  exact.poles = {{-15, 2 * M_PI * 31}, {-20, 400}, {-9, 2500}};
  exact.direct = {0, 0};
  ImpulseResponses responses;
  responses.step = 1e-3;
  for (const auto &residues : exact.residues)
  {
    responses.values.emplace_back();
    for (unsigned int n = 0; n < 400; ++n)
    {
      double value = 0;
      for (unsigned int k = 0; k < 3; ++k)
        value += 2 * (residues[k] * std::exp(exact.poles[k] * (n * responses.step))).real();
      responses.values.back().push_back(value);
    }
  }
  const std::vector<Complex> poles = lsce_poles(responses, 3);
  ASSERT_EQ(poles.size(), 3);
  for (unsigned int k = 0; k < 3; ++k)
    EXPECT_LT(std::abs(poles[k] - exact.poles[k]), 1e-8 * std::abs(exact.poles[k]));
}

TEST(Identification, InverseTransformGivesTheImpulseResponse)
{
  PoleFit oscillator;
  oscillator.poles = {{-30, 2 * M_PI * 50}};
  oscillator.residues = {{{0, -0.5}}};
  oscillator.direct = {0};
  const ImpulseResponses responses = impulse_responses(lines_of(oscillator, 4001, 1));
  const ImpulseResponses closer = impulse_responses(lines_of(oscillator, 4001, 1), 40000);
  EXPECT_NEAR(closer.step, 2.5e-5, 1e-15);
  for (const unsigned int n : {40u, 400u, 1200u})
  {
    const double t = n * responses.step;
    EXPECT_NEAR(responses.values[0][n], closer.values[0][5 * n], 1e-4);
    EXPECT_NEAR(responses.values[0][n], 2 * (Complex(0, -0.5) * std::exp(oscillator.poles[0] * t)).real(),
                2e-3);
  }
}

TEST(Identification, RingByVectorFitting)
{
  for (const auto &[n_pairs, target] : {std::make_pair(16u, 1e-2), std::make_pair(25u, 1e-3)})
  {
    const PoleFit fit = vector_fit(ring(), n_pairs);
    EXPECT_LT(worst_error(ring(), fit), target);
    EXPECT_EQ(fit.n_unstable(), 0);
    EXPECT_EQ(fit.n_pairs(), n_pairs);
  }
}

TEST(Identification, RingWithNoise)
{
  const Spectra noisy = ring_data::with_noise(ring(), 0.01, 1);
  EXPECT_LT(worst_error(ring(), vector_fit(noisy, 16)), 1.5e-2);
  EXPECT_LT(worst_error(ring(), vector_fit(noisy, 25)), 7e-3);
}

TEST(Identification, RingWithZeroInitialValue)
{
  VectorFittingOptions options;
  options.rules.zero_initial_value = true;
  const PoleFit fit = vector_fit(ring(), 25, options), free = vector_fit(ring(), 25);
  EXPECT_LT(worst_error(ring(), fit), 2e-3);
  // imposed on the residues alone, poles as they were, it costs a factor of ten
  EXPECT_GT(worst_error(ring(), fit_residues(ring(), free.poles, options.rules)), 5e-3);
  for (unsigned int i = 0; i < 3; ++i)
  {
    double size = 0;
    for (const Complex &residue : fit.residues[i])
      size += std::abs(residue);
    EXPECT_LT(std::abs(fit.initial(i, 0)), 1e-10 * size);
  }
  EXPECT_GT(smallest_slope(fit), 0.05);
}

TEST(Identification, RingByLsce)
{
  const double E = worst_error(ring(), lsce_fit(ring(), 30));
  EXPECT_LT(E, 5e-3);
  ResidueRules rules;
  rules.real_amplitudes = true;
  const PoleFit real = lsce_fit(ring(), 30, rules);
  EXPECT_LT(worst_error(ring(), real), 6e-2);
  EXPECT_GT(worst_error(ring(), real), 5 * E);
  for (const Complex &residue : real.residues[1])
    EXPECT_EQ(residue.real(), 0);
}

TEST(Identification, ModelHasTheFitsReceptance)
{
  const PoleFit fit = vector_fit(ring(), 12);
  const IdentifiedModel whole = identified_model(fit, ring_map());
  EXPECT_LE(whole.model.n_poles(), 3 * fit.poles.size());
  const double w = 2 * M_PI * 333;
  const ComplexMatrix G = receptance(whole.model, w);
  for (unsigned int i = 0; i < 9; ++i)
    EXPECT_LT(std::abs(G(i / 3, i % 3) - fit.value(ring_map().entry[i], w)), 1e-12 * std::abs(G(0, 0)));
  const IdentifiedModel cut = identified_model(fit, ring_map(), 1e-2);
  EXPECT_LT(cut.model.n_poles(), whole.model.n_poles());
  EXPECT_GT(cut.truncation, 0);
  EXPECT_LE(cut.truncation, 1e-2);
}

TEST(Identification, OneStepComplianceByQuadrature)
{
  const BodyInContact model = identified_model(vector_fit(ring(), 8), ring_map()).model;
  // 5 Gauss points on each of 20 parts of the step
  const double x[] = {0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640, -0.9061798459386640},
               w[] = {128. / 225, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891,
                      0.2369268850561891};
  for (const double h : {2e-6, 1e-3})
  {
    double constant = 0, linear = 0;
    for (unsigned int part = 0; part < 20; ++part)
      for (unsigned int k = 0; k < 5; ++k)
      {
        const double s = h * (part + (1 + x[k]) / 2) / 20,
                     g = impulse_response(model, s)(0, 1) * w[k] * h / 40;
        constant += g;
        linear += g * (1 - s / h);
      }
    EXPECT_NEAR(one_step_compliance(model, step_weights(model, h, ForceInterpolation::constant))(0, 1) /
                    constant,
                1, 1e-9);
    EXPECT_NEAR(one_step_compliance(model, step_weights(model, h, ForceInterpolation::linear))(0, 1) / linear,
                1, 1e-9);
    EXPECT_NEAR(one_step_compliance(model, step_weights(model, h, ForceInterpolation::impulse))(0, 1) /
                    (h * impulse_response(model, h)(0, 1)),
                1, 1e-12);
  }
}

TEST(Identification, WellPosednessOfContact)
{
  DenseMatrix trace(1, 1), none(1, 1);
  trace(0, 0) = 1;
  const WellPosedness oscillator =
      well_posedness_of_contact(by_poles({{632.}, {0.02}, trace, {}, none, {}}), 1e-4);
  EXPECT_TRUE(oscillator.usable());
  EXPECT_TRUE(oscillator.impacts);

  // g(0+) = [[1, 2], [2, 1]] e^{-t}: every compliance is indefinite, whatever the fit's E
  PoleFit fit;
  fit.poles = {{-1., 0.}};
  fit.residues = {{0.5}, {1.}};
  fit.direct = {0, 0};
  BodyInContact model = identified_model(fit, {2, {0, 1, 1, 0}}).model;
  const WellPosedness refused = well_posedness_of_contact(model, 1e-4);
  EXPECT_FALSE(refused.usable());
  EXPECT_NEAR(refused.definiteness[0], -1. / 3, 1e-3);
  EXPECT_THROW(check_well_posedness(model, 1e-4, "tyre"), InputError);
  // the compliance of a tread outweighs it at small steps, h g(0+) < S
  model.residual(0, 0) = model.residual(1, 1) = 1e-3;
  EXPECT_TRUE(well_posedness_of_contact(model, 1e-4).usable());
  EXPECT_FALSE(well_posedness_of_contact(model, 1e-2).usable());
}

TEST(Identification, FitsOfTheRingAreRepairedForContact)
{
  FrequencyData data;
  data.labels = {"A_z", "B_z", "C_z"};
  for (const double omega : ring().omega)
    data.frequency.push_back(omega / (2 * M_PI));
  const EntryMap map = ring_map();
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = i; j < 3; ++j)
      data.entries.push_back({i, j, ring().values[map.entry[3 * i + j]]});
  IdentificationParameters parameters;
  // of the fits as they are, see DataPassivity for passive ones
  parameters.enforce_passivity = false;
  // doc/identification.md: 16 and 25 pairs can be used as they are, 20 and 30 are refused
  parameters.pairs = {16, 20, 25, 30};
  unsigned int n = 0;
  for (const Identification &one : identify(parameters, data, [&](const Identification &) { ++n; }))
  {
    EXPECT_TRUE(one.well_posedness.usable()) << one.well_posedness.reason();
    EXPECT_EQ(one.fit.n_unstable(), 0);
    EXPECT_LT(one.worst(), one.n_asked == 16 ? 1.5e-2 : one.n_asked == 20 ? 6e-3 : 3e-3);
    const bool refused = one.n_asked == 20 || one.n_asked == 30;
    EXPECT_EQ(one.repaired, refused) << one.n_asked;
    EXPECT_FALSE(one.repair_failed);
    EXPECT_EQ(one.errors_before_repair.empty(), !refused);
  }
  EXPECT_EQ(n, 4);
  parameters.repair = false;
  parameters.pairs = {20, 30};
  for (const Identification &one : identify(parameters, data, [](const Identification &) {}))
  {
    EXPECT_FALSE(one.well_posedness.usable()) << one.n_asked;
    EXPECT_FALSE(one.repaired);
  }
  parameters.repair = true;
  parameters.target_error = 0.05;
  const auto found = identify(parameters, data, [](const Identification &) {});
  ASSERT_EQ(found.size(), 1);
  EXPECT_LE(found.front().worst(), 0.05);
  EXPECT_TRUE(found.front().target_reached);
  EXPECT_LT(found.front().n_asked, 12);
  // out of reach, and too few relocations: said
  parameters.largest = 4;
  parameters.n_iterations = 2;
  const auto missed = identify(parameters, data, [](const Identification &) {});
  EXPECT_GT(missed.front().worst(), 0.05);
  EXPECT_FALSE(missed.front().target_reached);
  EXPECT_FALSE(missed.front().fit.converged);
}

// So many numbers follow anything: E of a fit is told from what it would leave of noise.
TEST(Identification, NoiseWithManyPairsFollowsNoData)
{
  FrequencyData silent, noise;
  silent.labels = {"A_z"};
  for (unsigned int k = 1; k <= 100; ++k)
    silent.frequency.push_back(k);
  silent.entries.push_back({0, 0, std::vector<Complex>(100, 1e-6)});
  noise = noisy(silent, 1, 3);
  for (Complex &value : noise.entries[0].values)
    value -= 1e-6;
  IdentificationParameters parameters;
  parameters.enforce_passivity = parameters.repair = false;
  parameters.contact_step = 0;
  parameters.pairs = {5, 49};
  const auto fits = identify(parameters, noise, [](const Identification &) {});
  // p = 4 n numbers of 200
  EXPECT_NEAR(fits[0].error_of_noise, std::sqrt(0.9), 1e-12);
  EXPECT_NEAR(fits[1].error_of_noise, std::sqrt(0.02), 1e-12);
  EXPECT_GT(fits[0].worst(), 0.5);
  EXPECT_LT(fits[1].worst(), 0.5);
  for (const Identification &one : fits)
    EXPECT_FALSE(one.follows_data()) << one.n_asked << ' ' << one.worst();
}
