#include <vibrocontact/analyses/transient/make_mode_recorder.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/run/check_transient.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    /// eigenvectors of more states take longer than most runs: some 20 s for 2,000
    constexpr unsigned int most_states = 3000;

    std::string reason_for_none(const Parameters &parameters, const ContactPair &pair)
    {
      if (parameters.transient.starts_undeformed() || parameters.transient.release)
        return "the run does not start from an equilibrium";
      if (contact_points_have_mass(parameters))
        return "the contact points have mass";
      if (pair.n_poles() > 0)
        return pair.labels[pair.n_modes()] + " is a pole, and no mode";
      if (2 * pair.n_modes() > most_states)
        return "there are more than " + std::to_string(most_states) + " states";
      return "";
    }

    RollingEquilibrium equilibrium_of(const DynamicState &rest, const ContactSections &sections,
                                      const PlacedContacts &contacts, const Drive &drive)
    {
      return rolling_equilibrium(rest.contact, friction_law_of_points(sections, contacts),
                                 normal_law_of_points(sections, contacts), drive.creepage.speed,
                                 drive.normal_force > 0);
    }
  } // namespace

  std::unique_ptr<ModeRecorder> mode_recorder(const Parameters &parameters, const ContactPair &held,
                                              const HubMotion &hub, const std::string &folder)
  {
    const ContactPair &pair = *hub.pair;
    if (parameters.signals.n_modes == 0 || pair.n_modes() == 0)
      return nullptr;
    std::string reason = reason_for_none(parameters, pair);
    try
    {
      if (reason.empty())
      {
        TransientParameters at_rest = parameters.transient;
        at_rest.perturbed_mode.clear();
        const DynamicState rest =
            initial_state(at_rest, parameters.contacts, parameters.contact_solver, held, hub);
        const unsigned int perturbed = perturbed_mode(parameters.transient, held.labels_of_modes());
        return std::make_unique<ModeRecorder>(
            ModeProjection(pair, find_creep_scheme(parameters.contact().creep_scheme),
                           equilibrium_of(rest, parameters.contacts, pair.interface.contacts, hub.drive(0)),
                           rest, parameters.signals.n_modes,
                           perturbed < held.n_modes() ? held.labels[perturbed] : ""),
            folder);
      }
    }
    catch (const InputError &error)
    {
      reason = error.what();
    }
    catch (const ConvergenceError &error)
    {
      reason = error.what();
    }
    run_log().line("No amplitudes of the contact's modes: " + reason + (reason.back() == '.' ? "" : "."));
    return nullptr;
  }
} // namespace vibrocontact
