#pragma once

#include <vibrocontact/output/results.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace vibrocontact
{
  /// Which parts of a motion its spectra and growth rates look at; entries of the analysis' `subsection Signals`.
  struct SignalWindows
  {
    /// what the spectrum and the measure of the limit cycle look at: the last ... of the run [s]; 0: half of it
    double spectrum_duration = 0;
    /// window of the growth rates [s]; end 0: to where they may end at the latest
    double growth_begin = 0, growth_end = 0;

    /// @param latest end of growth rates if none is given, in words
    void declare_parameters(dealii::ParameterHandler &prm, const std::string &latest);
    /// @param section of the analysis @param step of its signals, @param end_time of its motion [s] @throws InputError
    void check(const std::string &section, double step, double end_time) const;
    /// Says in the results that the run is shorter than these.
    void judge(const std::string &section, double end_time, Results &results) const;
  };
} // namespace vibrocontact
