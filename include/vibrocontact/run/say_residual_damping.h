#pragma once

#include <vibrocontact/output/results.h>
#include <vibrocontact/run/parameters.h>
#include <vibrocontact/run/prepare_pair.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Says under `residual_damping` of the analysis whether the damping of residual flexibilities is `taken`, and if it is not,
  /// in the log too, what that changes (coupled_bodies/residual_damping.h): `relative_change`, `frequency_Hz`; a warning
  /// from 1 % on. Nothing where there is no such damping.
  /// Looked at in the middle of the contact.
  /// @param reduced of each body of the scene, null: none; @param further see dropped_residual_damping()
  /// @param frequencies that the analysis found [Hz]; empty: those of the lowest and highest elastic modes
  /// @param key in Results::analyses @param relaxes whether the analysis takes their relaxation
  void say_residual_damping(const Parameters &parameters, const std::vector<const ReducedBody *> &reduced,
                            double further, std::vector<double> frequencies, const std::string &key,
                            Results &results, bool relaxes = true);
  /// The same of the bodies of a scene, in the middle of the first contact.
  void say_residual_damping(const Parameters &parameters, const PreparedPair &prepared,
                            const ContactPair &pair, const std::vector<double> &frequencies,
                            const std::string &key, Results &results, bool relaxes = true);
  /// Bodies whose viscous damping couples modes, of which each takes its own part alone in contact: a warning from 10 % on.
  /// @param reduced null: none
  void say_coupled_damping(const std::vector<const ReducedBody *> &reduced, Results &results);
  void say_coupled_damping(const PreparedPair &prepared, Results &results);
  /// The same of Stability/Loss = hysteretic, which takes the damping of all bodies but those of materials with several loss
  /// factors: their names in a warning.
  void say_hysteretic_rests(const Parameters &parameters, Results &results);
} // namespace vibrocontact
