#pragma once

#include <vibrocontact/marching/signal_windows.h>
#include <vibrocontact/marching/transient_parameters.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// `subsection Signals` of `subsection Transient`: what is listened to while time runs, and what is made of
  /// it.
  struct SignalParameters
  {
    /// see parse_probes()
    std::string probes = "rim";
    /// the histories as histories.csv too
    bool table = false;
    /// distance of the frames of the contact patch and time of the first [s]; distance 0, or
    /// Output/Fields = false: none
    double patch_interval = 0, patch_begin = 0;
    /// growth rates end at the latest where the number of sticking points changes
    SignalWindows windows;
    /// modes of the contact whose amplitudes are followed, those of the largest growth rates; 0: none
    unsigned int n_modes = 6;
    /// a WAV per probe velocity
    bool sound = true;
    /// 1.0 in it [m/s], which lets it grow with the run; 0: written at the end
    double sound_full_scale = 0;
    bool streams_sound() const { return sound && sound_full_scale > 0; }

    void declare_parameters(dealii::ParameterHandler &prm);
    /// @param bodies names of the bodies that have modes
    /// @throws InputError
    void check(const std::vector<std::string> &bodies, const TransientParameters &transient) const;
  };

  /// A place on a body and a direction in which its motion is recorded.
  struct ProbeRequest
  {
    /// name of the probe; empty: the rim of every wheel
    std::string name;
    std::string body;
    /// contact frame [m]; the nearest point of the body's surface is taken
    dealii::Point<3> place;
    /// unit vector, contact frame
    dealii::Tensor<1, 3> direction;
  };

  /// Reads a list of probes, separated by semicolons: `NAME: BODY X Y Z along DIRECTION`, places in the
  /// contact frame in m, directions x, y, z or three numbers; or `rim`: the rim of every wheel, axially and
  /// radially.
  ///
  ///     rim; head: rail 0.3 0 0 along z; web: wheel 0 0.02 0.25 along 0 1 0
  ///
  /// @throws InputError
  std::vector<ProbeRequest> parse_probes(const std::string &text);
} // namespace vibrocontact
