#include <vibrocontact/analyses/rolling/rolling_scene.h>
#include <vibrocontact/contact/coarse_points.h>
#include <vibrocontact/contact/half_space.h>

namespace vibrocontact
{
  namespace
  {
    /// Two half-spaces with another spacing than the file's. What a coarse grid has to keep free lies beyond the file's extent.
    RollingGrid half_spaces(const std::vector<ContactBody> &bodies, ContactSections sections,
                            PlacedContacts contacts, const HalfSpacePair &pair, const CreepScheme &scheme,
                            const double factor)
    {
      ContactParameters &contact = sections.first();
      if (factor != 1)
      {
        contact.spacing *= factor;
        if (factor > 1)
        {
          contact.half_length += contact.spacing;
          contact.half_width += 0.5 * contact.spacing;
        }
        contacts.only() = contact.grid();
      }
      const ContactGrid grid = contacts.only();
      return {contact_interface(bodies, sections, contacts),
              [=](const double speed) { return rolling_operator(grid, pair, scheme, speed); }, scheme};
    }

    /// Stated error of one grid over the difference between both; of two it is that difference (doc/contact.md, "Creep and
    /// grid").
    constexpr double factor_of_one = 2;

    RollingGrids half_spaces(const std::vector<ContactBody> &bodies, const ContactSections &sections,
                             const PlacedContacts &contacts, const bool two)
    {
      const HalfSpacePair pair = half_space_pair(bodies, sections, contacts);
      const CreepScheme &scheme =
          two ? leading_edge_scheme() : find_creep_scheme(sections.first().creep_scheme);
      const auto grid = [&](const double factor)
      { return half_spaces(bodies, sections, contacts, pair, scheme, factor); };
      if (!two)
        return {grid(1), grid(2), factor_of_one};
      RollingGrids grids = {grid(0.5), grid(1), 1, true};
      const auto [a, b, c] = pair.constants();
      grids.own.edge = grids.coarse->edge = {{1, (a + b) / a}};
      return grids;
    }
  } // namespace

  RollingGrids rolling_grids(const std::vector<ContactBody> &bodies, const ContactSections &sections,
                             const PlacedContacts &contacts, const bool two)
  {
    const CreepScheme &scheme = find_creep_scheme(sections.first().creep_scheme);
    if (are_half_spaces_alone(bodies, contacts))
      return half_spaces(bodies, sections, contacts, two);
    const ContactPair pair = contact_pair(bodies, sections, contacts);
    const auto compliance = std::make_shared<const DenseMatrix>(static_compliance(pair));
    const auto gradient = std::make_shared<const DenseMatrix>(static_gradient(pair));
    RollingGrids grids;
    grids.own = {static_interface(pair),
                 [=](const double speed)
                 { return rolling_operator(contacts, *compliance, scheme, speed, *gradient); },
                 scheme};
    const CoarsePoints coarse(contacts);
    if (coarse.exist())
      grids.coarse = {coarse.interface(grids.own.interface),
                      [=](const double speed)
                      {
                        return rolling_operator(coarse.contacts(), coarse.matrix(*compliance), scheme, speed,
                                                coarse.matrix(*gradient));
                      },
                      scheme};
    grids.error_factor = factor_of_one;
    return grids;
  }
} // namespace vibrocontact
