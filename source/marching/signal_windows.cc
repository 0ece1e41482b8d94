#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/marching/signal_windows.h>
#include <vibrocontact/numerics/spectrum.h>
#include <vibrocontact/output/verdict.h>

#include <tuple>

namespace vibrocontact
{
  void SignalWindows::declare_parameters(dealii::ParameterHandler &prm, const std::string &latest)
  {
    using dealii::Patterns::Double;
    prm.add_parameter("Spectrum duration", spectrum_duration,
                      "The last part of the run that the spectrum and the measures of the limit cycle take; "
                      "0: the second half. Units: s.",
                      Double(0, 1e9));
    prm.add_parameter("Growth begin", growth_begin, "Begin of the window of the growth rates. Units: s.",
                      Double(0, 1e9));
    prm.add_parameter("Growth end", growth_end,
                      "End of the window of the growth rates; 0: " + latest + ". Units: s.", Double(0, 1e9));
  }

  void SignalWindows::check(const std::string &section, const double step, const double end_time) const
  {
    if (spectrum_duration > 0 && spectrum_duration < least_samples_of_spectrum * step)
      throw InputError(section + "/Signals/Spectrum duration is " + number_text(spectrum_duration) +
                       " s, but a spectrum takes " + std::to_string(least_samples_of_spectrum) +
                       " steps at least, " + number_text(least_samples_of_spectrum * step) +
                       " s: make it longer, or 0 for the second half of the run.");
    if (growth_begin >= end_time)
      throw InputError(section + "/Signals/Growth begin is " + number_text(growth_begin) + " s, but " +
                       section + "/End time is " + number_text(end_time) + " s: let it be earlier.");
    if (growth_end > 0 && growth_end <= growth_begin)
      throw InputError(section + "/Signals: Growth end has to be later than Growth begin, or 0.");
  }

  void SignalWindows::judge(const std::string &section, const double end_time, Results &results) const
  {
    for (const auto &[entry, value, taken] :
         {std::tuple("Spectrum duration", spectrum_duration, "all of which is taken instead"),
          std::tuple("Growth end", growth_end, "whose end is taken instead")})
      if (value > end_time)
        doubt(section + "/Signals/" + entry + " is " + number_text(value) + " s, longer than the run of " +
                  number_text(end_time) + " s, " + taken + ".",
              results);
  }
} // namespace vibrocontact
