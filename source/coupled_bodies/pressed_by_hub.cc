#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/pressed_by_hub.h>

#include <cmath>

namespace vibrocontact
{
  void check_pressed_by_hub(const ContactBody &body, const PlacedContacts &contacts)
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
            " cannot be pressed down by its hub: body 1 must be carried by a held boundary alone, "
            "without springs and without Rotation; make it body 2 or hold it.");
    }
  }
} // namespace vibrocontact
