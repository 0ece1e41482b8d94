#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/suspended_pair.h>
#include <vibrocontact/marching/hub_motion.h>
#include <vibrocontact/marching/initial_state.h>

#include <array>

namespace vibrocontact
{
  std::string transient_hub(const std::string &hub, const LoadOverTime &load)
  {
    const HubKind &kind = hub_kind(hub);
    if (load.hub_displacement && (kind.keeps_force || kind.has_mass()))
      throw InputError(load.name + " moves a held hub, but Rolling/Hub is " + hub +
                       ": give Normal force over time, or set Rolling/Hub to held.");
    return load.normal_force && kind.keeps_place ? "massless" : hub;
  }

  std::string transient_hub_text(const std::string &hub, const LoadOverTime &load)
  {
    const std::string applied = transient_hub(hub, load);
    if (load.name.empty() || !hub_kind(applied).exists())
      return hub_text(applied);
    return load.hub_displacement ? "held: moved by " + load.name
                                 : applied + ": moved by the load " + load.name +
                                       (applied == hub ? "" : ", so that it is not held");
  }

  namespace
  {
    /// The end of a loading as a state of motion: nothing slips but by what drives the bodies from now on.
    ContactSolution at_rest(const LoadedState &loaded, const PlacedContacts &contacts,
                            const CreepScheme &scheme, const Drive &start)
    {
      ContactSolution result = loaded.solution;
      result.approach = loaded.displacement[2];
      const DenseVector rigid = rigid_slip(contacts, scheme, start.creepage);
      for (unsigned int row = contacts.n_points(); row < 3 * contacts.n_points(); ++row)
        result.y[row] = rigid[row];
      return result;
    }

    /// Without what the forces do on a hub along x and y. Its motions along the axes have orthogonal rows.
    void take_off_tangential_force(const PlacedContacts &contacts, DenseVector &forces)
    {
      const DenseMatrix hub = contacts.translation_of(0);
      for (unsigned int d = 0; d < 2; ++d)
      {
        double along = 0, square = 0;
        for (unsigned int row = 0; row < forces.size(); ++row)
        {
          along += hub(row, d) * forces[row];
          square += hub(row, d) * hub(row, d);
        }
        for (unsigned int row = 0; row < forces.size() && square > 0; ++row)
          forces[row] -= hub(row, d) * along / square;
      }
    }
  } // namespace

  HubMotion hub_motion(const std::string &hub, const RollingParameters &rolling, const LoadOverTime &load,
                       const ContactSections &contact, const ContactSolverParameters &solver,
                       const std::shared_ptr<const ContactPair> &held, const DriveFunction &drive,
                       const LoadedState *const loaded, const bool released)
  {
    HubMotion motion{held, [](const DriveFunction &given) { return given; }, drive};
    const Drive start = drive(0);
    const bool by_force = start.normal_force > 0;
    const HubKind &kind = hub_kind(hub);
    if (!loaded && (!kind.exists() || (kind.keeps_place && !by_force) || (kind.keeps_force && by_force)))
      return motion;
    const PlacedContacts &contacts = held->interface.contacts;
    if (loaded)
      motion.loaded = at_rest(*loaded, contacts, find_creep_scheme(contact.first().creep_scheme), start);
    const ContactSolution equilibrium =
        loaded ? *motion.loaded : transient_equilibrium(contact, solver, *held, start);
    const std::array<double, 3> force = contacts.force_on(0, contacts.resultants(equilibrium.R));
    motion.place = equilibrium.approach;
    motion.normal_force = force[2];
    const double place = motion.place, normal_force = motion.normal_force;
    const bool driven = load.normal_force, by_displacement = !kind.keeps_force, suspended = kind.has_mass();
    if (suspended)
    {
      RollingParameters own = rolling;
      own.hub = hub;
      DenseVector preload = equilibrium.R;
      preload[0] += start.force;
      if (released)
        take_off_tangential_force(contacts, preload);
      motion.pair =
          std::make_shared<const ContactPair>(suspended_pair(*held, hub_coordinates(own, *held), preload));
    }
    const double mass = suspended ? motion.pair->hub->mass : 0;
    motion.driven = [=](const DriveFunction &given) -> DriveFunction
    {
      return [=](const double time)
      {
        Drive now = given(time);
        if (suspended && driven)
          now.hub_acceleration = (now.normal_force - normal_force) / mass;
        now.approach = by_displacement ? place : 0;
        now.normal_force = by_displacement ? 0 : normal_force;
        return now;
      };
    };
    motion.drive = motion.driven(drive);
    return motion;
  }

  DynamicState initial_state(const TransientParameters &transient, const ContactSections &contact,
                             const ContactSolverParameters &solver, const ContactPair &held,
                             const HubMotion &hub)
  {
    const Drive start = hub.drive(0);
    DynamicState state =
        initial_state(transient, contact, solver, held, start, hub.loaded ? &*hub.loaded : nullptr);
    if (hub.pair->hub)
    {
      hang(*hub.pair, state);
      complete(*hub.pair,
               rigid_slip(held.interface.contacts, find_creep_scheme(contact.first().creep_scheme),
                          start.creepage),
               state);
    }
    return state;
  }

  void hang(const ContactPair &suspended, DynamicState &state)
  {
    // x^T M of the new modes gives their amplitudes
    const SuspendedHub &hub = *suspended.hub;
    const unsigned int n_1 = hub.n_held_modes();
    for (std::vector<double> *const amplitudes : {&state.q, &state.v})
    {
      std::vector<double> moved(hub.n_added, 0.), result(hub.shapes.n(), 0.);
      for (unsigned int k = 0; k < n_1; ++k)
        for (unsigned int y = 0; y < hub.n_added; ++y)
          moved[y] += hub.coupling(k, y) * (*amplitudes)[k];
      for (unsigned int j = 0; j < result.size(); ++j)
      {
        for (unsigned int k = 0; k < n_1; ++k)
          result[j] += hub.shapes(k, j) * (*amplitudes)[k];
        for (unsigned int y = 0; y < hub.n_added; ++y)
          result[j] += hub.shapes(n_1 + y, j) * moved[y];
      }
      result.insert(result.end(), amplitudes->begin() + n_1, amplitudes->end());
      *amplitudes = result;
    }
  }
} // namespace vibrocontact
