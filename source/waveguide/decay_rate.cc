#include <vibrocontact/numerics/third_octaves.h>
#include <vibrocontact/waveguide/decay_rate.h>

#include <algorithm>

namespace vibrocontact
{
  double track_decay_rate(const std::vector<double> &places, const std::vector<double> &squares)
  {
    const unsigned int n = places.size();
    double sum = 0;
    for (unsigned int j = 0; j < n; ++j)
    {
      const double before = j > 0 ? (places[j] - places[j - 1]) / 2 : 0,
                   after = j + 1 < n ? (places[j + 1] - places[j]) / 2 : before;
      sum += squares[j] / squares[0] * (before + after);
    }
    return 4.343 / sum;
  }

  const std::vector<unsigned int> &decay_rate_grid()
  {
    static const std::vector<unsigned int> grid = {0,  1,  2,  3,   4,   5,   6,   7,   8,  10,
                                                   12, 14, 16, 20,  24,  28,  32,  40,  48, 56,
                                                   64, 80, 96, 120, 144, 168, 192, 216, 264};
    return grid;
  }

  double decay_rate_at_quarters(const std::vector<double> &squares, const double spacing)
  {
    std::vector<double> places;
    for (unsigned int j = 0; j < squares.size(); ++j)
      places.push_back(j * spacing / 4);
    return track_decay_rate(places, squares);
  }

  double decay_rate_on_grid(const std::vector<double> &squares, const double spacing)
  {
    std::vector<double> places, kept;
    for (const unsigned int j : decay_rate_grid())
      if (j < squares.size())
      {
        places.push_back(j * spacing / 4);
        kept.push_back(squares[j]);
      }
    return track_decay_rate(places, kept);
  }

  namespace
  {
    /// int over a band of what is given at some frequencies, straight lines between them
    std::vector<double> over_band(const DecayingResponses &responses, const unsigned int direction,
                                  const double lower, const double upper)
    {
      std::vector<double> result(responses.begin()->second[direction].size());
      for (auto left = responses.begin(), right = std::next(left); right != responses.end(); ++left, ++right)
      {
        const double a = std::max(lower, left->first), b = std::min(upper, right->first);
        if (!(b > a))
          continue;
        // the middle of a straight line is its mean
        const double t = ((a + b) / 2 - left->first) / (right->first - left->first);
        for (unsigned int j = 0; j < result.size(); ++j)
          result[j] += (b - a) * ((1 - t) * left->second[direction][j] + t * right->second[direction][j]);
      }
      return result;
    }
  } // namespace

  std::vector<BandDecayRates> band_decay_rates(const DecayingResponses &responses, const double spacing)
  {
    std::vector<BandDecayRates> result;
    if (responses.size() < 2)
      return result;
    for (const ThirdOctave &band : third_octaves_within(responses.begin()->first, responses.rbegin()->first))
    {
      BandDecayRates rates;
      rates.nominal = band.nominal;
      for (const auto &one : responses)
        rates.n_frequencies += one.first >= band.lower && one.first <= band.upper;
      if (rates.n_frequencies == 0)
        continue;
      for (unsigned int d = 0; d < 2; ++d)
        rates.rates[d] = decay_rate_on_grid(over_band(responses, d, band.lower, band.upper), spacing);
      result.push_back(rates);
    }
    return result;
  }
} // namespace vibrocontact
