#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/receptances/frequency_data.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  const FrequencyData::Entry *FrequencyData::find(const unsigned int response,
                                                  const unsigned int reference) const
  {
    for (const Entry &entry : entries)
      if (entry.response == response && entry.reference == reference)
        return &entry;
    return nullptr;
  }

  unsigned int FrequencyData::label_index(const std::string &label)
  {
    const auto found = std::find(labels.begin(), labels.end(), label);
    if (found != labels.end())
      return found - labels.begin();
    labels.push_back(label);
    return labels.size() - 1;
  }

  namespace
  {
    /// share of the steps that agree with their median to 1e-4, and the first that is larger by half
    struct Regularity
    {
      double share = 0, median = 0;
      std::size_t gap = 0;
    };

    Regularity regularity(const std::vector<double> &steps)
    {
      Regularity result;
      std::vector<double> sorted = steps;
      std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
      result.median = sorted[sorted.size() / 2];
      std::size_t equal = 0;
      for (std::size_t i = 0; i < steps.size(); ++i)
      {
        equal += std::abs(steps[i] - result.median) <= 1e-4 * std::abs(result.median);
        if (result.gap == 0 && steps[i] > 1.5 * result.median)
          result.gap = i + 1;
      }
      result.share = double(equal) / steps.size();
      return result;
    }

    std::string at_line(const std::string &file_name, const std::vector<unsigned int> &lines,
                        const std::size_t row)
    {
      return "The data \"" + file_name + "\"" +
             (row < lines.size() ? ", line " + std::to_string(lines[row]) + "," : "");
    }
  } // namespace

  void check_axis(const std::string &file_name, const std::vector<double> &axis, const std::string &unit,
                  const std::vector<unsigned int> &lines)
  {
    const std::string what = unit == "Hz" ? "frequencies" : "times";
    if (axis.size() < 3)
      throw InputError("The data \"" + file_name + "\" have " + std::to_string(axis.size()) + " " + what +
                       ": give at least 3.");
    for (std::size_t l = 0; l < axis.size(); ++l)
    {
      if (!std::isfinite(axis[l]) || axis[l] < 0)
        throw InputError(at_line(file_name, lines, l) + " have " + number_text(axis[l]) + " " + unit + ": " +
                         what + " are not negative.");
      if (l > 0 && !(axis[l] > axis[l - 1]))
        throw InputError(at_line(file_name, lines, l) + " have " + number_text(axis[l]) + " " + unit +
                         " after " + number_text(axis[l - 1]) + " " + unit + ": sort the " + what +
                         ", each once.");
    }
    std::vector<double> steps, logarithms;
    for (std::size_t l = 1; l < axis.size(); ++l)
    {
      steps.push_back(axis[l] - axis[l - 1]);
      if (axis[l - 1] > 0)
        logarithms.push_back(std::log(axis[l] / axis[l - 1]));
    }
    const Regularity linear = regularity(steps), geometric = regularity(logarithms);
    const Regularity &better = linear.share >= geometric.share ? linear : geometric;
    if (better.share < 0.8 || better.gap == 0)
      return;
    const std::size_t row = better.gap + (&better == &geometric ? steps.size() - logarithms.size() : 0);
    throw InputError(at_line(file_name, lines, row) + " have a gap between " + number_text(axis[row - 1]) +
                     " and " + number_text(axis[row]) + " " + unit +
                     ", while their other steps are equal: add what is missing.");
  }

  double equal_time_step(const std::string &source, const std::vector<double> &time, const double rounding,
                         const std::vector<unsigned int> &lines)
  {
    const double step = time.back() / (time.size() - 1);
    for (std::size_t i = 0; i < time.size(); ++i)
      if (std::abs(time[i] - i * step) > 1e-4 * step + rounding * time.back())
        throw InputError(source + (lines.empty() ? "" : ", line " + std::to_string(lines[i]) + ",") +
                         " leaves at " + number_text(time[i]) +
                         " s the equal steps from t = 0 on that an impulse response needs: sample it so.");
    return step;
  }

  void integrate_in_frequency(FrequencyData &data, const unsigned int entry, const unsigned int power)
  {
    if (power == 0)
      return;
    if (data.frequency.front() == 0)
      throw InputError(
          "The data \"" + data.file_name +
          "\" give a velocity or acceleration per force at 0 Hz, which does not tell the displacement "
          "there: leave that frequency out, or set Identification/Lower frequency above 0.");
    for (std::size_t l = 0; l < data.frequency.size(); ++l)
      data.entries[entry].values[l] /= std::pow(Complex(0, 2 * M_PI * data.frequency[l]), power);
  }

  std::string entry_name(const FrequencyData &data, const unsigned int entry)
  {
    return data.labels[data.entries[entry].response] + "_" + data.labels[data.entries[entry].reference];
  }
} // namespace vibrocontact
