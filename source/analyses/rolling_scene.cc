#include <vibrocontact/analyses/rolling_scene.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/half_space.h>

#include <cmath>

namespace vibrocontact
{
  namespace
  {
    void check_hub(const ContactBody &body)
    {
      if (!body.reduced)
        return;
      for (unsigned int i = 0; i < body.reduced->grid.n_points(); ++i)
        if (std::abs(body.reduced->lifting[i] - 1) > 1e-9)
          throw InputError(
              "Body " + body.parameters->name +
              " cannot be pressed down by its hub: body 1 must be carried by a held boundary alone, without "
              "springs; make it body 2 or hold it.");
    }

  } // namespace

  RollingScene rolling_scene(const ContactBody &body_1, const ContactBody &body_2,
                             const ContactParameters &contact, const ContactGrid &grid)
  {
    RollingScene scene;
    check_hub(body_1);
    const CreepScheme &scheme = find_creep_scheme(contact.creep_scheme);
    if (!body_1.reduced && !body_2.reduced)
    {
      scene.interface = contact_interface(body_1, body_2, grid);
      const HalfSpacePair pair(half_space_material(*body_1.parameters),
                               half_space_material(*body_2.parameters), contact.coupling);
      scene.operator_at = [=](const double speed) { return rolling_operator(grid, pair, scheme, speed); };
      return scene;
    }
    const ContactPair pair = contact_pair(body_1, body_2, contact, grid);
    const auto compliance = std::make_shared<const DenseMatrix>(static_compliance(pair));
    scene.interface = static_interface(pair);
    scene.operator_at = [=](const double speed)
    { return rolling_operator(grid, *compliance, scheme, speed); };
    return scene;
  }
} // namespace vibrocontact
