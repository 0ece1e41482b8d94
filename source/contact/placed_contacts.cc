#include <vibrocontact/contact/placed_contacts.h>

namespace vibrocontact
{
  Creepage PlacedContact::seen(const Creepage &creepage) const
  {
    const auto &axes = frame.axes;
    const double longitudinal = creepage.longitudinal - creepage.spin * frame.origin[1],
                 lateral = creepage.lateral + creepage.spin * frame.origin[0],
                 sliding_x = creepage.sliding_x - creepage.sliding_rotation * frame.origin[1],
                 sliding_y = creepage.sliding_y + creepage.sliding_rotation * frame.origin[0];
    Creepage result = creepage;
    result.longitudinal = axes[1][0] * longitudinal + axes[1][1] * lateral + own.longitudinal;
    result.lateral = axes[2][0] * longitudinal + axes[2][1] * lateral + own.lateral;
    result.sliding_x = axes[1][0] * sliding_x + axes[1][1] * sliding_y + own.sliding_x;
    result.sliding_y = axes[2][0] * sliding_x + axes[2][1] * sliding_y + own.sliding_y;
    result.sliding_rotation = axes[0][2] * creepage.sliding_rotation + own.sliding_rotation;
    result.spin = axes[0][2] * creepage.spin + own.spin;
    return result;
  }

  unsigned int PlacedContacts::first_point(const unsigned int k) const
  {
    unsigned int first = 0;
    for (unsigned int c = 0; c < k; ++c)
      first += all[c].grid.n_points();
    return first;
  }

  unsigned int PlacedContacts::contact_of(const unsigned int point) const
  {
    unsigned int k = 0;
    for (unsigned int end = all[0].grid.n_points(); point >= end && k + 1 < all.size();)
      end += all[++k].grid.n_points();
    return k;
  }

  PlacedContacts::Rows PlacedContacts::rows_of(const unsigned int body) const
  {
    Rows result;
    const unsigned int n = n_points();
    for (unsigned int component = 0; component < 3; ++component)
      for (unsigned int k = 0; k < all.size(); ++k)
        for (unsigned int i = 0; i < all[k].grid.n_points() && (all[k].above == body || all[k].below == body);
             ++i)
        {
          result.rows.push_back(contact_row(n, component, first_point(k) + i));
          result.sign.push_back(all[k].above == body ? 1 : -1);
        }
    return result;
  }

  DenseMatrix PlacedContacts::translation_of(const unsigned int body) const
  {
    DenseMatrix result(3 * n_points(), 3);
    const Rows own = rows_of(body);
    for (unsigned int i = 0; i < own.rows.size(); ++i)
    {
      const unsigned int component = own.rows[i] / n_points(), point = own.rows[i] % n_points();
      for (unsigned int d = 0; d < 3; ++d)
        result(own.rows[i], d) = own.sign[i] * all[contact_of(point)].frame.axes[component][d];
    }
    return result;
  }

  DenseMatrix PlacedContacts::rotation_of(const unsigned int body, const std::array<double, 3> &centre) const
  {
    DenseMatrix result(3 * n_points(), 3);
    const Rows own = rows_of(body);
    for (unsigned int i = 0; i < own.rows.size(); ++i)
    {
      const unsigned int component = own.rows[i] / n_points(), point = own.rows[i] % n_points(),
                         k = contact_of(point), of_grid = point - first_point(k);
      const ContactFrame &frame = all[k].frame;
      std::array<double, 3> arm;
      for (unsigned int d = 0; d < 3; ++d)
        arm[d] = frame.origin[d] + all[k].grid.x(of_grid) * frame.axes[1][d] +
                 all[k].grid.y(of_grid) * frame.axes[2][d] - centre[d];
      const std::array<std::array<double, 3>, 3> moved = {
          {{{0, -arm[2], arm[1]}}, {{arm[2], 0, 0}}, {{-arm[1], arm[0], 0}}}};
      for (unsigned int about = 0; about < 3; ++about)
        for (unsigned int d = 0; d < 3; ++d)
          result(own.rows[i], about) += own.sign[i] * frame.axes[component][d] * moved[about][d];
    }
    return result;
  }

  std::vector<std::array<double, 3>> PlacedContacts::resultants(const DenseVector &R) const
  {
    std::vector<std::array<double, 3>> result(all.size(), {{0, 0, 0}});
    const unsigned int n = n_points();
    for (unsigned int component = 0; component < 3; ++component)
    {
      const double *force = R.begin() + component * n;
      for (unsigned int k = 0; k < all.size(); ++k)
        for (unsigned int i = 0; i < all[k].grid.n_points(); ++i)
          result[k][component] += *force++;
    }
    return result;
  }

  std::array<double, 3> PlacedContacts::force_on(const unsigned int body,
                                                 const std::vector<std::array<double, 3>> &resultants) const
  {
    std::array<double, 3> force = {{0, 0, 0}};
    for (unsigned int k = 0; k < all.size(); ++k)
    {
      const double sign = all[k].above == body ? 1 : all[k].below == body ? -1 : 0;
      for (unsigned int d = 0; d < 3; ++d)
        for (unsigned int component = 0; component < 3; ++component)
          force[d] += sign * all[k].frame.axes[component][d] * resultants[k][component];
    }
    return force;
  }
} // namespace vibrocontact
