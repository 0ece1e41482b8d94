#pragma once

#include <vibrocontact/run/entries_of_bodies.h>

#include <string>

namespace vibrocontact
{
  // What several analyses read of bodies in contact.

  /// A body in contact that moves in its modes.
  BodyUse moving_in_contact();
  /// All bodies in contact; along the contact they move if something rubs there.
  void add_partners(EntriesRead &entries, const Parameters &parameters, const BodyUse &use);

  /// How body 1 slides on body 2 beside the creepages, of section Rolling. @param condition in words of rubs
  void add_sliding(EntriesRead &entries, const Parameters &parameters, bool rubs = true,
                   const std::string &condition = "");

  void add_lateral_position(EntriesRead &entries, const Parameters &parameters);
  /// Sections of the contacts: places of the points.
  void add_contact_grid(EntriesRead &entries, const Parameters &parameters);
  /// Section Contact/Solver. @param condition in words of what has to hold
  void add_contact_solver(EntriesRead &entries, const Parameters &parameters, bool holds = true,
                          const std::string &condition = "");
  /// Contact/Friction coefficient, if the law is scaled by it.
  void add_friction_coefficient(EntriesRead &entries, const ContactParameters &contact);
  /// The friction law, its coefficient and what it is made of. @param condition in words of what holds where it acts
  void add_friction(EntriesRead &entries, const ContactParameters &contact, bool rubs,
                    const std::string &condition);
  /// What a normal law is made of. @param entry that names it, for messages
  void add_normal_law(EntriesRead &entries, const ContactParameters &contact, const std::string &name,
                      const std::string &entry);
  /// Contacts that nothing rolls or slides through: grids, laws, solver.
  void add_contacts_at_rest(EntriesRead &entries, const Parameters &parameters,
                            const std::vector<double> &swept_friction = {});
  /// The same with what rolls and slides. @param swept_friction in place of the sections' coefficients; empty: none
  /// @param unmet what would have to hold for the creep scheme to be read; empty: nothing
  void add_contacts(EntriesRead &entries, const Parameters &parameters,
                    const std::vector<double> &swept_friction = {}, const std::string &unmet = "");
  /// Cases of rolling and of the equilibria of stability.
  void add_rolling_cases(EntriesRead &entries, const Parameters &parameters);
  /// Of all cases of a sweep [-].
  double largest_friction_of_cases(const Parameters &parameters);
  /// What becomes of the hub of body 1 once the load has found its place.
  void add_hub(EntriesRead &entries, const Parameters &parameters);
  /// Of marches and what repeats itself in time: bodies, contacts with their friction, and the hub.
  void add_motion_in_contact(EntriesRead &entries, const Parameters &parameters);
  /// The history of section Loading.
  void add_load_history(EntriesRead &entries, const Parameters &parameters);
} // namespace vibrocontact
