#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/memory.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/run/check_loading.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  void check_loading(const Parameters &parameters)
  {
    parameters.loading.check();
    for (const ContactParameters &contact : parameters.contacts.all)
      if (contact.law_of_friction()->depends_on_speed())
        throw InputError(
            "The friction of " + contact.section +
            " depends on the slip speed, but quasi-static loading knows no time: take the Friction "
            "law coulomb (a Static friction ratio of 1).");
    for (const BodyParameters &body : parameters.scene.bodies)
    {
      if (body.rolls())
        throw InputError(body.name + "/" + body.body_type().section +
                         (body.is_revolved() ? "/Rotation" : "/Rolling") +
                         " is true, but nothing rolls in quasi-static loading: set it to false or leave the "
                         "analysis out.");
      if (body.description->moves_along_z_only() && parameters.largest_friction() > 0)
        throw InputError(
            body.name + " is a " + body.type +
            ", which moves in one direction only: in quasi-static loading it has no friction; set "
            "Contact/Friction coefficient to 0.");
    }
  }

  void check_load_history(const Parameters &parameters)
  {
    const LoadHistory history = parameters.loading.history();
    if (!history.force_given[0] && !history.force_given[1])
      return;
    if (!(parameters.largest_friction() > 0))
      throw InputError(
          "Loading gives a force along the contact, but Contact/Friction coefficient is 0, so that "
          "nothing answers to it: give a Displacement, or leave it out.");
    // what several contacts bear, or bear under a given approach, is found on the way
    if (!history.force_given[2] || parameters.contacts.all.size() > 1)
      return;
    const double mu = parameters.contact().friction;
    for (std::size_t k = 0; k < history.steps.size(); ++k)
    {
      const std::array<double, 3> &load = history.steps[k].load;
      const double force =
          std::hypot(history.force_given[0] ? load[0] : 0., history.force_given[1] ? load[1] : 0.);
      if (force >= mu * load[2])
        throw InputError("Loading drives body 1 by " + number_text(force) + " N along the contact in step " +
                         std::to_string(k + 1) + ", but friction bears less than " +
                         number_text(mu * load[2]) + " N there: give a smaller force, or a Displacement.");
    }
  }

  void print_load_history(const Parameters &parameters)
  {
    const LoadHistory history = parameters.loading.history();
    const double n_steps = history.steps.size(), n_points = parameters.placed_contacts().n_points();
    Log &log = run_log();
    log.block("Load history");
    log.value("steps", static_cast<unsigned int>(history.steps.size()));
    log.value("parts", history.steps.back().part);
    log.value("given along x, y, downwards", std::string(history.force_given[0] ? "force" : "displacement") +
                                                 (history.force_given[1] ? ", force" : ", displacement") +
                                                 (history.force_given[2] ? ", force" : ", displacement"));
    const auto &bodies = parameters.scene.bodies;
    if (std::any_of(bodies.begin(), bodies.end(),
                    [](const BodyParameters &body) { return body.is_meshed(); }))
      log.value("compliance of the contact points", bytes_text(8 * std::pow(3 * n_points, 2)));
    else
      // of 400 to 8,000 points (doc/loading.md)
      log.value("all steps on both grids", "about " + time_text(std::ceil(1.5e-4 * n_steps * n_points)));
  }
} // namespace vibrocontact
