// Maxima and minima of a frequency response between the frequencies that it was computed at: those of sums of modes, which are
// known.

#include <vibrocontact/analyses/frequency_response/response_extrema.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

using namespace vibrocontact;
using Complex = std::complex<double>;

namespace
{
  constexpr double loss = 2e-4;
  const std::vector<double> own_frequencies = {432.4, 1297.2, 2162., 3027., 3890.};

  Complex receptance(const double f)
  {
    Complex sum = 0;
    for (const double own : own_frequencies)
      sum += 1. / (own * own * Complex(1, loss) - f * f);
    return sum;
  }

  ResponseVariant solve(const std::vector<double> &frequency)
  {
    ResponseVariant variant;
    variant.frequency = frequency;
    for (const double f : frequency)
      variant.response.push_back({receptance(f)});
    return variant;
  }

  FrequencyResponseParameters receptances_at(const unsigned int count)
  {
    FrequencyResponseParameters parameters;
    parameters.quantity = "receptance";
    parameters.count = count;
    return parameters;
  }
} // namespace

TEST(ResponseExtrema, OfOneModeAreExactHoweverFarTheFrequenciesLie)
{
  const Complex pole(1000, 0.1), rest(2e-7, 1e-8);
  const auto H = [&](const double f) { return 1e-6 / (pole - f) + rest; };
  const auto [frequency, magnitude] =
      extremum_between({{970, 1004, 1050}}, {{H(970), H(1004), H(1050)}}, true);
  double largest = 0, at = 0;
  for (double f = 999; f < 1001; f += 1e-5)
    if (std::abs(H(f)) > largest)
    {
      largest = std::abs(H(f));
      at = f;
    }
  EXPECT_NEAR(frequency, at, 1e-4);
  EXPECT_NEAR(magnitude / largest, 1, 1e-8);
}

TEST(ResponseExtrema, OfWhatNothingDampsAreTheFrequenciesComputed)
{
  const auto H = [](const double f) { return Complex(1 / (1000. * 1000 - f * f)); };
  const auto [frequency, magnitude] = extremum_between({{990, 999, 1010}}, {{H(990), H(999), H(1010)}}, true);
  EXPECT_EQ(frequency, 999);
  EXPECT_EQ(magnitude, std::abs(H(999)));
}

TEST(ResponseExtrema, WithoutLossAreFinite)
{
  const auto lossless = [](const std::vector<double> &frequency)
  {
    ResponseVariant variant;
    variant.frequency = frequency;
    for (const double f : frequency)
      variant.response.push_back({Complex(1 / (1000. * 1000 - f * f), 0)});
    return variant;
  };
  const FrequencyResponseParameters parameters = receptances_at(50);
  const std::vector<ResponseExtremum> found =
      response_extrema(parameters, with_resolved_extrema(parameters, lossless(parameters.frequencies()),
                                                         {1000}, 2e-3, lossless));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(std::isfinite(found[0].magnitude));
  EXPECT_EQ(found[0].magnitude, found[0].computed);
}

TEST(ResponseExtrema, AreThoseOfTheModesBetweenFewFrequencies)
{
  for (const unsigned int count : {20, 50, 500})
  {
    const FrequencyResponseParameters parameters = receptances_at(count);
    const std::vector<ResponseExtremum> found =
        response_extrema(parameters, with_resolved_extrema(parameters, solve(parameters.frequencies()),
                                                           own_frequencies, 2e-3, solve));
    std::vector<ResponseExtremum> maxima;
    std::copy_if(found.begin(), found.end(), std::back_inserter(maxima),
                 [](const ResponseExtremum &one) { return one.is_maximum; });
    ASSERT_EQ(maxima.size(), own_frequencies.size()) << count;
    for (std::size_t k = 0; k < maxima.size(); ++k)
    {
      const double own = own_frequencies[k];
      // the other modes shift a maximum by 1e-7
      EXPECT_NEAR(maxima[k].frequency / own, 1, 1e-6) << count;
      EXPECT_NEAR(maxima[k].magnitude / std::abs(receptance(own)), 1, 2e-4) << count;
    }
    EXPECT_EQ(found.size(), 2 * maxima.size() - 1) << count;
  }
}
