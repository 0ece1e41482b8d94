#include <vibrocontact/analyses/rolling/rolling_scene.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/half_space.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    void check_hub(const ContactBody &body, const PlacedContacts &contacts)
    {
      if (!body.reduced)
        return;
      const PlacedContacts::Rows own = contacts.rows_of(0);
      for (unsigned int i = 0; i < own.rows.size(); ++i)
      {
        const unsigned int component = own.rows[i] / contacts.n_points(),
                           k = contacts.contact_of(own.rows[i] % contacts.n_points());
        if (std::abs(body.reduced->lifting[i] - contacts.all[k].frame.axes[component][2]) > 1e-9)
          throw InputError(
              "Body " + body.parameters->name +
              " cannot be pressed down by its hub: body 1 must be carried by a held boundary alone, without "
              "springs; make it body 2 or hold it.");
      }
    }

  } // namespace

  RollingScene rolling_scene(const std::vector<ContactBody> &bodies, const ContactSections &sections,
                             const PlacedContacts &contacts)
  {
    RollingScene scene;
    check_hub(bodies[0], contacts);
    const CreepScheme &scheme = find_creep_scheme(sections.first().creep_scheme);
    if (contacts.all.size() == 1 &&
        std::none_of(bodies.begin(), bodies.end(), [](const ContactBody &body) { return body.reduced; }))
    {
      const ContactGrid &grid = contacts.only();
      scene.interface = contact_interface(bodies, sections, contacts);
      const HalfSpacePair pair(half_space_material(*bodies[contacts.all[0].above].parameters),
                               half_space_material(*bodies[contacts.all[0].below].parameters),
                               sections.first().coupling);
      scene.operator_at = [=](const double speed) { return rolling_operator(grid, pair, scheme, speed); };
      return scene;
    }
    const ContactPair pair = contact_pair(bodies, sections, contacts);
    const auto compliance = std::make_shared<const DenseMatrix>(static_compliance(pair));
    const auto gradient = std::make_shared<const DenseMatrix>(static_gradient(pair));
    scene.interface = static_interface(pair);
    scene.operator_at = [=](const double speed)
    { return rolling_operator(contacts, *compliance, scheme, speed, *gradient); };
    return scene;
  }
} // namespace vibrocontact
