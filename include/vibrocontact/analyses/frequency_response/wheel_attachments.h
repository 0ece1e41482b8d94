#pragma once

#include <vibrocontact/analyses/frequency_response/modal_response.h>
#include <vibrocontact/fe/revolved_section.h>
#include <vibrocontact/reduction/damped_wheel.h>
#include <vibrocontact/reduction/revolved_point.h>
#include <vibrocontact/scene/wheel_damper.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// A mass at a row of a receptance, as AttachedMass: m x'' + k (1 + j eta) (x - u) = 0.
  struct Attachment : SprungMass
  {
    unsigned int row = 0;
  };

  /// The receptance of a body with masses at some of its rows a, of that without them:
  ///
  ///   H - H_:a (diag(1/Z) + H_aa)^-1 H_a:,     Z = -w^2 m for a fixed mass, -w^2 m k' / (k' - w^2 m) for one on k' = k (1 + j eta)
  ///
  /// A mass of 0 and a spring of 0 change nothing. @param share of each mass that is there [-] @param omega w [rad/s]
  void attach(const std::vector<Attachment> &attachments, double share, double omega, Receptance &H);

  /// Dampers of a wheel (scene/wheel_damper.h, doc/wheel_damping.md) on what its section answers.
  struct WheelAttachments
  {
    /// absorbers: places in the axes of the section, and a mass at each, by its number
    std::vector<RevolvedPoint> places;
    std::vector<Attachment> absorbers;
    /// rings: rows of the section, and a mass at each: half of it with a family of n > 0, all of it with n = 0
    std::vector<TraceRow> ring_rows;
    std::vector<Attachment> rings;
    /// layers: loss factor of each part of the section; empty: none
    std::vector<double> layers;

    bool has_masses() const { return !absorbers.empty() || !rings.empty(); }
  };

  /// @param path of the section that the dampers have in the file, for messages
  /// @throws InputError for a place that is not on the section, a layer without elements
  WheelAttachments wheel_attachments(const RevolvedSection &section, const std::vector<WheelDamper> &dampers,
                                     const std::string &path);
} // namespace vibrocontact
