#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/coupled_bodies/contact_pair.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  HalfSpaceMaterial half_space_material(const BodyParameters &body)
  {
    if (body.description->is_rigid())
      return {std::numeric_limits<double>::infinity(), 0.};
    return {body.material.young_modulus, body.material.poisson_ratio};
  }

  namespace
  {
    /// Undeformed surface of a body without mesh over a contact's plane; sign +1 above it, -1 below.
    double surface_height(const BodyDescription &surface, const PlacedContact &contact,
                          const unsigned int point, const double sign)
    {
      const std::array<double, 3> &origin = sign > 0 ? contact.frame.origin : contact.origin_below;
      const auto [along, across] = surface.curvatures();
      return sign * 0.5 *
             (along * std::pow(origin[0] + contact.grid.x(point), 2) +
              across * std::pow(origin[1] + contact.grid.y(point), 2));
    }

    /// The poles of one body behind those of the others, in its rows of the contacts.
    void add_poles(const ReducedBody &own, const PlacedContacts::Rows &rows, ContactPair &pair)
    {
      const unsigned int first = pair.n_poles(), n = first + own.n_poles(), n_rows = 3 * pair.n_points();
      const auto widen = [&](ComplexMatrix &shapes)
      {
        const ComplexMatrix before = shapes;
        shapes.reinit(n_rows, n);
        for (unsigned int k = 0; k < before.n(); ++k)
          for (unsigned int i = 0; i < n_rows; ++i)
            shapes(i, k) = before(i, k);
      };
      widen(pair.right);
      widen(pair.left);
      if (own.gradient.m() > 0 || pair.gradient.m() > 0)
      {
        widen(pair.gradient);
        if (pair.residual_gradient.m() == 0)
          pair.residual_gradient.reinit(n_rows, n_rows);
      }
      for (unsigned int k = 0; k < own.n_poles(); ++k)
      {
        for (unsigned int i = 0; i < rows.rows.size(); ++i)
        {
          pair.right(rows.rows[i], first + k) = rows.sign[i] * own.right(i, k);
          pair.left(rows.rows[i], first + k) = rows.sign[i] * own.left(i, k);
        }
        pair.poles.push_back(own.poles[k]);
        pair.pole_load.push_back(own.pole_load[k]);
      }
    }

    /// Gradients of the poles added last and of their body's W~, in place of the differences between points.
    void add_gradients(const BodyInContact &own, const DenseMatrix &W, const PlacedContacts::Rows &rows,
                       const CreepScheme &scheme, ContactPair &pair)
    {
      const PlacedContacts &contacts = pair.interface.contacts;
      const unsigned int n = contacts.n_points(), p = own.n_poles(), first = pair.n_poles() - p,
                         n_own = rows.rows.size();
      DenseMatrix differences(3 * n, 2 * p + n_own);
      for (unsigned int i = 0; i < n_own; ++i)
      {
        for (unsigned int k = 0; k < p; ++k)
        {
          differences(rows.rows[i], k) = rows.sign[i] * own.right(i, k).real();
          differences(rows.rows[i], p + k) = rows.sign[i] * own.right(i, k).imag();
        }
        for (unsigned int j = 0; j < n_own; ++j)
          differences(rows.rows[i], 2 * p + j) = rows.sign[i] * rows.sign[j] * W(i, j);
      }
      convert_to_slip_rows(contacts, scheme, 1., differences);
      for (unsigned int i = 0; i < n_own; ++i)
      {
        const unsigned int row = rows.rows[i];
        if (row < n)
          continue;
        const double along = rows.sign[i] * contacts.all[contacts.contact_of(row % n)].share_of_speed();
        for (unsigned int k = 0; k < p; ++k)
          pair.gradient(row, first + k) =
              along * own.gradient(i, k) - std::complex<double>(differences(row, k), differences(row, p + k));
        for (unsigned int j = 0; j < n_own; ++j)
          pair.residual_gradient(row, rows.rows[j]) +=
              along * rows.sign[j] * own.residual_gradient(i, j) - differences(row, 2 * p + j);
      }
    }

    // what the residual flexibility answers to the loads; the modes' part comes with their amplitudes
    void add_load_jump(const ReducedBody &body, const PlacedContacts::Rows &own, const unsigned int n_rows,
                       DenseVector &jump)
    {
      if (std::all_of(body.residual_load.begin(), body.residual_load.end(),
                      [](const double value) { return value == 0; }))
        return;
      if (jump.size() == 0)
        jump.reinit(n_rows);
      for (unsigned int i = 0; i < own.rows.size(); ++i)
        jump[own.rows[i]] += own.sign[i] * body.residual_load[i];
    }

    /// The first contact that a body is in.
    unsigned int contact_of(const PlacedContacts::Rows &own, const PlacedContacts &contacts)
    {
      return own.rows.empty() ? 0 : contacts.contact_of(own.rows[0] % contacts.n_points());
    }

    bool has_own_flexibility(const ContactBody &body, const PlacedContacts::Rows &own,
                             const ContactSections &sections, const PlacedContacts &contacts)
    {
      return body.reduced && !((body.parameters->is_solid() || body.parameters->is_revolved()) &&
                               sections.all[contact_of(own, contacts)].half_space_flexibility());
    }

    /// Of a body's own rows. A half-space, or what one stands for, has one contact.
    DenseMatrix residual_flexibility(const ContactBody &body, const PlacedContacts::Rows &own,
                                     const ContactSections &sections, const PlacedContacts &contacts)
    {
      const unsigned int k = contact_of(own, contacts);
      if (has_own_flexibility(body, own, sections, contacts))
        return body.reduced->residual;
      if (body.parameters->description->is_rigid() || own.rows.empty())
        return DenseMatrix(own.rows.size());
      const HalfSpaceMaterial half_space = half_space_material(*body.parameters),
                              rigid = {std::numeric_limits<double>::infinity(), 0.};
      return half_space_compliance(contacts.all[k].grid, own.sign[0] > 0 ? HalfSpacePair(half_space, rigid)
                                                                         : HalfSpacePair(rigid, half_space));
    }

    void add_in_rows(const DenseMatrix &W, const PlacedContacts::Rows &own, DenseMatrix &flexibility)
    {
      for (unsigned int j = 0; j < own.rows.size(); ++j)
        for (unsigned int i = 0; i < own.rows.size(); ++i)
          flexibility(own.rows[i], own.rows[j]) += own.sign[i] * own.sign[j] * W(i, j);
    }

    void uncouple(const ContactSections &sections, const PlacedContacts &contacts, DenseMatrix &flexibility)
    {
      const unsigned int n = flexibility.m() / 3;
      const auto couples = [&](const unsigned int row)
      { return sections.all[contacts.contact_of(row % n)].coupling; };
      if (std::all_of(sections.all.begin(), sections.all.end(),
                      [](const ContactParameters &contact) { return contact.coupling; }))
        return;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = n; j < 3 * n; ++j)
          if (!couples(i) || !couples(j))
            flexibility(i, j) = flexibility(j, i) = 0;
    }

    // In plane strain, as of an oscillator or a ring in its plane, nothing moves along y and nothing drives it there. A
    // compliance of its own, which never feels a force, keeps the lateral force of a sticking point determined (zero). It
    // is of the size of the compliance along x; with all modes kept that is the inertia's, far below the static one, and
    // rho_t, which follows the mean of both, must not notice this one.
    void hold_across(ContactPair &pair)
    {
      const unsigned int n = pair.n_points(), m = pair.n_modes();
      const auto gives_way = [&](const unsigned int row)
      {
        bool moves = pair.residual(row, row) != 0;
        for (unsigned int k = 0; k < m && !moves; ++k)
          moves = pair.trace(row, k) != 0;
        for (unsigned int k = 0; k < pair.n_poles() && !moves; ++k)
          moves = pair.right(row, k) != 0.;
        return moves;
      };
      constexpr double beyond_all_modes = 1e3;
      const double fastest = m > 0 ? *std::max_element(pair.omega.begin(), pair.omega.end()) : 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        if (gives_way(2 * n + i) || !gives_way(n + i))
          continue;
        const double residual = pair.residual(n + i, n + i);
        double modal = 0, inertial = 0;
        for (unsigned int k = 0; k < m; ++k)
        {
          modal += std::pow(pair.trace(n + i, k) / pair.omega[k], 2);
          inertial += std::pow(pair.trace(n + i, k) / (beyond_all_modes * fastest), 2);
        }
        // round-off is all that remains of the residual when all modes are kept
        const double along_x = residual > 1e-9 * modal ? residual + modal : inertial;
        pair.residual(2 * n + i, 2 * n + i) = along_x;
      }
    }
  } // namespace

  ContactInterface contact_interface(const std::vector<ContactBody> &bodies, const ContactSections &sections,
                                     const PlacedContacts &contacts)
  {
    ContactInterface interface;
    interface.contacts = contacts;
    const unsigned int n = contacts.n_points();
    for (unsigned int k = 0; k < contacts.all.size(); ++k)
      interface.gap.insert(interface.gap.end(), contacts.all[k].grid.n_points(), sections.all[k].gap);
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      const PlacedContacts::Rows own = contacts.rows_of(b);
      for (unsigned int i = 0; i < own.rows.size() / 3; ++i)
      {
        const unsigned int k = contacts.contact_of(own.rows[i]);
        const PlacedContact &contact = contacts.all[k];
        const bool meshed = bodies[b].reduced != nullptr;
        interface.gap[own.rows[i]] +=
            own.sign[i] * (meshed ? bodies[b].reduced->surface_height[i]
                                  : surface_height(*bodies[b].parameters->description, contact,
                                                   own.rows[i] - contacts.first_point(k), own.sign[i]));
        if (contact.grid.traction != TractionShape::constant && !meshed &&
            bodies[b].parameters->description->lies_on_half_space())
          throw InputError(
              sections.all[k].section +
              "/Quadrature is consistent, but a half-space knows tractions that are constant on each "
              "cell only: set it to lumped.");
      }
    }
    AssertThrow(interface.gap.size() == n, dealii::ExcInternalError());
    return interface;
  }

  DenseMatrix brought_flexibility(const std::vector<ContactBody> &bodies, const unsigned int b,
                                  const ContactSections &sections, const PlacedContacts &contacts)
  {
    const PlacedContacts::Rows own = contacts.rows_of(b);
    const unsigned int n = contacts.n_points();
    DenseMatrix result(3 * n, 3 * n);
    add_in_rows(residual_flexibility(bodies[b], own, sections, contacts), own, result);
    uncouple(sections, contacts, result);
    return result;
  }

  bool are_half_spaces_alone(const std::vector<ContactBody> &bodies, const PlacedContacts &contacts)
  {
    return contacts.all.size() == 1 &&
           std::none_of(bodies.begin(), bodies.end(), [](const ContactBody &body) { return body.reduced; });
  }

  HalfSpacePair half_space_pair(const std::vector<ContactBody> &bodies, const ContactSections &sections,
                                const PlacedContacts &contacts)
  {
    const PlacedContact &contact = contacts.all[0];
    return HalfSpacePair(half_space_material(*bodies[contact.above].parameters),
                         half_space_material(*bodies[contact.below].parameters), sections.first().coupling);
  }

  namespace
  {
    /// A body that is free needs no hub: what cannot load it says so itself.
    /// @throws InputError if body 1 of a scene does not follow its hub as a whole, so that this cannot press it
    void check_pressed_by_hub(const ContactBody &body, const PlacedContacts &contacts)
    {
      if (!body.reduced || body.reduced->n_rigid_modes > 0)
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

    /// Whether a body leaves contact forces more than its modes have: beyond a small part of what the highest of them answers, and
    /// beyond the rounding of what they answer together. @param rest of its rows
    bool leaves_something_out(const ReducedBody &body, const DenseMatrix &rest)
    {
      constexpr double part_of_highest = 1e-3, rounding = 1e-13;
      const unsigned int n_modes = body.n_modes();
      double by_modes = 0, by_highest = 0, left = 0;
      for (unsigned int i = 0; i < rest.m(); ++i)
      {
        double compliance = 0, highest = 0;
        for (unsigned int k = 0; k < n_modes; ++k)
          if (body.omega[k] > 0)
            compliance += highest = std::pow(body.trace(i, k) / body.omega[k], 2);
        by_modes = std::max(by_modes, compliance);
        by_highest = std::max(by_highest, highest);
        left = std::max(left, std::abs(rest(i, i)));
      }
      return left > std::max(part_of_highest * by_highest, rounding * by_modes);
    }
  } // namespace

  ContactPair contact_pair(const std::vector<ContactBody> &bodies, const ContactSections &sections,
                           const PlacedContacts &contacts)
  {
    check_pressed_by_hub(bodies[0], contacts);
    ContactPair pair;
    pair.interface = contact_interface(bodies, sections, contacts);
    const unsigned int n = contacts.n_points();
    if (are_half_spaces_alone(bodies, contacts))
    {
      const HalfSpacePair both = half_space_pair(bodies, sections, contacts);
      pair.half_spaces = std::make_shared<const HalfSpaces>(both, contacts.only());
      return pair;
    }
    pair.residual.reinit(3 * n, 3 * n);
    unsigned int n_modes = 0, first = 0;
    bool leaves_out = false;
    std::vector<std::string> labels_of_poles;
    for (const ContactBody &body : bodies)
      n_modes += body.reduced ? body.reduced->omega.size() : 0;
    pair.trace.reinit(3 * n, n_modes);
    if (bodies[0].reduced)
      pair.hub_inertia = bodies[0].reduced->hub;
    const unsigned int n_motions = pair.hub_inertia ? 6 : 3;
    pair.participation.reinit(n_modes, n_motions);
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      const PlacedContacts::Rows own = contacts.rows_of(b);
      const unsigned int n_own = own.rows.size();
      const DenseMatrix W = residual_flexibility(bodies[b], own, sections, contacts);
      add_in_rows(W, own, pair.residual);
      if (has_own_flexibility(bodies[b], own, sections, contacts) && bodies[b].reduced->relaxation > 0 &&
          has_rest(*bodies[b].reduced))
        pair.relaxing.push_back(
            {b + 1, bodies[b].reduced->relaxation, brought_flexibility(bodies, b, sections, contacts)});
      if (b == 0)
        for (unsigned int i = 0; i < 3 * n; ++i)
          pair.force_residual.push_back(n_own > 0 ? pair.residual(i, own.rows[0]) : 0.);
      if (!bodies[b].reduced)
        continue;
      const ReducedBody &reduced = *bodies[b].reduced;
      leaves_out = leaves_out || (bodies[b].parameters->is_meshed() && leaves_something_out(reduced, W));
      for (unsigned int k = 0; k < reduced.omega.size(); ++k)
      {
        pair.omega.push_back(reduced.omega[k]);
        pair.damping_ratio.push_back(reduced.damping_ratio[k]);
        pair.labels.push_back(reduced.name + ":" + reduced.labels[k]);
        pair.body.push_back(b + 1);
        pair.modal_load.push_back(reduced.modal_load[k]);
        for (unsigned int i = 0; i < n_own; ++i)
          pair.trace(own.rows[i], first + k) = own.sign[i] * reduced.trace(i, k);
        for (unsigned int d = 0; d < std::min(n_motions, reduced.participation.n()); ++d)
          pair.participation(first + k, d) = reduced.participation(k, d);
      }
      first += reduced.omega.size();
      if (reduced.n_poles() > 0)
      {
        add_poles(reduced, own, pair);
        pair.body_of_pole.resize(pair.n_poles(), b + 1);
        if (reduced.gradient.m() > 0)
          add_gradients(reduced, W, own, find_creep_scheme(sections.first().creep_scheme), pair);
        for (unsigned int k = 0; k < reduced.n_poles(); ++k)
          labels_of_poles.push_back(reduced.name + ":" + reduced.labels[reduced.n_modes() + k]);
      }
      add_load_jump(reduced, own, 3 * n, pair.interface.load_jump);
    }
    pair.labels.insert(pair.labels.end(), labels_of_poles.begin(), labels_of_poles.end());
    uncouple(sections, contacts, pair.residual);
    if (pair.residual_gradient.m() > 0)
      uncouple(sections, contacts, pair.residual_gradient);
    const std::vector<double> omega = pair.frequencies();
    if (leaves_out && !omega.empty())
      pair.modes_reach = *std::max_element(omega.begin(), omega.end()) / (2 * dealii::numbers::PI);
    hold_across(pair);
    return pair;
  }

  DenseMatrix residual_flexibility(const ContactPair &pair)
  {
    return pair.half_spaces ? pair.half_spaces->flexibility.matrix() : pair.residual;
  }

  void add_residual_displacement(const DenseMatrix &W, const HalfSpaces *const alone, const DenseVector &R,
                                 DenseVector &result)
  {
    add_residual_displacements(W, alone, {&R}, {&result});
  }

  void add_residual_displacements(const DenseMatrix &W, const HalfSpaces *const alone,
                                  const std::vector<const DenseVector *> &R,
                                  const std::vector<DenseVector *> &results)
  {
    AssertDimension(R.size(), results.size());
    for (std::size_t k = 0; k < R.size() && !alone; ++k)
    {
      AssertDimension(R[k]->size(), W.n());
      AssertDimension(results[k]->size(), W.m());
    }
    if (alone)
    {
      DenseVector displacement;
      for (std::size_t k = 0; k < R.size(); ++k)
      {
        alone->flexibility.vmult(displacement, *R[k], loaded_points(*R[k], alone->flexibility.n_points()));
        *results[k] += displacement;
      }
      return;
    }
    add_products(W, R, results);
  }

  DenseMatrix rest_over_step(const ContactPair &pair, const double h)
  {
    DenseMatrix result = residual_flexibility(pair);
    for (const RelaxingRest &rest : pair.relaxing)
      result.add(-rest.relaxation / (h + rest.relaxation), rest.flexibility);
    return result;
  }

  std::vector<double> ContactPair::frequencies() const
  {
    std::vector<double> result = omega;
    for (const std::complex<double> &pole : poles)
      result.push_back(std::abs(pole));
    return result;
  }

  DenseMatrix static_compliance(const ContactPair &pair)
  {
    DenseMatrix result = residual_flexibility(pair);
    const auto rigid = std::find(pair.omega.begin(), pair.omega.end(), 0.);
    const std::string label = rigid == pair.omega.end() ? "" : pair.labels[rigid - pair.omega.begin()];
    add_modal_compliance(result, pair.trace, pair.omega, label.substr(0, label.find(':')));
    if (pair.n_poles() == 0)
      return result;
    for (unsigned int k = 0; k < pair.n_poles(); ++k)
      if (is_rigid_motion(pair.poles[k]))
        throw InputError("Nothing holds " + pair.labels[pair.n_modes() + k] +
                         ": a static analysis cannot load it.");
    result.add(1., sum_over_poles(pair, static_weights(pair)));
    return result;
  }

  DenseMatrix static_gradient(const ContactPair &pair)
  {
    if (pair.gradient.m() == 0)
      return DenseMatrix();
    BodyInContact along;
    along.poles = pair.poles;
    along.left = pair.left;
    along.right = pair.gradient;
    DenseMatrix result = sum_over_poles(along, static_weights(along));
    result.add(1., pair.residual_gradient);
    return result;
  }

  std::shared_ptr<const ContactOperator> static_operator(const ContactPair &pair, const CreepScheme &scheme,
                                                         const double speed)
  {
    const PlacedContacts &contacts = pair.interface.contacts;
    if (pair.half_spaces)
      return rolling_operator(contacts.only(), pair.half_spaces->pair, scheme, speed);
    return rolling_operator(contacts, static_compliance(pair), scheme, speed, static_gradient(pair));
  }

  ContactInterface static_interface(const ContactPair &pair)
  {
    ContactInterface interface = pair.interface;
    DenseVector &jump = interface.load_jump;
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
    {
      if (pair.modal_load[k] == 0)
        continue;
      if (jump.size() == 0)
        jump.reinit(3 * pair.n_points());
      for (unsigned int i = 0; i < jump.size(); ++i)
        jump[i] += pair.trace(i, k) * pair.modal_load[k] / (pair.omega[k] * pair.omega[k]);
    }
    for (unsigned int k = 0; k < pair.n_poles(); ++k)
    {
      const std::complex<double> rest = rest_of_state(pair, k);
      if (rest == 0.)
        continue;
      if (jump.size() == 0)
        jump.reinit(3 * pair.n_points());
      for (unsigned int i = 0; i < jump.size(); ++i)
        jump[i] += 2 * (pair.right(i, k) * rest).real();
    }
    return interface;
  }
} // namespace vibrocontact
