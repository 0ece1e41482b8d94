// A damped oscillator as poles: receptance and impulse response against their closed forms.
#include <vibrocontact/reduction/pole_model.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  PoleModel oscillator(const double zeta)
  {
    DenseMatrix trace(1, 1), residual(1);
    trace(0, 0) = 0.5; // mass 4 kg
    residual(0, 0) = 1e-6;
    return pole_model({300.}, {zeta}, trace, {}, residual, {"bounce"});
  }
} // namespace

TEST(PoleModel, ReceptanceOfAnOscillator)
{
  for (const double zeta : {0., 0.02, 0.7, 1., 1.5})
  {
    const PoleModel model = oscillator(zeta);
    for (const double w : {10., 250., 1000.})
    {
      const std::complex<double> exact =
          0.25 / (std::complex<double>(300. * 300. - w * w, 2 * zeta * 300. * w)) + 1e-6;
      EXPECT_NEAR(std::abs(receptance(model, w)(0, 0) / exact - 1.), 0, zeta == 1. ? 1e-6 : 1e-12) << zeta;
    }
  }
}

TEST(PoleModel, ImpulseResponseOfAnOscillator)
{
  const double wd = 300. * std::sqrt(1 - 0.02 * 0.02), t = 0.013;
  EXPECT_NEAR(impulse_response(oscillator(0.02), t)(0, 0) * wd / 0.25 / std::exp(-6. * t), std::sin(wd * t),
              1e-12);
  EXPECT_NEAR(initial_derivative(oscillator(0.02), 0)(0, 0), 0, 1e-15);
  EXPECT_NEAR(initial_derivative(oscillator(0.02), 1)(0, 0), 0.25, 1e-12);
  EXPECT_NEAR(initial_derivative(oscillator(1.5), 1)(0, 0), 0.25, 1e-12);
}
