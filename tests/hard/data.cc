// Measured data that are noise, conjugated, negated, mislabelled or of poles on the axis: told, refused or followed.

#include "../unit/noisy_data.h"
#include "../unit/ring_data.h"
#include "report.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/receptance_fit.h>
#include <vibrocontact/receptances/data_passivity.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace vibrocontact;
using Complex = std::complex<double>;

namespace
{
  /// Receptances between three points of a ring at rest, 1 to 1000 Hz.
  FrequencyData ring(const bool both_ways = false)
  {
    FrequencyData data;
    data.labels = {"A_z", "B_z", "C_z"};
    for (double f = 2; f <= 1000; f += 2)
      data.frequency.push_back(f);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = both_ways ? 0 : i; j < 3; ++j)
      {
        FrequencyData::Entry entry;
        entry.response = i;
        entry.reference = j;
        for (const double f : data.frequency)
          entry.values.push_back(
              ring_data::receptance(2 * M_PI * f, (double(j) - double(i)) * M_PI / 100, 100));
        data.entries.push_back(entry);
      }
    return data;
  }

  void turn(FrequencyData::Entry &entry, const std::function<Complex(Complex)> &change)
  {
    for (Complex &value : entry.values)
      value = change(value);
  }

  std::string complaint(const FrequencyData &data)
  {
    return judge_data(data, false, 0).complaint;
  }
} // namespace

// Noise of a third of the rms is no reason to refuse.
TEST(HardData, NoiseOfAThird)
{
  for (const double share : {0.01, 0.1, 0.3})
    EXPECT_EQ(complaint(noisy(ring(), share, 5)), "") << share;
}

// Conjugates are told under noise as without: any driving point gives energy then.
TEST(HardData, ConjugatedAndNegatedUnderNoise)
{
  for (const double share : {0.01, 0.1})
    for (const bool conjugated : {false, true})
    {
      FrequencyData data = noisy(ring(), share, 5);
      for (FrequencyData::Entry &entry : data.entries)
        turn(entry, [&](const Complex value) { return conjugated ? std::conj(value) : -value; });
      EXPECT_NE(complaint(data).find("give energy to the force"), std::string::npos) << share << conjugated;
      EXPECT_NE(complaint(data).find("wrong sign"), std::string::npos) << share << complaint(data);
    }
}

// One entry alone of the wrong sign, or conjugated, on or beside the diagonal.
TEST(HardData, OneEntryOfAnotherSign)
{
  double least = 1;
  for (unsigned int k = 0; k < 6; k += 2)
    for (const bool conjugated : {false, true})
    {
      FrequencyData data = ring();
      turn(data.entries[k], [&](const Complex value) { return conjugated ? std::conj(value) : -value; });
      const DataJudgement judgement = judge_data(data, false, 0);
      EXPECT_NE(judgement.complaint.find("give energy to the force"), std::string::npos) << k;
      least = std::min(least, judgement.gaining);
    }
  EXPECT_GT(least, 0.5);
  report("least share of lines", least);
}

// A driving point and a transfer function under each other's names.
TEST(HardData, MislabelledPoints)
{
  FrequencyData data = ring();
  std::swap(data.entries[0].values, data.entries[2].values); // A A and A C
  const DataJudgement judgement = judge_data(data, false, 0);
  EXPECT_NE(judgement.complaint.find("give energy to the force"), std::string::npos);
  report("share of lines", judgement.gaining);
}

// The poles of a body of two modes from its receptances: undamped, on the axis; both the same; 1e-6 of their frequency apart;
// hardly damped.
TEST(HardData, PolesOnTheAxisAndDoublePoles)
{
  struct Modes
  {
    const char *name;
    double omega[2], damping;
  };
  for (const Modes &modes :
       {Modes{"undamped", {600, 1500}, 0}, Modes{"double", {600, 600}, 1e-3},
        Modes{"1e-6 apart", {600, 600 * (1 + 1e-6)}, 1e-3}, Modes{"damped by 1e-10", {600, 1500}, 1e-10}})
  {
    ReceptanceLines lines;
    DenseMatrix at_rest(2, 2), at_once(2, 2);
    const double shapes[2][2] = {{1, 0.4}, {-0.3, 1}};
    const auto sum = [&](const unsigned int i, const double omega)
    {
      Complex G = 0;
      for (unsigned int m = 0; m < 2; ++m)
        G += shapes[m][i / 2] * shapes[m][i % 2] /
             Complex(modes.omega[m] * modes.omega[m] - omega * omega,
                     2 * modes.damping * modes.omega[m] * omega);
      return G;
    };
    for (unsigned int i = 0; i < 4; ++i)
      at_rest(i / 2, i % 2) = sum(i, 0).real();
    at_once(0, 0) = at_once(1, 1) = 1e-16;
    for (unsigned int k = 0; k < 80; ++k)
    {
      lines.omega.push_back(100 * std::pow(100., k / 79.));
      ComplexMatrix G(2, 2);
      for (unsigned int i = 0; i < 4; ++i)
        G(i / 2, i % 2) = sum(i, lines.omega.back());
      lines.values.push_back(G);
    }
    const ReceptanceFit fit = fit_receptance(lines, at_rest, at_once, 2);
    EXPECT_LT(fit.worst_error(), 1e-7) << modes.name;
    for (unsigned int m = 0; m < 2; ++m)
    {
      double nearest = 1e300;
      for (const Complex &pole : fit.body.poles)
      {
        EXPECT_LT(pole.real(), 0) << modes.name;
        nearest = std::min(
            nearest,
            std::abs(Complex(pole.real(), std::abs(pole.imag())) -
                     modes.omega[m] * Complex(-modes.damping, std::sqrt(1 - modes.damping * modes.damping))));
      }
      EXPECT_LT(nearest, 1e-6 * modes.omega[m]) << modes.name;
    }
    report(modes.name, fit.worst_error());
  }
}
