#include <vibrocontact/analyses/frequency_response/response_extrema.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  std::pair<double, double> extremum_between(const std::array<double, 3> &frequency,
                                             const std::array<Complex, 3> &value, const bool is_maximum)
  {
    // of a pole or zero, over its distance: below it nothing damps
    constexpr double least_damping = 1e-6;
    const double middle = frequency[1], u = frequency[0] - middle, v = frequency[2] - middle;
    const Complex a = value[1], slope_u = (value[0] - a) / u, slope_v = (value[2] - a) / v,
                  d = (slope_u - slope_v) / (value[2] - value[0]), b = slope_u + value[0] * d;
    std::pair<double, double> best = {middle, std::abs(a)};
    const Complex root = is_maximum ? -1. / d : -a / b;
    if (!(std::abs(root.imag()) > least_damping * (middle + std::abs(root.real()))))
      return best;
    // |a + b x|^2 / |1 + d x|^2 = (p0 + p1 x + p2 x^2) / (q0 + q1 x + q2 x^2) turns where
    const double p0 = std::norm(a), p1 = 2 * (std::conj(a) * b).real(), p2 = std::norm(b), q0 = 1,
                 q1 = 2 * d.real(), q2 = std::norm(d);
    const double A = p2 * q1 - p1 * q2, B = 2 * (p2 * q0 - p0 * q2), C = p1 * q0 - p0 * q1;
    const double discriminant = std::sqrt(std::max(0., B * B - 4 * A * C)),
                 q = -(B + std::copysign(discriminant, B)) / 2;
    for (const double x : {q / A, C / q})
      if (x > u && x < v)
      {
        const double magnitude = std::abs((a + b * x) / (1. + d * x));
        if (is_maximum ? magnitude > best.second : magnitude < best.second)
          best = {middle + x, magnitude};
      }
    return best;
  }

  bool ResponseExtremum::is_resolved(const double accuracy) const
  {
    return std::abs(std::log(magnitude / computed)) <= accuracy;
  }

  namespace
  {
    /// Those of one driving point.
    void add_extrema_of(const FrequencyResponseParameters &parameters, const ResponseVariant &variant,
                        const std::string &point, const unsigned int index,
                        std::vector<ResponseExtremum> &found)
    {
      const double share = std::log(1.2);
      // without loss a resonance is infinite
      std::vector<Complex> H;
      std::vector<double> f, y;
      for (unsigned int k = 0; k < variant.frequency.size(); ++k)
      {
        const Complex value = parameters.shown(variant.response[k][index], variant.frequency[k]);
        const double magnitude = std::log(std::abs(value));
        if (!std::isfinite(magnitude))
          continue;
        f.push_back(variant.frequency[k]);
        H.push_back(value);
        y.push_back(magnitude);
      }
      // the best so far on the way up or down is an extremum once the curve has turned by `share`
      unsigned int high = 0, low = 0;
      bool up = true;
      const auto report = [&](const unsigned int k, const bool is_maximum)
      {
        if (k == 0)
          return;
        const auto [frequency, magnitude] =
            extremum_between({{f[k - 1], f[k], f[k + 1]}}, {{H[k - 1], H[k], H[k + 1]}}, is_maximum);
        found.push_back({point, is_maximum, frequency, magnitude, f[k], std::abs(H[k])});
      };
      for (unsigned int k = 0; k < y.size(); ++k)
      {
        high = y[k] > y[high] ? k : high;
        low = y[k] < y[low] ? k : low;
        if (up && y[k] < y[high] - share)
        {
          report(high, true);
          up = false;
          low = k;
        }
        else if (!up && y[k] > y[low] + share)
        {
          report(low, false);
          up = true;
          high = k;
        }
      }
    }
  } // namespace

  std::vector<ResponseExtremum> response_extrema(const FrequencyResponseParameters &parameters,
                                                 const ResponseVariant &variant)
  {
    std::vector<ResponseExtremum> found;
    for_each_driving_point(parameters, [&](const std::string &point, const unsigned int index)
                           { add_extrema_of(parameters, variant, point, index, found); });
    return found;
  }

  void insert(const ResponseVariant &more, ResponseVariant &variant)
  {
    for (std::size_t k = 0; k < more.frequency.size(); ++k)
    {
      const auto place =
          std::upper_bound(variant.frequency.begin(), variant.frequency.end(), more.frequency[k]);
      variant.response.insert(variant.response.begin() + (place - variant.frequency.begin()),
                              more.response[k]);
      variant.frequency.insert(place, more.frequency[k]);
    }
  }

  ResponseVariant with_resolved_extrema(const FrequencyResponseParameters &parameters,
                                        ResponseVariant variant,
                                        const std::vector<double> &natural_frequencies, const double accuracy,
                                        const ResponseSolver &solve)
  {
    constexpr unsigned int most_rounds = 6;
    constexpr double same_frequency = 1e-9;
    std::vector<double> wanted;
    const auto want = [&](const double frequency)
    {
      const std::vector<double> &known = variant.frequency;
      const auto is_there = [&](const double other)
      { return std::abs(other - frequency) <= same_frequency * frequency; };
      if (frequency > known.front() && frequency < known.back() &&
          std::none_of(known.begin(), known.end(), is_there) &&
          std::none_of(wanted.begin(), wanted.end(), is_there))
        wanted.push_back(frequency);
    };
    const auto take = [&]
    {
      std::sort(wanted.begin(), wanted.end());
      if (!wanted.empty())
        insert(solve(wanted), variant);
      return !std::exchange(wanted, {}).empty();
    };
    for (const double frequency : natural_frequencies)
      want(frequency);
    take();
    for (unsigned int round = 0; round < most_rounds; ++round)
    {
      for (const ResponseExtremum &one : response_extrema(parameters, variant))
        if (!one.is_resolved(accuracy))
          want(one.frequency);
      if (!take())
        break;
    }
    return variant;
  }
} // namespace vibrocontact
