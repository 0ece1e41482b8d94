#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/run/check_contacts.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace vibrocontact
{
  namespace
  {
    void check_bodies(const Scene &scene, const ContactParameters &contact)
    {
      const std::string entry = contact.section + "/Bodies ";
      if (contact.bodies.size() != 2)
        throw InputError(entry + "lists " + std::to_string(contact.bodies.size()) +
                         ": a contact joins two, the one above and the one below.");
      std::vector<std::string> names;
      for (const BodyParameters &body : scene.bodies)
        names.push_back(body.name);
      for (const std::string &name : contact.bodies)
        if (std::find(names.begin(), names.end(), name) == names.end())
          throw InputError(entry + "names \"" + name + "\", which is no body of this file; " +
                           name_suggestion(name, names));
      if (contact.bodies[0] == contact.bodies[1])
        throw InputError(entry + "joins " + contact.bodies[0] + " with itself: name two bodies.");
    }

    /// What a type of body can have more of than one contact in the usual frame.
    /// @param own its contacts, and whether it is the first body there
    void check_type(const BodyParameters &body,
                    const std::vector<std::pair<const ContactParameters *, bool>> &own)
    {
      if (own.empty())
        throw InputError("Body " + body.name +
                         " is in no contact of the list Contacts: join it, or leave it out of Bodies.");
      const ContactPlaces places = body.description->contact_places();
      if (places == ContactPlaces::anywhere)
        return;
      const std::string several =
          body.name + ", of type " + body.type + ", is in " + std::to_string(own.size()) + " contacts, ";
      if (own.size() > 1 && body.description->lies_on_half_space())
        throw InputError(several +
                         "but half-spaces couple within one grid only: put their points on one grid.");
      if (own.size() > 1 && places != ContactPlaces::along_axis)
        throw InputError(several + "but its points are one contact: list them in one.");
      for (const auto &[contact, above] : own)
      {
        const ContactFrame frame = above ? contact->frame() : contact->frame_below();
        const bool along =
            places == ContactPlaces::along_axis && frame.origin[0] == 0 && frame.origin[1] == 0;
        if (!frame.has_usual_axes())
          throw InputError(contact->section + "/Normal turns the contact of " + body.name + ", of type " +
                           body.type + ", which moves and touches in its own directions: leave it out.");
        if (places != ContactPlaces::any_origin && !frame.is_usual() && !along)
          throw InputError(contact->section + "/Origin moves the contact of " + body.name + ", of type " +
                           body.type + ", " +
                           (places == ContactPlaces::along_axis
                                ? "off its axis: give x = y = 0."
                                : "whose place is its own: leave it at 0, 0, 0."));
      }
    }

    /// Modal convolution moves body 1 alone, over one road that lies below all of its contacts.
    void check_road_contacts(const Parameters &parameters)
    {
      const Scene &scene = parameters.scene;
      const BodyParameters &body = scene.bodies[0];
      if (body.is_green())
        throw InputError("Analyses lists modal convolution, but the points of " + body.name + ", of type " +
                         body.type +
                         ", are one contact with the road: leave Contacts out and give section "
                         "Contact.");
      if (parameters.comparison.any())
        throw InputError("Comparison/Rows asks for a comparison of methods, but Contacts lists " +
                         scene.contacts_entry +
                         ": the comparison is that of one contact, leave the rows out.");
      const PlacedContacts placed = parameters.placed_contacts();
      for (unsigned int k = 0; k < placed.all.size(); ++k)
      {
        const PlacedContact &contact = placed.all[k];
        const std::string moves = "Analyses lists modal convolution, which moves " + body.name + " over ";
        if (contact.above != 0 || !scene.bodies[contact.below].description->is_rigid())
          throw InputError(moves + "a rigid road, but contact " + contact.name +
                           " does not join it, above, with a rigid body: run transient, or change " +
                           parameters.contacts.all[k].section + "/Bodies.");
        if (!contact.frame.has_usual_axes())
          throw InputError(moves + "a road below it, but " + parameters.contacts.all[k].section +
                           "/Normal inclines contact " + contact.name + ": run transient, or leave it out.");
      }
    }

    void check_analyses(const Parameters &parameters)
    {
      const Scene &scene = parameters.scene;
      const std::string lists = "Contacts lists " + scene.contacts_entry + ", but ";
      if (scene.runs("modal convolution"))
        check_road_contacts(parameters);
      if (scene.runs("stability") &&
          parameters.sweeps.at("stability").sweeps(ParameterSweep::lateral_position))
        throw InputError(
            lists + "Stability/Sweep/Entry is Contact/Lateral position, which moves the only contact of a "
                    "file: sweep the Lateral position of one of them, or another entry.");
    }

    bool rubs(const Parameters &parameters, const ContactParameters &contact)
    {
      const std::vector<double> &swept = parameters.rolling.sweep.friction;
      return swept.empty() ? contact.friction > 0 : *std::max_element(swept.begin(), swept.end()) > 0;
    }
    /// What contacts of a list join and where.
    void check_list(const Parameters &parameters)
    {
      const Scene &scene = parameters.scene;
      for (const ContactParameters &contact : parameters.contacts.all)
      {
        check_bodies(scene, contact);
        contact.frame();
        contact.frame_below();
      }
      check_analyses(parameters);
      for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      {
        std::vector<std::pair<const ContactParameters *, bool>> own;
        for (const ContactParameters &contact : parameters.contacts.all)
          for (unsigned int k = 0; k < 2; ++k)
            if (contact.bodies[k] == scene.bodies[b].name)
              own.emplace_back(&contact, k == 0);
        check_type(scene.bodies[b], own);
      }
      const PlacedContacts placed = parameters.placed_contacts();
      const bool moves =
          scene.runs("quasi-static rolling") || scene.runs("stability") || scene.runs("limit cycle");
      for (unsigned int k = 0; k < placed.all.size(); ++k)
      {
        const ContactParameters &contact = parameters.contacts.all[k];
        if (contact.creep_scheme != parameters.contact().creep_scheme)
          throw InputError(
              contact.section + "/Creep scheme is " + contact.creep_scheme + ", but that of " +
              parameters.contact().section + " is " + parameters.contact().creep_scheme +
              ": material that rolls through several contacts is differenced by one scheme, make them "
              "equal.");
        if (contact.half_space_flexibility() && placed.all.size() > 1)
          throw InputError(
              contact.section +
              "/Local flexibility is half-space, but half-spaces couple within one grid only: set it "
              "to finite elements.");
        const Creepage seen = placed.all[k].seen(parameters.rolling.creepage);
        if (moves && rubs(parameters, contact) && !(seen.speed > 0) && !seen.slides())
          throw InputError("Rolling/Speed is 0 and nothing slides in contact " + contact.name +
                           ": its friction forces have no direction; give it a Sliding velocity or set " +
                           contact.section + "/Friction coefficient to 0.");
        const bool under_hub = placed.all[k].above == 0 || placed.all[k].below == 0;
        if ((scene.runs("stability") || scene.runs("limit cycle")) &&
            hub_kind(parameters.rolling.hub).keeps_force && under_hub &&
            !placed.all[k].frame.has_usual_axes())
          throw InputError("Rolling/Hub is massless, but the normal of contact " + contact.name +
                           " is inclined, so that its motion would slip there, which stability and limit "
                           "cycle do not linearise: set "
                           "it to suspended or held.");
      }
    }

    /// What stands in place of the elements' local flexibility, and what then carries the rest.
    void check_local_flexibility(const Parameters &parameters, const ContactParameters &contact,
                                 const std::vector<const BodyParameters *> &joined)
    {
      if (!contact.replaces_flexibility())
        return;
      const std::string entry = contact.half_space_flexibility()
                                    ? contact.section + "/Local flexibility is half-space"
                                    : contact.section + "/Normal-tangential coupling is false";
      for (const auto &[section, model] : unreduced_models(parameters))
        throw InputError(
            entry + ", but " + section + "/Model is " + model +
            ", which takes the local flexibility from the elements themselves: set it to reduced.");
      if (contact.half_space_flexibility() && contact.has_consistent_quadrature())
        throw InputError(entry + ", which knows tractions that are constant on each cell only: set " +
                         contact.section + "/Quadrature to lumped.");
      for (const BodyParameters *const one : joined)
      {
        const BodyParameters &body = *one;
        if (contact.half_space_flexibility() && !body.description->may_stand_for_half_space())
          throw InputError(entry + ", but the surface of the " + body.type + " " + body.name +
                           " is no half-space: set it to finite elements.");
        if (contact.half_space_flexibility() && body.materials.size() > 1)
          throw InputError(entry + ", but " + body.name +
                           "/Materials lists several, and which of them would fill the half-space is not "
                           "known: set it to finite elements.");
        if (contact.half_space_flexibility() && body.is_orthotropic())
          throw InputError(entry + ", but " + body.name +
                           " has an orthotropic material, and half-spaces here are isotropic: set it to "
                           "finite elements.");
        if (body.is_meshed() && !parameters.modes.at(body.name).any())
          throw InputError(body.name + "/Modes asks for no modes, but " + entry +
                           ", so that the modes have to carry the rest of the body's flexibility; give Upper "
                           "frequency or Count");
      }
    }

    /// A beam rail and a half-space lie below the contact, or carry tractions that are constant on each cell.
    void check_half_space_contact(const std::vector<const BodyParameters *> &bodies,
                                  const ContactParameters &contact)
    {
      if (bodies[0]->description->lies_below())
        throw InputError(bodies[0]->name + " is a " + bodies[0]->type +
                         ", which lies below the contact, but is body 1, above; "
                         "list it second in Bodies.");
      for (const BodyParameters *const body : bodies)
        if (contact.has_consistent_quadrature() && body->description->lies_on_half_space())
          throw InputError(
              contact.section + "/Quadrature is consistent, but the half-space under the contact of " +
              body->name + " knows tractions that are constant on each cell only: set it to lumped.");
    }

    /// Two bodies without a mesh touch in a point (in a line along a strip), and one of them gives way.
    void check_touch(const BodyParameters &body_1, const BodyParameters &body_2, const bool strip)
    {
      if (body_2.description->touches_downwards_only())
        throw InputError("The " + body_2.type + " " + body_2.name +
                         " touches what lies below it, but is body 2, below: list it first in Bodies" +
                         body_2.description->way_to_look_up() + ".");
      const auto own_1 = body_1.description->contact_points(1), own_2 = body_2.description->contact_points(1);
      if (own_1 && own_2 && own_1->n_points() != own_2->n_points())
        throw InputError("The bodies " + body_1.name + " and " + body_2.name + " bring " +
                         std::to_string(own_1->n_points()) + " and " + std::to_string(own_2->n_points()) +
                         " contact points of their own, which cannot meet: give both the same number.");
      for (unsigned int i = 0; own_1 && own_2 && own_1->n_points() > 1 && i < own_1->n_points(); ++i)
      {
        const auto place = [](const ContactGrid &grid, const unsigned int i)
        { return "(" + number_text(grid.x(i)) + ", " + number_text(grid.y(i)) + ")"; };
        if (std::abs(own_1->x(i) - own_2->x(i)) > 1e-6 * own_1->spacing_x ||
            std::abs(own_1->y(i) - own_2->y(i)) > 1e-6 * own_1->spacing_y)
          throw InputError("The bodies " + body_1.name + " and " + body_2.name +
                           " bring contact points of their own at other places (x, y): " + place(*own_1, i) +
                           " and " + place(*own_2, i) + " m; give both the same.");
      }
      if (body_1.vibrates() || body_2.vibrates())
        return;
      if (body_1.description->is_rigid() && body_2.description->is_rigid())
        throw InputError("The bodies " + body_1.name + " and " + body_2.name +
                         " are both rigid: make one of them a half-space or a meshed body.");
      const auto [x_1, y_1] = body_1.description->curvatures();
      const auto [x_2, y_2] = body_2.description->curvatures();
      const double x = x_1 + x_2, y = y_1 + y_2;
      if (!(x > 0) || (!(y > 0) && !strip))
        throw InputError(
            "The bodies " + body_1.name + " and " + body_2.name +
            " do not touch in a point: their curvatures 1/Radius x, 1/Radius y must sum to a positive "
            "number in both directions (along x alone with a Contact/Strip length).");
    }

    /// Whether a place of two bodies belongs to both contacts, where it would be pressed twice.
    bool overlap(const PlacedContact &one, const PlacedContact &other)
    {
      if (one.above != other.above || one.below != other.below || one.frame.axes != other.frame.axes)
        return false;
      const ContactGrid &a = one.grid, &b = other.grid;
      const auto [x, y, height] = one.frame.coordinates(other.frame.origin);
      // of the middles from each other, and of the sides where grids touch
      const double distance_x = x + (b.x_first - a.x_first) +
                                ((b.n_x - 1.) * b.spacing_x - (a.n_x - 1.) * a.spacing_x) / 2,
                   distance_y = y + (b.y_first - a.y_first) +
                                ((b.n_y - 1.) * b.spacing_y - (a.n_y - 1.) * a.spacing_y) / 2,
                   reach_x = (a.n_x * a.spacing_x + b.n_x * b.spacing_x) / 2,
                   reach_y = (a.n_y * a.spacing_y + b.n_y * b.spacing_y) / 2;
      constexpr double beside = 1 - 1e-6, same_height = 0.1;
      return std::abs(distance_x) < beside * reach_x && std::abs(distance_y) < beside * reach_y &&
             std::abs(height) < same_height * std::max(reach_x, reach_y);
    }

    void check_overlap(const std::vector<PlacedContact> &contacts)
    {
      for (std::size_t k = 0; k < contacts.size(); ++k)
        for (std::size_t l = k + 1; l < contacts.size(); ++l)
          if (overlap(contacts[k], contacts[l]))
            throw InputError(
                "The contacts " + contacts[k].name + " and " + contacts[l].name +
                " of the same bodies overlap, where both would press: move the Origin of one, or "
                "make Half length and Half width smaller.");
    }

    /// A layer stays where it is; what it slides on is rigid.
    void check_layer(const Scene &scene, const RollingParameters &rolling)
    {
      for (const BodyParameters &body : scene.bodies)
        if (body.description->stays_in_place())
        {
          if (&body != &scene.bodies[0] || scene.bodies.size() < 2 ||
              !scene.bodies[1].description->is_rigid())
            throw InputError(
                "The layer " + body.name +
                " slides on a rigid plane: list it first in Bodies and a body of type rigid second.");
          if (scene.bodies[1].description->curvatures() != std::make_pair(0., 0.))
            throw InputError(scene.bodies[1].name + "/Rigid has a curvature, but a layer slides on a plane: "
                                                    "leave its radii out.");
          if (rolls_or_slides(scene) && rolling.creepage.speed != 0)
            throw InputError("Entry Rolling/Speed has to be 0 for the layer " + body.name +
                             ", whose material stays in place: give a Sliding velocity.");
        }
    }
  } // namespace

  bool rolls_or_slides(const Scene &scene)
  {
    return scene.runs("quasi-static rolling") || scene.runs("stability") || scene.runs("transient") ||
           scene.runs("limit cycle");
  }

  std::map<std::string, std::string> unreduced_models(const Parameters &parameters)
  {
    std::map<std::string, std::string> models;
    if (parameters.scene.runs("stability") && !parameters.stability.is_reduced())
      models["Stability"] = parameters.stability.model;
    if (parameters.scene.runs("transient") && !parameters.transient.is_reduced())
      models["Transient"] = parameters.transient.model;
    return models;
  }

  void check_contacts(const Parameters &parameters)
  {
    const Scene &scene = parameters.scene;
    if (!scene.contacts.empty())
      check_list(parameters);
    if (!parameters.has_contact())
      return;
    check_layer(scene, parameters.rolling);
    const bool has_two_bodies =
        rolls_or_slides(scene) || scene.runs("quasi-static loading") || scene.runs("periodic");
    for (unsigned int k = 0; k < parameters.contacts.all.size(); ++k)
    {
      const ContactParameters &one = parameters.contacts.all[k];
      const auto [above, below] = parameters.bodies_of_contact(k);
      std::vector<const BodyParameters *> joined = {&scene.bodies[above]};
      // a body on a road has no partner
      if (below < scene.bodies.size())
        joined.push_back(&scene.bodies[below]);
      check_half_space_contact(joined, one);
      if (joined.size() > 1 && (has_two_bodies || !scene.runs("modal convolution")))
        check_touch(*joined[0], *joined[1], one.strip_length > 0);
      check_local_flexibility(parameters, one, joined);
    }
    check_overlap(parameters.placed_contacts().all);
  }

  void check_own_equations(const Parameters &parameters, const std::string &what)
  {
    const auto refuse = [&](const std::string &asked)
    { throw InputError(what + ", which does not take " + asked + "."); };
    if (hub_kind(parameters.hub()).has_mass())
      refuse("a hub with mass: set Rolling/Hub to held or massless");
    for (const ContactParameters &contact : parameters.contacts.all)
      if (contact.law_of_friction()->depends_on_speed())
        refuse("friction that depends on the slip speed");
    for (const BodyParameters &body : parameters.scene.bodies)
    {
      if (body.is_periodic_rail() && !parameters.stability.is_hysteretic())
        refuse("a periodic rail (" + body.name + ") by its poles in time: set Stability/Loss to hysteretic");
      if (body.is_green() || body.has_complex_modes())
        refuse("a body known by poles (" + body.name + ")");
    }
  }

  void check_speed_of_road(const BodyParameters &body, const RoadParameters &road)
  {
    if (body.rolls() && body.is_revolved())
      throw InputError(
          body.name + "/" + body.body_type().section +
          "/Rotation is true, which quasi-static rolling, stability, transient, limit cycle and "
          "frequency response know, but modal convolution takes the wheel at rest: leave it out.");
    if (body.rolls() && road.speed == 0)
      throw InputError(body.name +
                       "/Ring/Rolling is true, but Road/Speed is 0: the poles of a rolling ring need a "
                       "constant Speed, give it.");
  }
} // namespace vibrocontact
