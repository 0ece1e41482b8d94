#pragma once

#include <vibrocontact/numerics/delay.h>
#include <vibrocontact/receptances/frequency_data.h>

#include <optional>
#include <string>

namespace vibrocontact
{
  /// What data say about themselves before anything is fitted.
  struct DataJudgement
  {
    /// lines above 0 Hz on which a force gains energy from the body, over all such lines [-]
    double gaining = 0;
    /// where it gains most [Hz]
    double frequency = 0;
    /// of a body at rest with enough lines: by how much the responses still lag behind the forces
    std::optional<DelayEstimate> delay;
    /// one sentence about what is wrong and what to do, without the file's name; empty if nothing is
    std::string complaint;

    /// Whether the delay is told by the data, and large enough to matter.
    bool is_late(double highest_frequency) const;
  };

  /// Share of lines on which data create energy.
  ///
  /// Under forces F e^{j omega t} the power is omega / 2 F^H (G - G^H) / (2 j) F with the sign turned: a body at rest
  /// that has no motor takes energy under all forces, so that Im G (reciprocal, symmetric) has no positive eigenvalue. Of a
  /// rolling body, whose speed is held by a motor, the matrix may have some, and only driving points are looked at:
  /// Im G_ii <= 0. A line counts if the eigenvalue exceeds 1 % of |G| (a phase error of half a degree) and four times the
  /// noise, that is, what second differences over the lines leave of it, in the quantity of the file.
  ///
  /// More than 5 % of such lines is refused. Which mistake is likely: another quantity than the labels say under which
  /// the lines are in order; then a delay. Delays that leave no such line are told by estimate_delay() and count
  /// if they turn the last line by more than 0.06 rad and real modes without them fit 1.5 times worse.
  /// @param data as read_frequency_data() returns them
  /// @param removed the delay that has been taken out already, part of what is proposed [s]
  DataJudgement judge_data(const FrequencyData &data, bool rolling, double removed);
} // namespace vibrocontact
