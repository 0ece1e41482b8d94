#include <vibrocontact/analyses/loading/loading_scene.h>
#include <vibrocontact/contact/coarse_points.h>

#include <utility>

namespace vibrocontact
{
  namespace
  {
    /// Two half-spaces with a multiple of the file's spacing. What a coarse grid has to keep free lies beyond the file's extent.
    LoadingGrid half_spaces(const std::vector<ContactBody> &bodies, ContactSections sections,
                            PlacedContacts contacts, const double factor)
    {
      ContactParameters &contact = sections.first();
      if (factor != 1)
      {
        contact.spacing *= factor;
        contact.half_length += contact.spacing;
        contact.half_width += contact.spacing;
        contacts.only() = contact.grid();
      }
      const HalfSpacePair pair = half_space_pair(bodies, sections, contacts);
      return {contact_interface(bodies, sections, contacts),
              std::make_shared<const HalfSpaceOperator>(contacts.only(), pair, std::vector<double>{1.})};
    }
  } // namespace

  LoadingGrids loading_grids(const std::vector<ContactBody> &bodies, const ContactSections &sections,
                             const PlacedContacts &contacts)
  {
    if (are_half_spaces_alone(bodies, contacts))
      return {half_spaces(bodies, sections, contacts, 1), half_spaces(bodies, sections, contacts, 2)};
    const ContactPair pair = contact_pair(bodies, sections, contacts);
    DenseMatrix compliance = static_compliance(pair);
    LoadingGrids grids;
    grids.own.interface = static_interface(pair);
    const CoarsePoints coarse(contacts);
    if (coarse.exist())
      grids.coarse = {coarse.interface(grids.own.interface),
                      std::make_shared<const DenseContactOperator>(coarse.matrix(compliance))};
    grids.own.compliance = std::make_shared<const DenseContactOperator>(std::move(compliance));
    return grids;
  }
} // namespace vibrocontact
