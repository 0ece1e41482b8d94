#include <vibrocontact/base/number_text.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/receptances/data_passivity.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    constexpr double phase_tolerance = 0.01, noise_factor = 4, tolerated_share = 0.05;
    const std::array<std::string, 3> quantities = {{"receptances (displacement per force)",
                                                    "mobilities (velocity per force)",
                                                    "accelerances (acceleration per force)"}};

    double middle_value(std::vector<double> values)
    {
      std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
      return values[values.size() / 2];
    }

    /// Standard deviation of the noise of an entry per line [m/N].
    std::vector<double> noise_of(const FrequencyData &data, const FrequencyData::Entry &entry)
    {
      const int n = data.frequency.size(), reach = 10;
      std::vector<Complex> raw(n);
      for (int l = 0; l < n; ++l)
        raw[l] = entry.values[l] * std::pow(data.frequency[l], int(entry.derivative));
      std::vector<double> difference(n), noise(n);
      for (int l = 1; l + 1 < n; ++l)
        difference[l] = std::abs(raw[l - 1] - 2. * raw[l] + raw[l + 1]);
      for (int l = 0; l < n; ++l)
      {
        const int begin = std::clamp(l - reach, 1, std::max(1, n - 2 * reach - 2)),
                  end = std::min(n - 1, begin + 2 * reach + 1);
        // the differences have six times the variance, and a median of sqrt(ln 2) of their rms
        const double deviation = middle_value({difference.begin() + begin, difference.begin() + end}) /
                                 std::sqrt(6 * std::log(2.));
        const double size = std::pow(data.frequency[l], int(entry.derivative));
        noise[l] = size > 0 ? deviation / size : 0;
      }
      return noise;
    }

    /// The lines above 0 Hz as the test needs them.
    class TestedLines
    {
    public:
      TestedLines(const FrequencyData &data, const bool rolling) : data(data), rolling(rolling)
      {
        const unsigned int n = data.labels.size();
        std::vector<std::vector<double>> noises;
        for (const FrequencyData::Entry &entry : data.entries)
          noises.push_back(noise_of(data, entry));
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
          {
            const FrequencyData::Entry *entry = data.find(i, j);
            entry = entry ? entry : data.find(j, i);
            entries.push_back(entry);
            noise.push_back(noises[entry - data.entries.data()]);
          }
        for (std::size_t l = 0; l < data.frequency.size(); ++l)
          if (data.frequency[l] > 0)
            lines.push_back(l);
      }

      /// Largest gain of a line beyond what is tolerated, over |G| [-]: positive if a force gains energy.
      double excess(const std::size_t l, const Complex factor) const
      {
        const unsigned int n = data.labels.size();
        double largest = -1;
        if (rolling || n == 1)
        {
          for (unsigned int i = 0; i < n; ++i)
          {
            const Complex value = factor * entries[i * n + i]->values[l];
            const double tolerated =
                phase_tolerance * std::abs(value) + noise_factor * std::abs(factor) * noise[i * n + i][l];
            if (std::abs(value) > 0)
              largest = std::max(largest, (value.imag() - tolerated) / std::abs(value));
          }
          return largest;
        }
        DenseMatrix imaginary(n, n), vectors;
        double size = 0, noises = 0;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
          {
            const Complex value = factor * entries[i * n + j]->values[l];
            imaginary(i, j) = value.imag();
            size += std::norm(value);
            noises += std::norm(factor * noise[i * n + j][l]);
          }
        size = std::sqrt(size);
        const double gain = symmetric_eigenvalues(imaginary, vectors).back();
        return size > 0 ? (gain - noise_factor * std::sqrt(noises)) / size - phase_tolerance : 0;
      }

      /// @param factor by which receptances are multiplied at omega; @param stride 1: all lines
      DataJudgement judge(const std::function<Complex(double)> &factor, const std::size_t stride = 1) const
      {
        DataJudgement result;
        double worst = 0, n = 0;
        for (std::size_t k = 0; k < lines.size(); k += stride, ++n)
          if (const double here = excess(lines[k], factor(2 * M_PI * data.frequency[lines[k]])); here > 0)
          {
            ++result.gaining;
            if (here > worst)
            {
              worst = here;
              result.frequency = data.frequency[lines[k]];
            }
          }
        result.gaining /= std::max(n, 1.);
        return result;
      }

      /// Slope of log |value of the file| over log frequency on the lowest tenth of the lines.
      double slope() const
      {
        const unsigned int n = data.labels.size();
        const std::size_t count = std::min(std::max<std::size_t>(lines.size() / 10, 3), lines.size());
        double s = 0, x = 0, y = 0, xx = 0, xy = 0;
        for (std::size_t k = 0; k < count; ++k)
          for (unsigned int i = 0; i < n; ++i)
            if (const double size = std::abs(entries[i * n + i]->values[lines[k]]); size > 0)
            {
              const double a = std::log(data.frequency[lines[k]]),
                           b = std::log(size) + entries[i * n + i]->derivative * a;
              s += 1;
              x += a;
              y += b;
              xx += a * a;
              xy += a * b;
            }
        return (s * xy - x * y) / std::max(s * xx - x * x, 1e-300);
      }

      std::size_t n_lines() const { return lines.size(); }

    private:
      const FrequencyData &data;
      const bool rolling;
      /// per pair of points, row by row
      std::vector<const FrequencyData::Entry *> entries;
      std::vector<std::vector<double>> noise;
      std::vector<std::size_t> lines;
    };

    /// What else the values may be; empty if nothing puts the lines in order. A spring or a free mass at the low end of
    /// the band tells quantities apart that turn the phase equally.
    std::string other_quantity(const TestedLines &lines, const FrequencyData &data)
    {
      const int labelled = data.entries.front().derivative;
      for (const FrequencyData::Entry &entry : data.entries)
        if (int(entry.derivative) != labelled)
          return "";
      const double slope = lines.slope();
      std::vector<std::string> possible, plausible;
      for (const int derivative : {0, 1, 2})
      {
        const bool same = derivative == labelled;
        const auto factor = [&](const double omega)
        { return same ? Complex(-1) : std::pow(Complex(0, omega), labelled - derivative); };
        if (lines.judge(factor).gaining > tolerated_share)
          continue;
        possible.push_back(same ? "are for e^{-j omega t} (take their conjugates) or have the wrong sign"
                                : "are " + quantities[derivative]);
        if (std::abs(slope - derivative) < 0.5 || std::abs(slope - derivative + 2) < 0.5)
          plausible.push_back(possible.back());
      }
      std::string text;
      for (const std::string &one : plausible.empty() ? possible : plausible)
        text += (text.empty() ? "probably they " : ", or ") + one;
      return text.empty() ? text : text + ": mend their unit, data type or sign";
    }

    /// The delay whose removal leaves the fewest gains: the middle of what does; 0 if none does.
    double delay_by_sign(const TestedLines &lines, const double highest)
    {
      const std::size_t stride = (lines.n_lines() + 199) / 200;
      std::vector<double> delays, shares;
      for (int k = -80; k <= 80; ++k)
      {
        delays.push_back(k / (40 * highest));
        shares.push_back(
            lines.judge([&](const double omega) { return std::polar(1., omega * delays.back()); }, stride)
                .gaining);
      }
      const std::size_t best = std::min_element(shares.begin(), shares.end()) - shares.begin();
      if (shares[best] > tolerated_share)
        return 0;
      std::size_t end = best;
      while (end + 1 < shares.size() && shares[end + 1] <= shares[best])
        ++end;
      return (delays[best] + delays[end]) / 2;
    }

    std::string three_digits(const double value)
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.3g", value);
      return text;
    }
  } // namespace

  bool DataJudgement::is_late(const double highest_frequency) const
  {
    /// phase at the highest line [rad]
    constexpr double least_phase = 0.06;
    /// error that a delay leaves of a fit without it, over that phase: exact fits differ by rounding
    constexpr double least_error = 0.02;
    if (!delay)
      return false;
    const double phase = std::abs(delay->delay) * 2 * M_PI * highest_frequency;
    return delay->error < 0.05 && delay->error_without > 1.5 * delay->error && phase > least_phase &&
           delay->error_without > least_error * std::min(phase, 1.);
  }

  DataJudgement judge_data(const FrequencyData &data, const bool rolling, const double removed)
  {
    const TestedLines lines(data, rolling);
    const double highest = data.frequency.back();
    const auto without = [&](const double delay)
    { return lines.judge([&](const double omega) { return std::polar(1., omega * delay); }).gaining; };
    DataJudgement result = lines.judge([](double) { return Complex(1); });
    if (!rolling)
    {
      std::vector<double> omega;
      std::vector<Complex> driving(data.frequency.size());
      for (const double frequency : data.frequency)
        omega.push_back(2 * M_PI * frequency);
      for (const FrequencyData::Entry &entry : data.entries)
        if (entry.response == entry.reference)
          for (std::size_t l = 0; l < omega.size(); ++l)
            driving[l] += entry.values[l];
      result.delay = estimate_delay(omega, driving);
    }
    const auto proposal = [&](const double delay)
    { return "set Identification/Delay = " + three_digits(removed + delay) + " to remove it"; };
    const std::string accept = "set Identification/Passive data = false to take them as they are";
    if (result.gaining <= tolerated_share)
    {
      if (result.is_late(highest))
        result.complaint =
            "lag behind the forces by " + three_digits(result.delay->delay) + " s: real modes fit them " +
            three_digits(result.delay->error_without / result.delay->error) +
            " times better without this delay: " + proposal(result.delay->delay) + ", or " + accept;
      return result;
    }
    result.complaint = "give energy to the force on " + percent_text(result.gaining, 1) +
                       " of their lines (most at " + number_text(result.frequency) + " Hz), as no body " +
                       (rolling ? "does at a driving point: " : "at rest does: ");
    const std::string quantity = other_quantity(lines, data);
    if (!quantity.empty())
    {
      result.complaint += quantity;
      return result;
    }
    double delay = result.is_late(highest) ? result.delay->delay : 0;
    if (delay == 0 || without(delay) > tolerated_share)
      delay = delay_by_sign(lines, highest);
    if (delay != 0)
      result.complaint += "a delay of " + three_digits(delay) + " s would explain it (" +
                          percent_text(without(delay), 1) + " without): " + proposal(delay) +
                          ", mend the measurement";
    else
      result.complaint += "neither a delay nor another quantity explains it: mend the measurement, choose a "
                          "band by Identification/Lower frequency and Upper frequency";
    result.complaint += " or " + accept;
    return result;
  }
} // namespace vibrocontact
