#include <vibrocontact/contact/body_places.h>

#include <algorithm>

namespace vibrocontact
{
  std::vector<std::array<double, 3>> places_of_bodies(const PlacedContacts &contacts,
                                                      const unsigned int n_bodies)
  {
    std::size_t n = std::max(n_bodies, 1u);
    for (const PlacedContact &contact : contacts.all)
      n = std::max<std::size_t>(n, std::max(contact.above, contact.below) + 1);
    std::vector<std::array<double, 3>> places(n, {{0, 0, 0}});
    std::vector<bool> placed(n, false);
    placed[0] = true;
    for (bool goes_on = true; goes_on;)
    {
      goes_on = false;
      for (const PlacedContact &contact : contacts.all)
        if (placed[contact.above] != placed[contact.below])
        {
          const bool down = placed[contact.above];
          const unsigned int from = down ? contact.above : contact.below,
                             to = down ? contact.below : contact.above;
          for (unsigned int d = 0; d < 3; ++d)
            places[to][d] =
                places[from][d] + (down ? 1 : -1) * (contact.frame.origin[d] - contact.origin_below[d]);
          placed[to] = goes_on = true;
        }
    }
    return places;
  }
} // namespace vibrocontact
